//! Nearly tangential crossings: an orbit that passes a wall at an angle α and comes back, or
//! just does not reach it.
//!
//! From (−1, α) the circle p² + q² = 1 + α² comes to the wall q = c = 1 with the rate α, and
//! back after 2 atan α; for the force −q³ the orbit is p²/2 + q⁴/4. Whether it reaches a wall
//! near its apex is decided by exact rational arithmetic on the doubles that are given.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use dmm_runtime::{Error, ErrorKind};
use num_rational::BigRational;

use super::report::{Extent, Observe, Row, Verdict, kind_of};
use super::setting::{SETTINGS, Setting};
use super::systems::{circle, quartic};
use crate::problem::{AnyObserver, Crossed, Problem, Run};
use dmm_picture::{Axis, Look, Panel, Scale, Stroke};

/// Steps in the half turn before the wall.
const STEPS: f64 = 200.0;

/// A kind of orbit.
struct Kind {
    problem: fn() -> Problem,
    /// The conserved quantity as a function of q and p, times a constant.
    level: fn(&BigRational, &BigRational) -> BigRational,
    /// q at the apex of the orbit from (−1, α).
    apex: fn(f64) -> f64,
    /// A time after the apex and before the orbit is back at its start.
    after: f64,
}

const KINDS: [Kind; 2] = [
    Kind {
        problem: circle,
        level: |q, p| q * q + p * p,
        apex: |alpha| (1.0 + alpha * alpha).sqrt(),
        after: 5.0,
    },
    Kind {
        problem: quartic,
        level: |q, p| q * q * q * q + p * p + p * p,
        apex: |alpha| (1.0 + 2.0 * alpha * alpha).sqrt().sqrt(),
        after: 6.0,
    },
];

/// What a run counted, and the time of its first crossing.
#[derive(Default)]
struct Count {
    crossings: usize,
    first: Option<f64>,
}

impl AnyObserver for Count {
    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.crossings += 1;
        self.first.get_or_insert(crossed.t);
        ControlFlow::Continue(())
    }

    fn record_every(&self) -> u64 {
        0
    }
}

/// How many cases ended how.
#[derive(Default)]
struct Tally {
    right: usize,
    touches: usize,
    refused: Vec<String>,
    wrong: Vec<String>,
}

pub(super) fn study(extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    let per_decade = extent.of(10, 1);
    let mut panel = Panel::new(
        "circle: crossing at the angle α",
        Axis::new("α", Scale::Decades),
        Axis::new("|t − t*| of the first crossing", Scale::Decades),
    );
    for (kind, shown) in KINDS.iter().zip([true, false]) {
        for (k, setting) in SETTINGS.into_iter().enumerate() {
            let name = (kind.problem)().description().name;
            if observer
                .begins(&format!("{name}, {}", setting.name))
                .is_break()
            {
                return vec![panel];
            }
            let mut tally = Tally::default();
            let mut curve = Vec::new();
            let count = angles(per_decade).count() as f64;
            for (number, alpha) in angles(per_decade).enumerate() {
                if observer.at(number as f64 / count).is_break() {
                    return vec![panel];
                }
                for c in walls(kind, alpha) {
                    let first = tally.judge(kind, &setting, alpha, c);
                    if let Some(t) = first.filter(|_| c == 1.0) {
                        // a time that is right to the last bit has a place on the axis, too
                        let error = (t - first_crossing(alpha)).abs();
                        curve.push((alpha, error.max(f64::EPSILON)));
                    }
                }
            }
            observer.ended(tally.row(name, setting.name));
            if shown {
                let label = Some(setting.name.to_owned());
                panel.curve(label, curve, Stroke::Marked, Look::nth(k));
            }
        }
    }
    vec![panel]
}

/// The time from (−1, α) to the wall at 1, on the circle: t* = π − 2 atan α.
fn first_crossing(alpha: f64) -> f64 {
    std::f64::consts::PI - 2.0 * alpha.atan()
}

/// From 10⁻¹ down to 10⁻¹².
fn angles(per_decade: i32) -> impl Iterator<Item = f64> {
    (per_decade..=12 * per_decade).map(move |k| 10f64.powf(-f64::from(k) / f64::from(per_decade)))
}

/// The wall that is met at the angle α, and walls within a few roundings of the apex.
fn walls(kind: &Kind, alpha: f64) -> [f64; 6] {
    let apex = (kind.apex)(alpha);
    let down = apex.next_down();
    let up = apex.next_up();
    [1.0, down.next_down(), down, apex, up, up.next_up()]
}

/// How often the wall at c is crossed in a turn: twice, or not at all. At the very apex it is
/// touched.
fn exact(kind: &Kind, alpha: f64, c: f64) -> Option<usize> {
    let rational = |value: f64| BigRational::from_float(value);
    let level = (kind.level)(&rational(-1.0)?, &rational(alpha)?);
    let wall = (kind.level)(&rational(c)?, &rational(0.0)?);
    Some(match level.cmp(&wall) {
        Ordering::Greater => 2,
        Ordering::Equal | Ordering::Less => 0,
    })
}

impl Tally {
    /// Makes a run and counts it; the time of the first crossing if there is one.
    fn judge(&mut self, kind: &Kind, setting: &Setting, alpha: f64, c: f64) -> Option<f64> {
        let mut problem = (kind.problem)();
        problem.set_parameter("c", c);
        let run = Run {
            step_size: std::f64::consts::PI / STEPS,
            initial: vec![-1.0, alpha],
            t_end: kind.after,
            ..setting.run(&problem)
        };
        let mut count = Count::default();
        let result = problem.integrate(&run, &mut count);
        let expected = exact(kind, alpha, c);
        let what = || format!("α = {alpha:.0e}, c = 1 + {:.1e}", c - 1.0);
        match result {
            Err(error) if is_about_tangency(&error) => {
                self.refused
                    .push(format!("{}: {}", what(), kind_of(&error)));
            }
            Ok(_) if Some(count.crossings) == expected => self.right += 1,
            Ok(finish) if count.crossings == 0 && finish.statistics.grazes > 0 => {
                self.touches += 1;
            }
            Ok(_) => self
                .wrong
                .push(format!("{}: {} crossings", what(), count.crossings)),
            Err(error) => self.wrong.push(format!("{}: {}", what(), kind_of(&error))),
        }
        count.first
    }

    fn row(self, problem: &str, scheme: &str) -> Row {
        let Self {
            right,
            touches,
            refused,
            wrong,
        } = self;
        let mut finding = format!("{right} counted right, {touches} told as touches");
        for (cases, how) in [(&refused, "refused"), (&wrong, "wrong")] {
            if let Some(first) = cases.first() {
                finding.push_str(&format!(", {} {how} ({first})", cases.len()));
            }
        }
        let verdict = Verdict::within(wrong.is_empty());
        Row::new(
            format!("{problem}, α from 1e-1 to 1e-12"),
            scheme,
            verdict,
            finding,
        )
    }
}

fn is_about_tangency(error: &Error) -> bool {
    matches!(
        error.kind,
        ErrorKind::Tangential { .. } | ErrorKind::LocationFailed { .. }
    )
}
