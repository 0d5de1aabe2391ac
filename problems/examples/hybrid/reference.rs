//! The reference solution: short steps of order 10 in one mode, the first zero of what bounds it by
//! bisection of the length of a step, what happens there, and the next mode.

use crate::decide::{Stop, decide};
use crate::flow::{SHORTEST, checked_flow, flow};
use crate::motion::{Choice, Guard, Motion, Systems};
use crate::plant::{Jump, State, value};

/// What comes nearer to zero than this and turns is not decided.
const TOUCH: f64 = 1e-6;
/// A point is on an interface where g is less.
const ON: f64 = 1e-11;
/// States beyond this size are not followed.
const FAR: f64 = 20.0;
/// The most that a weight may change in a step, unless it is one of the shortest.
const MOST_CHANGE: f64 = 0.1;
/// The time between the points at which a derivative is taken.
const SMALL: f64 = 1e-5;

/// What happened at a point.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    Crossed,
    Jumped,
    Began,
    Left,
}

/// A transition.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Passed {
    pub(crate) t: f64,
    /// Nothing of a clock.
    pub(crate) interface: Option<usize>,
    pub(crate) kind: Kind,
    /// The interfaces slid on afterwards.
    pub(crate) slid: Vec<usize>,
    pub(crate) after: State,
}

/// A solution.
#[derive(Clone, Debug)]
pub(crate) struct Solution {
    pub(crate) passed: Vec<Passed>,
    pub(crate) t: f64,
    pub(crate) x: State,
    /// Where other motions would slide between fields that lead away.
    pub(crate) forks: Vec<f64>,
    /// Why it did not reach the end time.
    pub(crate) stop: Option<Stop>,
}

/// How it is computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    pub(crate) step: f64,
    pub(crate) t_end: f64,
    /// It ends behind so many transitions.
    pub(crate) most: usize,
}

/// The solution from (0, x₀).
pub(crate) fn solve(systems: &Systems<'_>, x0: &State, setting: Setting) -> Solution {
    let mut solution = Solution {
        passed: Vec::new(),
        t: 0.0,
        x: *x0,
        forks: Vec::new(),
        stop: None,
    };
    solution.stop = run(systems, setting, &mut solution).err();
    solution
}

fn run(systems: &Systems<'_>, setting: Setting, solution: &mut Solution) -> Result<(), Stop> {
    let interfaces = systems.plant.interfaces.len();
    let on = (0..interfaces).filter(|&k| systems.g(k, 0.0, &solution.x).abs() < ON);
    let mut on: Vec<usize> = on.collect();
    let mut motion = next_motion(systems, solution, &on, 1.0)?;
    let mut ticks = 1.0;
    loop {
        let Solution { t, x, .. } = *solution;
        let clock = systems.plant.clock.as_ref();
        let tick = clock.map_or(f64::INFINITY, |(period, _)| ticks * systems.c[*period]);
        let until = setting.t_end.min(tick);
        let mut step = setting.step.min(until - t);
        let (mut after, mut agrees) = checked_flow(systems, &motion, t, &x, step);
        // weights have poles, near which they change fast, and beyond which the fields lead away
        let passes_pole = |later: f64, after: &State| {
            let changes = systems.change(&motion, (t, &x), (later, after)) > MOST_CHANGE;
            changes || systems.is_repelling(&motion, later, after)
        };
        while step > SHORTEST && (!agrees || passes_pole(t + step, &after)) {
            step *= 0.5;
            (after, agrees) = checked_flow(systems, &motion, t, &x, step);
        }
        if !after.iter().all(|part| part.is_finite()) {
            return Err(Stop::Undecided("the field has no value"));
        }
        let is_repelling = || systems.is_repelling(&motion, t + step, &after);
        if step <= SHORTEST && (!agrees || is_repelling()) {
            return Err(Stop::Undecided("a weight has a pole"));
        }
        if !after.iter().all(|part| part.abs() < FAR) {
            return Err(Stop::Far);
        }
        let found = first_zero(systems, &motion, &on, (t, &x), (step, &after))?;
        let Some((s, guard)) = found else {
            on.clear();
            solution.t = if step >= until - t { until } else { t + step };
            solution.x = after;
            systems.project(&motion, solution.t, &mut solution.x);
            if solution.t >= tick && tick < setting.t_end {
                ticks += 1.0;
                let jump = &clock.ok_or(Stop::None)?.1;
                (motion, on) = jumped(systems, &motion, solution, (None, &[jump]))?;
            } else if solution.t >= setting.t_end {
                return Ok(());
            }
            continue;
        };
        solution.t = t + s;
        solution.x = flow(systems, &motion, t, &x, s);
        systems.project(&motion, solution.t, &mut solution.x);
        (motion, on) = passed(systems, &motion, guard, solution)?;
        if solution.passed.len() >= setting.most {
            return Ok(());
        }
    }
}

