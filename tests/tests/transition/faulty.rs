//! Schemes and locators of one's own that fail: a run ends in a typed error, with everything that was
//! integrated before it.

use dmm_problems::systems::Elliptic;
use dmm_runtime::{
    Correction, Crossing, Dynamics, ErrorKind, Integrator, Located, Locator, Method, OneStep,
    Statistics, Step, StepFailure, Symmetric, Uniform, Vector,
};

const STEP_SIZE: f64 = 0.01;
/// When failures begin.
const FROM: f64 = 1.0;
const T_END: f64 = 3.0;

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

/// The error of a run of `elliptic`, which has to come at t = 1 or at the first crossing after it, with
/// the points until then.
fn error(method: impl Method) -> ErrorKind {
    let interrupted = Integrator::new(&Elliptic::default(), method)
        .initial(0.0, [-1.0, -1.0])
        .run_until(T_END)
        .err()
        .unwrap();
    let reached = interrupted.solution().last().unwrap().t;
    assert!((0.8..=1.5).contains(&reached), "{reached}");
    interrupted.error().kind.clone()
}

#[test]
fn a_solver_that_fails_ends_the_run() {
    let error = |failure| error(Uniform::new(Failing { failure }, STEP_SIZE));
    let unsolved = StepFailure::NoConvergence {
        residual: 1.0,
        iterations: 30,
    };
    assert!(matches!(
        error(Some(unsolved)),
        ErrorKind::NewtonFailed { .. }
    ));
    let kind = error(Some(StepFailure::NotFinite));
    assert!(matches!(kind, ErrorKind::LeftDomain), "{kind:?}");
    let silent = error(None);
    assert!(matches!(silent, ErrorKind::LeftDomain), "{silent:?}");
}

#[test]
fn a_locator_that_fails_ends_the_run() {
    for locator in [Faulty::Nothing, Faulty::NotFinite] {
        let kind = error(Symmetric::step_size(STEP_SIZE).locator(locator));
        assert!(matches!(kind, ErrorKind::LocationFailed { .. }), "{kind:?}");
    }
}
