//! Failures on purpose: of the implicit solve, of the locator, of formulas. Each has to end in
//! its typed error, with everything that was integrated before it.

use std::ops::ControlFlow;

use dmm_runtime::{
    Correction, Crossing, Dynamics, Error, ErrorKind, Integrator, Located, Locator, Method,
    OneStep, Statistics, Step, StepFailure, Symmetric, Uniform, Vector,
};

use super::report::{Extent, Observe, Row, Verdict, kind_of};
use super::setting::Setting;
use super::systems::{blowup, logarithm, stuck, tangent};
use crate::method::{MethodName, Run};
use crate::problem::{AnyObserver, Record};
use crate::systems::Elliptic;
use dmm_picture::Panel;

const STEP_SIZE: f64 = 0.01;
/// Of formulas.
const SETTINGS: [Setting; 3] = [
    Setting::tolerance("Taylor 1e-3", MethodName::Taylor, 1e-3),
    Setting::tolerance("Taylor 1e-12", MethodName::Taylor, 1e-12),
    Setting::steps("Symmetric", MethodName::Symmetric, STEP_SIZE),
];
/// When the injected failures begin.
const FROM: f64 = 1.0;
const T_END: f64 = 3.0;

pub(super) fn study(_extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
    if observer.begins("solvers and locators").is_break() {
        return Vec::new();
    }
    let stuck = StepFailure::NoConvergence {
        residual: 1.0,
        iterations: 30,
    };
    observer.ended(solver("no convergence", stuck));
    observer.ended(solver("no finite value", StepFailure::NotFinite));
    observer.ended(silent_solver());
    for (what, locator) in [
        ("locator finds nothing", Faulty::Nothing),
        ("locator returns no number", Faulty::NotFinite),
    ] {
        observer.ended(located(what, locator));
    }
    if observer.begins("formulas").is_break() {
        return Vec::new();
    }
    SETTINGS
        .iter()
        .for_each(|setting| formulas(observer, setting));
    Vec::new()
}

/// [`Symmetric`], until it fails.
#[derive(Clone)]
struct Failing {
    failure: Option<StepFailure>,
}

impl OneStep for Failing {
    type Memory<const N: usize> = ();

    fn order(&self) -> usize {
        2
    }

    fn begin<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        _dynamics: &F,
        _step_size: Option<f64>,
    ) {
    }

    fn step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        match self.failure {
            _ if step.t0 < FROM => Symmetric.step(step, statistics),
            Some(failure) => Err(failure),
            // a solver that does not notice
            None => Ok(Vector::from_element(f64::NAN)),
        }
    }

    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        Symmetric.correction(step, increment)
    }
}

/// A locator that cannot do what it should.
#[derive(Clone, Copy)]
enum Faulty {
    Nothing,
    NotFinite,
}

impl Locator for Faulty {
    fn locate<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        _crossing: &Crossing<'_, Map, F, N>,
        _statistics: &mut Statistics,
    ) -> Option<Located<N>> {
        match self {
            Self::Nothing => None,
            Self::NotFinite => Some(Located {
                elapsed: f64::NAN,
                increment: Vector::from_element(f64::NAN),
            }),
        }
    }
}

fn solver(what: &str, failure: StepFailure) -> Row {
    let expected = match failure {
        StepFailure::NoConvergence { .. } => "Newton failed",
        StepFailure::NotFinite => "left the domain",
    };
    let failing = Failing {
        failure: Some(failure),
    };
    let method = Uniform::new(failing, STEP_SIZE);
    elliptic(&format!("solver: {what}"), expected, method)
}

fn silent_solver() -> Row {
    let method = Uniform::new(Failing { failure: None }, STEP_SIZE);
    elliptic("solver: NaN in silence", "left the domain", method)
}

fn located(what: &str, locator: Faulty) -> Row {
    let method = Symmetric::step_size(STEP_SIZE).locator(locator);
    elliptic(what, "location failed", method)
}

/// A run of `elliptic` that has to stop with the expected error, with the points until then.
fn elliptic<Met: Method>(what: &str, expected: &str, method: Met) -> Row {
    let system = Elliptic::default();
    let result = Integrator::new(&system, method)
        .initial(0.0, [-1.0, -1.0])
        .run_until(T_END);
    let ended = result.err().map(|interrupted| {
        let reached = interrupted
            .solution()
            .last()
            .map_or(f64::NAN, |point| point.t);
        (reached, interrupted.into())
    });
    judge(what, "Symmetric", expected, ended)
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