/// The motion that the solution goes on in where it is.
fn next_motion(
    systems: &Systems<'_>,
    solution: &mut Solution,
    on: &[usize],
    u: f64,
) -> Result<Motion, Stop> {
    let (motion, is_fork) = decide(systems, (solution.t, &solution.x), on, u)?;
    if is_fork {
        solution.forks.push(solution.t);
    }
    Ok(motion)
}

/// The first zero of a guard within a step, as the length of the step to it.
fn first_zero(
    systems: &Systems<'_>,
    motion: &Motion,
    on: &[usize],
    (t, x): (f64, &State),
    (step, after): (f64, &State),
) -> Result<Option<(f64, Guard)>, Stop> {
    let value = |guard: Guard, t: f64, x: &State| {
        let weights = match guard {
            Guard::Weight(_) => systems.field(motion, t, x).1,
            Guard::Interface(_) => [1.0; 8],
        };
        systems.guard(motion, guard, (t, x), &weights)
    };
    let mut first: Option<(f64, Guard)> = None;
    let ends = [(t, *x), (t + step, *after)];
    let fields = ends.map(|(t, x)| systems.field(motion, t, &x).0);
    for guard in motion.guards() {
        let is_new = matches!(guard, Guard::Interface(k) if on.contains(&k));
        let at = |s: f64| {
            let x = flow(systems, motion, t, x, s);
            value(guard, t + s, &x)
        };
        let slope = |end: usize| {
            let (t, x) = &ends[end];
            let moved = |s: f64| std::array::from_fn(|i| x[i] + s * fields[end][i]);
            (value(guard, t + SMALL, &moved(SMALL)) - value(guard, t - SMALL, &moved(-SMALL)))
                / (2.0 * SMALL)
        };
        let [v0, v1] = [0, 1].map(|end| value(guard, ends[end].0, &ends[end].1));
        let (mut a, mut b) = (0.0, step);
        if v1 <= 0.0 {
            if is_new || v0 <= 0.0 {
                a = step;
                while at(a) <= 0.0 {
                    a /= 2.0;
                    if a < 1e-7 {
                        return Err(Stop::Undecided("an interface is met where it was left"));
                    }
                }
            }
        } else {
            if is_new || slope(0) >= 0.0 || slope(1) <= 0.0 {
                continue;
            }
            let least = hermite_minimum([v0, v1], [slope(0), slope(1)], step);
            if least > 0.1 * v0.min(v1) && least > 1e-3 {
                continue;
            }
            // the minimum by the golden section
            const PART: f64 = 0.381_966_011_250_105_1;
            let (mut low, mut high) = (0.0, step);
            for _ in 0..40 {
                let [one, other] = [low + PART * (high - low), high - PART * (high - low)];
                if at(one) < at(other) {
                    high = other;
                } else {
                    low = one;
                }
            }
            let minimum = at(low);
            if minimum.abs() < TOUCH {
                return Err(Stop::Undecided("a touch"));
            }
            if minimum > 0.0 {
                continue;
            }
            b = low;
        }
        for _ in 0..60 {
            let middle = (a + b) / 2.0;
            if middle <= a || middle >= b {
                break;
            }
            if at(middle) > 0.0 {
                a = middle;
            } else {
                b = middle;
            }
        }
        if first.is_some_and(|(other, _)| (other - b).abs() < TOUCH) {
            return Err(Stop::Undecided("two at once"));
        }
        if first.is_none_or(|(other, _)| b < other) {
            first = Some((b, guard));
        }
    }
    Ok(first)
}

