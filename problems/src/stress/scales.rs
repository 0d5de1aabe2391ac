//! Scales: the same orbit with states from 10⁻¹⁵⁰ to 10¹⁵⁰ times as large.
//!
//! The oscillator is linear: a state s times as large moves in the same time. With the force
//! −q³ it moves s times as fast, and ψ is s⁴ times as large; below s = 10⁻⁷⁰ it would be lost to
//! underflow.

use super::report::{Extent, Observe, Row, Verdict};
use super::setting::{SETTINGS, Setting};
use super::systems::{circle, quartic};
use crate::problem::{AnyObserver, OutputTimes, Problem, Run};
use dmm_picture::Panel;
use dmm_runtime::Error;

/// The states agree but for rounding errors; of a quartic ψ at the small end most digits are lost
/// to underflow, and steps are solved to a part of the state.
const BOUND: f64 = 1e-10;
const T_END: f64 = 20.0;

/// A problem, the power of the scale that the rate of its motion goes with, and the decades
/// over which it is scaled.
struct Case {
    problem: fn() -> Problem,
    speed: i32,
    decades: (i32, i32),
}

const CASES: [Case; 2] = [
    Case {
        problem: circle,
        speed: 0,
        decades: (-150, 150),
    },
    Case {
        problem: quartic,
        speed: 1,
        decades: (-70, 150),
    },
];

pub(super) fn study(extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    let stride = extent.of(5, 25);
    for case in CASES {
        for setting in SETTINGS {
            let name = (case.problem)().description().name;
            let begins = observer.begins(&format!("{name}, {}", setting.name));
            if begins.is_break() {
                return Vec::new();
            }
            match row(&case, &setting, stride, observer) {
                Some(row) => observer.ended(row),
                None => return Vec::new(),
            }
        }
    }
    Vec::new()
}

/// Nothing if the case was stopped.
fn row(case: &Case, setting: &Setting, stride: usize, observer: &mut dyn Observe) -> Option<Row> {
    let name = (case.problem)().description().name;
    let (first, last) = case.decades;
    let what = format!("{name}, states times 1e{first} to 1e{last}");
    let plain = match scaled(case, setting, 0) {
        Ok(plain) => plain,
        Err(error) => return Some(Row::refused(what, setting.name, &error)),
    };
    let mut worst: f64 = 0.0;
    let mut refused = Vec::new();
    for decade in (first..=last).step_by(stride) {
        let share = f64::from(decade - first) / f64::from(last - first);
        if observer.at(share).is_break() {
            return None;
        }
        match scaled(case, setting, decade) {
            Ok(state) => worst = worst.max(distance(&state, &plain)),
            Err(error) => refused.push((decade, super::report::kind_of(&error))),
        }
    }
    let mut finding = format!("the same to {worst:.1e}");
    if let (Some(first), Some(last)) = (refused.first(), refused.last()) {
        finding.push_str(&format!(
            "; refused from 1e{} to 1e{}: {}",
            first.0, last.0, first.1
        ));
    }
    // a unit of time that is a power of two makes other steps, by a few parts in a hundred
    let bound = BOUND.max((300.0 * setting.tolerance).min(0.05));
    let verdict = Verdict::within(worst <= bound);
    Some(Row::new(what, setting.name, verdict, finding))
}

/// The largest difference of components; infinite if one is not a number.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |worst: f64, d| {
        if d.is_nan() {
            f64::INFINITY
        } else {
            worst.max(d)
        }
    })
}

/// The last state.
struct Last(Vec<f64>);

impl AnyObserver for Last {
    fn output(&mut self, _t: f64, x: &[f64]) {
        self.0 = x.to_vec();
    }

    fn record_every(&self) -> u64 {
        0
    }
}

/// The final state of the orbit that is 10^`decade` times as large (to the next power of two,
/// by which products are exact), divided by its scale.
fn scaled(case: &Case, setting: &Setting, decade: i32) -> Result<Vec<f64>, Error> {
    let exponent = (f64::from(decade) * std::f64::consts::LOG2_10).round();
    let scale = exponent.exp2();
    let faster = scale.powi(case.speed);
    let mut problem = (case.problem)();
    problem.set_parameter("c", 0.5 * scale);
    let t_end = T_END / faster;
    let [q, p] = [0.25, 0.75];
    let run = Run {
        step_size: setting.step_size / faster,
        initial: vec![q * scale, p * scale * faster],
        t_end,
        output_times: OutputTimes::At(vec![t_end]),
        ..setting.run(&problem)
    };
    let mut last = Last(vec![f64::NAN; 2]);
    problem.integrate(&run, &mut last)?;
    Ok(vec![last.0[0] / scale, last.0[1] / (scale * faster)])
}
