//! Failures of formulas. Each has to end in its typed error, with everything that was integrated before
//! it.

use std::ops::ControlFlow;

use dmm_runtime::{Error, ErrorKind};

use super::report::{Extent, Observe, Row, Verdict, kind_of};
use super::setting::Setting;
use super::systems::{blowup, logarithm, stuck, tangent};
use crate::method::{MethodName, Run};
use crate::problem::{AnyObserver, Record};
use dmm_picture::Panel;

const STEP_SIZE: f64 = 0.01;
/// Of formulas.
const SETTINGS: [Setting; 3] = [
    Setting::tolerance("Taylor 1e-3", MethodName::Taylor, 1e-3),
    Setting::tolerance("Taylor 1e-12", MethodName::Taylor, 1e-12),
    Setting::steps("Symmetric", MethodName::Symmetric, STEP_SIZE),
];
const T_END: f64 = 3.0;

pub(super) fn study(_extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    for setting in &SETTINGS {
        if observer.begins(setting.name).is_break() {
            break;
        }
        formulas(observer, setting);
    }
    Vec::new()
}

/// Formulas that have no value, and fields that do not say how to go on.
fn formulas(observer: &mut dyn Observe, setting: &Setting) {
    for (what, expected, problem) in [
        ("blow-up at t = 1", "left the domain", blowup()),
        ("logarithm ends at t = 1", "left the domain", logarithm()),
        ("sliding from t = 1", "sliding", stuck()),
        ("tangential at t = 1", "tangential", tangent()),
    ] {
        let run = Run {
            t_end: T_END,
            ..setting.run(&problem)
        };
        let mut last = Last(f64::NAN);
        let error = problem.integrate(&run, &mut last).err();
        let ended = error.map(|error| (last.0, error));
        observer.ended(judge(what, setting.name, expected, ended));
    }
}

/// The time of the last point.
struct Last(f64);

impl AnyObserver for Last {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        self.0 = record.t;
        ControlFlow::Continue(())
    }
}

/// All these runs have to be refused, at t = 1 or at the first step or crossing after it, with
/// the solution that was there before: where it ended, and by which error.
fn judge(what: &str, scheme: &str, expected: &str, ended: Option<(f64, Error)>) -> Row {
    let Some((reached, error)) = ended else {
        return Row::new(what, scheme, Verdict::Wrong, "integrated to the end");
    };
    // where a solution ends is met in one way or another
    let is_blow_up = matches!(error.kind, ErrorKind::NewtonFailed { .. });
    let found = if is_blow_up && what.starts_with("blow-up") {
        expected
    } else {
        kind_of(&error)
    };
    // the last points of a solution that ends at 1 may be a step before it or after
    let holds = found == expected && (0.8..=1.5).contains(&reached);
    let finding = format!("{} at t = {reached:.3}", kind_of(&error));
    let verdict = if holds {
        Verdict::Refused
    } else {
        Verdict::Wrong
    };
    Row::new(what, scheme, verdict, finding)
}