/// The minimum of the cubic polynomial by values and slopes at both ends, by values at some points.
fn hermite_minimum([v0, v1]: [f64; 2], [d0, d1]: [f64; 2], step: f64) -> f64 {
    let points = (1..32).map(|k| f64::from(k) / 32.0);
    let values = points.map(|p| {
        let q = 1.0 - p;
        v0 * q * q * (1.0 + 2.0 * p)
            + v1 * p * p * (1.0 + 2.0 * q)
            + step * (d0 * p * q * q - d1 * p * p * q)
    });
    values.fold(f64::INFINITY, f64::min)
}

/// What happens where a guard is zero.
fn passed(
    systems: &Systems<'_>,
    motion: &Motion,
    guard: Guard,
    solution: &mut Solution,
) -> Result<(Motion, Vec<usize>), Stop> {
    let (t, x) = (solution.t, solution.x);
    let mut on = motion.slid.clone();
    if let Guard::Interface(k) = guard {
        let falls = motion.mode.choices[k] == Choice::Above;
        let events = systems.plant.events.iter().filter(|event| {
            let u = event
                .only_if
                .is_none_or(|positive| positive == (motion.mode.u > 0.0));
            event.interface == k && u && if falls { event.falls } else { event.rises }
        });
        let jumps: Vec<&Jump> = events.map(|event| &event.jump).collect();
        if !jumps.is_empty() {
            return jumped(systems, motion, solution, (Some(k), &jumps));
        }
        on.push(k);
    }
    let next = next_motion(systems, solution, &on, motion.mode.u)?;
    let left = motion.slid.iter().filter(|k| !next.slid.contains(k));
    let interface = match guard {
        Guard::Interface(k) => Some(k),
        // of several that are left at once it is not told which one ended the motion
        Guard::Weight(_) if left.clone().count() > 1 => None,
        Guard::Weight(_) => left.clone().next().copied(),
    };
    let kind = if next.slid.iter().any(|k| !motion.slid.contains(k)) {
        Kind::Began
    } else if left.count() > 0 {
        Kind::Left
    } else {
        Kind::Crossed
    };
    let is_silent = matches!(guard, Guard::Interface(k) if is_for_events(systems, k));
    if !is_silent {
        solution.passed.push(Passed {
            t,
            interface,
            kind,
            slid: next.slid.clone(),
            after: x,
        });
    }
    Ok((next, on))
}

fn is_for_events(systems: &Systems<'_>, interface: usize) -> bool {
    systems.plant.interfaces[interface].role == crate::plant::Role::Events
}

/// Jumps at an interface or at a time.
fn jumped(
    systems: &Systems<'_>,
    motion: &Motion,
    solution: &mut Solution,
    (interface, jumps): (Option<usize>, &[&Jump]),
) -> Result<(Motion, Vec<usize>), Stop> {
    let (t, x, mut u) = (solution.t, solution.x, motion.mode.u);
    let mut after = x;
    for jump in jumps {
        for (state, sum) in &jump.sets {
            after[*state] = value(sum, systems.c, t, &x, motion.mode.u);
        }
        if jump.flips {
            u = -motion.mode.u;
        }
    }
    let on = (0..systems.plant.interfaces.len()).filter(|&k| {
        let was_on = interface == Some(k) || motion.slid.contains(&k);
        let [before, now] = [&x, &after].map(|x| systems.g(k, t, x));
        now.abs() < ON || was_on && now.abs() <= before.abs()
    });
    let on: Vec<usize> = on.collect();
    solution.x = after;
    let next = next_motion(systems, solution, &on, u)?;
    solution.passed.push(Passed {
        t,
        interface,
        kind: Kind::Jumped,
        slid: next.slid.clone(),
        after,
    });
    Ok((next, on))
}
