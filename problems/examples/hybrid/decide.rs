//! The mode that a solution goes on in at a point of interfaces: of all choices the one whose own
//! motion keeps to it. Where the rate that decides is zero at the point, it is looked at a short time
//! later.

use crate::flow::{SHORTEST, checked_flow};
use crate::motion::{Choice, Guard, Mode, Motion, Systems};
use crate::plant::State;

/// Rates and weights between these two sizes are neither zero nor clearly not.
const ZERO: f64 = 1e-8;
const CLEAR: f64 = 1e-5;
/// A short time, and the least that a rate has to change in it, as a part of it.
const LATER: f64 = 1e-4;
const CHANGE: f64 = 1e-2;

/// Why a solution does not go on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Stop {
    /// No motion fits: it would slide where that is not declared, or where several means are.
    None,
    /// Several motions fit.
    Several,
    /// It is far away, and nothing of interest.
    Far,
    /// It cannot be told in doubles.
    Undecided(&'static str),
}

/// The motion behind (t, x), which is on the interfaces `on`, with the discrete state u, and whether
/// there are others, which slide between fields that lead away.
pub(crate) fn decide(
    systems: &Systems<'_>,
    (t, x): (f64, &State),
    on: &[usize],
    u: f64,
) -> Result<(Motion, bool), Stop> {
    let mut choices = Vec::new();
    for k in 0..systems.plant.interfaces.len() {
        let g = systems.g(k, t, x);
        if !on.contains(&k) && g.abs() < CLEAR / 10.0 {
            return Err(Stop::Undecided("another interface is near"));
        }
        choices.push(Choice::of(g));
    }
    let mut all = vec![choices];
    for &k in on {
        let mut own = vec![Choice::Above, Choice::Below];
        if systems.plant.interfaces[k].slides {
            own.push(Choice::Slides);
        }
        let with = |choices: &Vec<Choice>| {
            let choices = choices.clone();
            own.clone().into_iter().map(move |choice| {
                let mut choices = choices.clone();
                choices[k] = choice;
                choices
            })
        };
        all = all.iter().flat_map(with).collect();
    }
    let mut known: Vec<Motion> = Vec::new();
    let mut fitting: Vec<Motion> = Vec::new();
    for choices in all {
        let Some(motion) = systems.motion(Mode { choices, u }) else {
            continue;
        };
        if known.iter().any(|other| is_same(other, &motion)) {
            continue;
        }
        known.push(motion.clone());
        let margin = margin(systems, &motion, on, t, x);
        let fits = if margin > CLEAR {
            true
        } else if margin < -CLEAR {
            false
        } else if margin.abs() < ZERO {
            let mut step = LATER;
            let (mut later, mut agrees) = checked_flow(systems, &motion, t, x, step);
            while step > SHORTEST && !agrees {
                step *= 0.5;
                (later, agrees) = checked_flow(systems, &motion, t, x, step);
            }
            if !agrees {
                return Err(Stop::Undecided("a weight has a pole"));
            }
            let margin = self::margin(systems, &motion, on, t + step, &later);
            if margin.is_nan() || margin.abs() < CHANGE * step {
                return Err(Stop::Undecided("a rate is zero and hardly changes"));
            }
            margin > 0.0
        } else {
            return Err(Stop::Undecided("a rate or a weight is near zero"));
        };
        if fits {
            fitting.push(motion);
        }
    }
    match fitting.len() {
        0 => Err(Stop::None),
        1 => Ok((fitting.remove(0), false)),
        _ => {
            fitting.retain(|motion| !systems.is_repelling(motion, t, x));
            match fitting.len() {
                1 => Ok((fitting.remove(0), true)),
                _ => Err(Stop::Several),
            }
        }
    }
}

/// Whether two choices are the same motion: they differ at interfaces that do not bound it.
fn is_same(one: &Motion, other: &Motion) -> bool {
    let at = |motion: &Motion, k: usize| motion.mode.choices[k];
    one.regions == other.regions
        && one.slid == other.slid
        && one.bounds == other.bounds
        && one.bounds.iter().all(|&k| at(one, k) == at(other, k))
}

/// The smallest of what has to be positive: rates into the sides that are chosen, and weights.
fn margin(systems: &Systems<'_>, motion: &Motion, on: &[usize], t: f64, x: &State) -> f64 {
    let (f, weights) = systems.field(motion, t, x);
    let mut least = f64::INFINITY;
    for guard in motion.guards() {
        let margin = match guard {
            Guard::Interface(k) if on.contains(&k) => {
                motion.mode.choices[k].sign() * systems.rate(k, t, x, &f)
            }
            Guard::Interface(_) => continue,
            Guard::Weight(_) => systems.guard(motion, guard, (t, x), &weights),
        };
        if margin.is_nan() {
            return margin;
        }
        least = least.min(margin);
    }
    least
}
