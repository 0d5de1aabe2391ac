//! Ratios of stiffness: the oscillator whose spring is up to 10⁸ times as stiff below y = 0 as
//! above. Times of crossings are known: π/4, then half periods π/√k in turn.

use std::f64::consts::{FRAC_PI_4, PI};
use std::ops::ControlFlow;

use super::report::{Extent, Observe, Row, Verdict};
use super::setting::{SETTINGS, Setting};
use crate::method::Control;
use crate::problem::{AnyObserver, Crossed, Run};
use crate::registry::find;
use dmm_picture::{Axis, Look, Panel, Scale, Stroke};

/// Steps in a half period of the stiffer side.
const STEPS: f64 = 50.0;

/// Times of crossings.
#[derive(Default)]
struct Crossings(Vec<f64>);

impl AnyObserver for Crossings {
    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.0.push(crossed.t);
        ControlFlow::Continue(())
    }

    fn record_every(&self) -> u64 {
        0
    }
}

pub(super) fn study(extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    let pairs = extent.of(100, 3);
    let largest = extent.of(8, 4);
    let mut panel = Panel::new(
        "last crossing",
        Axis::new("ratio of the stiffnesses", Scale::Decades),
        Axis::new("relative error of its time", Scale::Decades),
    );
    for (k, setting) in SETTINGS.into_iter().enumerate() {
        if observer.begins(setting.name).is_break() {
            break;
        }
        let mut curve = Vec::new();
        let mut worst = Row::new(
            format!("ratios up to 1e{largest}, {} crossings", 2 * pairs),
            setting.name,
            Verdict::Survived,
            "all crossings counted",
        );
        let mut largest_error: f64 = 0.0;
        for exponent in 0..=largest {
            if observer
                .at(f64::from(exponent) / f64::from(largest + 1))
                .is_break()
            {
                return vec![panel];
            }
            let ratio = 10f64.powi(exponent);
            match error(&setting, ratio, pairs) {
                Ok(error) => {
                    curve.push((ratio, error.max(f64::EPSILON)));
                    largest_error = largest_error.max(error / bound(&setting, pairs));
                    if error.is_nan() || error > bound(&setting, pairs) {
                        worst.verdict = Verdict::Wrong;
                    }
                }
                Err(reason) => {
                    worst.verdict = Verdict::Wrong;
                    worst.finding = format!("ratio {ratio:e}: {reason}");
                }
            }
        }
        if worst.verdict == Verdict::Survived || largest_error > 1.0 {
            worst.finding.push_str(&format!(
                "; time off by at most {largest_error:.2} of the bound"
            ));
        }
        observer.ended(worst);
        panel.curve(
            Some(setting.name.to_owned()),
            curve,
            Stroke::Marked,
            Look::nth(k),
        );
    }
    vec![panel]
}

/// What the relative error of the last crossing's time may be.
fn bound(setting: &Setting, pairs: u32) -> f64 {
    match setting.method.control() {
        // (ωτ)²/12 with ωτ = π/STEPS, and what the split step at a crossing adds to it; higher
        // orders are better
        Control::StepSize { .. } => (PI / STEPS).powi(2) / 4.0,
        // tolerances are relative to a step; the error of the phase adds up
        Control::Tolerance => (10.0 * setting.tolerance + f64::EPSILON) * f64::from(10 * pairs),
    }
}

/// The relative error of the last crossing's time, if all are there.
fn error(setting: &Setting, ratio: f64, pairs: u32) -> Result<f64, String> {
    let mut problem = find("harmonic").map_err(|unknown| unknown.to_string())?;
    for (parameter, value) in [("k_above", 1.0), ("k_below", ratio)] {
        if !problem.set_parameter(parameter, value) {
            return Err(format!("no parameter {parameter}"));
        }
    }
    let below = PI / ratio.sqrt();
    let last = FRAC_PI_4 + f64::from(pairs) * below + f64::from(pairs - 1) * PI;
    let run = Run {
        step_size: below.min(PI) / STEPS,
        initial: vec![1.0, 1.0],
        // half way to the next crossing
        t_end: last + 0.5 * PI,
        ..setting.run(&problem)
    };
    let mut crossings = Crossings::default();
    problem
        .integrate(&run, &mut crossings)
        .map_err(|error| error.to_string())?;
    let expected = 2 * pairs as usize;
    match (crossings.0.len() == expected, crossings.0.last()) {
        (true, Some(t)) => Ok((t - last).abs() / last),
        _ => Err(format!(
            "{} crossings instead of {expected}",
            crossings.0.len()
        )),
    }
}
