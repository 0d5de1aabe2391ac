//! Failures on purpose: of the implicit solve, of the locator, of formulas. Each has to end in
//! its typed error, with everything that was integrated before it.

use dmm_runtime::{
    Correction, Crossing, Dynamics, ErrorKind, Integrator, Interrupted, Located, Locator, Method,
    OneStep, Statistics, Step, StepFailure, Symmetric, System, Taylor, Uniform, Vector, pws,
};

use super::report::{Extent, Observe, Row, Verdict, kind_of};
use crate::systems::Elliptic;
use dmm_picture::Panel;

pws! {
    /// ẋ = x², which is infinite at t = 1/x(0).
    pub system Blowup {
        state x;
        der(x) = x^2;
    }
}

pws! {
    /// Falls at a steady rate to where ln x ends.
    pub system Logarithm {
        state x, y;
        der(x) = -1;
        der(y) = ln(x);
    }
}

pws! {
    /// Both fields point at the interface where y > 0.
    pub system Stuck {
        state x, y;
        interface wall = x;
        region right where wall > 0 {
            der(x) = -1;
            der(y) = 0;
        }
        region left where wall < 0 {
            der(x) = y;
            der(y) = 0;
        }
    }
}

pws! {
    /// The field beyond the interface is tangential to it where it is met.
    pub system Tangent {
        state x, y;
        interface wall = x;
        region right where wall > 0 {
            der(x) = -1;
            der(y) = 0;
        }
        region left where wall < 0 {
            der(x) = y - 1;
            der(y) = x;
        }
    }
}

const STEP_SIZE: f64 = 0.01;
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
    for tolerance in [1e-3, 1e-12] {
        let scheme = Taylor::tolerance(tolerance);
        formulas(observer, &format!("Taylor {tolerance:e}"), &scheme);
    }
    formulas(observer, "Symmetric", &Symmetric::step_size(STEP_SIZE));
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
    judge(what, "Symmetric", expected, result)
}

/// Formulas that have no value, and fields that do not say how to go on.
fn formulas<Sch: Method>(observer: &mut dyn Observe, name: &str, scheme: &Sch) {
    let mut row = |row| observer.ended(row);
    row(refused(
        "blow-up at t = 1",
        "left the domain",
        name,
        &Blowup {},
        scheme,
        [1.0],
    ));
    row(refused(
        "logarithm ends at t = 1",
        "left the domain",
        name,
        &Logarithm {},
        scheme,
        [1.0, 0.0],
    ));
    row(refused(
        "sliding from t = 1",
        "sliding",
        name,
        &Stuck {},
        scheme,
        [1.0, 1.0],
    ));
    row(refused(
        "tangential at t = 1",
        "tangential",
        name,
        &Tangent {},
        scheme,
        [1.0, 1.0],
    ));
}

/// A run that has to be refused in the expected way.
fn refused<Sys: System<N>, Sch: Method, const N: usize>(
    what: &str,
    expected: &str,
    name: &str,
    system: &Sys,
    scheme: &Sch,
    x0: [f64; N],
) -> Row {
    let problem = Integrator::new(system, scheme.clone()).initial(0.0, x0);
    judge(what, name, expected, problem.run_until(T_END))
}

/// All these runs have to be refused, at t = 1 or at the first step or crossing after it, with
/// the solution that was there before.
fn judge<Sys: System<N>, Sch: Method, const N: usize>(
    what: &str,
    scheme: &str,
    expected: &str,
    result: Result<dmm_runtime::Solution<Sys, Sch, N>, Interrupted<Sys, Sch, N>>,
) -> Row {
    let interrupted = match result {
        Ok(_) => return Row::new(what, scheme, Verdict::Wrong, "integrated to the end"),
        Err(interrupted) => interrupted,
    };
    let error = interrupted.error();
    // where a solution ends is met in one way or another
    let is_blow_up = matches!(error.kind, ErrorKind::NewtonFailed { .. });
    let found = if is_blow_up && what.starts_with("blow-up") {
        expected
    } else {
        kind_of(error)
    };
    let reached = interrupted.solution().last();
    let reached = reached.map_or(f64::NAN, |point| point.t);
    // the last points of a solution that ends at 1 may be a step before it or after
    let holds = found == expected && (0.8..=1.5).contains(&reached);
    let finding = format!("{} at t = {reached:.3}", kind_of(interrupted.error()));
    let verdict = if holds {
        Verdict::Refused
    } else {
        Verdict::Wrong
    };
    Row::new(what, scheme, verdict, finding)
}
