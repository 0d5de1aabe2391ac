//! Steps by an estimate of their error.

use super::super::adaptive::Adaptive;
use super::super::crossing::NewtonLocator;
use super::super::map::{OneStep, Step};
use super::super::step_size::StepSizeControl;
use super::super::step_sizes::{Carried, DENSE, Output, StepSizes, Trial, shorten};
use super::Memory;
use super::embedded::{Collocation, EmbeddedRungeKutta, Estimate};
use super::implicit::Against;
use super::stages::Stages;
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Vector};
use crate::method::{Cursor, Failure, Statistics, StepFailure};

/// The error that a step aims at, as a part of the one that is allowed, is the power q + 1 of this.
const SAFETY: f64 = 0.9;
/// The next step is at most this many times as long.
const LONGEST: f64 = 8.0;
/// And at least this part.
const SHORTEST: f64 = 0.2;
/// The first step, as a part of what the Taylor coefficients allow a method of the same order.
const FIRST: f64 = 0.5;
/// An error below this part of the one allowed counts as this in a prediction.
const LEAST: f64 = 1e-2;
/// An implicit step that would grow by less than this is made as long as the one before, whose
/// matrices serve again.
const KEPT: f64 = 1.2;
/// What the stages are solved to, as a part of the tolerance. (Larger ones save an iteration or two of
/// five, and cost the digits of components that are small beside what they were.)
const UNSOLVED: f64 = 1e-4;
/// The coefficients of g along the dense output fall off like powers of this; it is a polynomial of
/// low degree.
const DECAY: f64 = 0.5;

/// A step is as long as the estimate of the error of the one before allows; see
/// [`EmbeddedRungeKutta`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct ErrorEstimate;

/// What goes from step to step.
#[derive(Clone, Debug)]
pub struct Run<const N: usize> {
    memory: Memory<N>,
    /// What the estimate is held at.
    tolerance: f64,
    /// What the stages are solved to.
    unsolved: f64,
    /// The largest size of each component so far.
    sizes: Vector<f64, N>,
    wanted: f64,
    /// The size and the error of the step before.
    before: Option<(f64, f64)>,
    /// Whether a step from here was rejected.
    was_rejected: bool,
}

/// What is known of a step.
#[derive(Clone, Copy, Debug)]
pub struct Known<const N: usize> {
    /// The stages of an implicit method, the fields at them of an explicit one.
    stages: Stages<N>,
    tau: f64,
    /// As a part of the one that is allowed.
    error: f64,
    /// The size of the next step.
    next: f64,
}

/// A step with its error.
struct Estimated<const N: usize> {
    increment: Vector<f64, N>,
    stages: Stages<N>,
    error: Vector<f64, N>,
}

impl EmbeddedRungeKutta {
    /// Steps by a tolerance: each leaves an error of about `tolerance` relative to the largest size
    /// that each component has had. Between 2.2·10⁻¹⁶ and 0.1; the integrator refuses others.
    pub fn tolerance(self, tolerance: f64) -> Adaptive<Self, NewtonLocator, ErrorEstimate> {
        Adaptive::by(self, tolerance)
    }

    /// q: the error is estimated to O(τ^{q+1}).
    fn estimated_order(&self) -> usize {
        match self.pair.estimate {
            Estimate::Explicit { .. } => self.pair.tableau.order - 1,
            Estimate::Collocation(_) => self.pair.tableau.stages(),
        }
    }

    /// What the estimate is held at, so that the error of the method is about the tolerance.
    fn allowed(&self, tolerance: f64) -> f64 {
        /// Radau IIA of three stages is closest to its tolerance with that (Hairer & Wanner's code
        /// RADAU).
        const PART: f64 = 0.1;
        match self.pair.estimate {
            Estimate::Explicit { .. } => tolerance,
            Estimate::Collocation(_) => {
                let s = self.pair.tableau.stages() as f64;
                PART * tolerance.powf((s + 1.0) / (2.0 * s))
            }
        }
    }

    fn estimated<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, D, N>,
        run: &mut Run<N>,
        statistics: &mut Statistics,
    ) -> Result<Estimated<N>, StepFailure> {
        match &self.pair.estimate {
            Estimate::Explicit { weights, .. } => Ok(self.explicit(step, weights)),
            Estimate::Collocation(cell) => {
                let collocation = cell.get_or_init(|| Collocation::new(self.pair.tableau));
                self.implicit(step, collocation, run, statistics)
            }
        }
    }

    fn explicit<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, D, N>,
        weights: &[f64],
    ) -> Estimated<N> {
        let (increment, mut fields) = step.explicit(self.pair.tableau);
        let end = step.t0 + step.tau;
        let last = self.pair.tableau.stages();
        fields[last] = step.dynamics.vector_field(end, &(step.x0 + increment));
        let terms = weights.iter().zip(&fields);
        let error = terms.fold(Vector::zeros(), |sum, (&e, field)| sum + field * e);
        Estimated {
            increment,
            stages: Stages(fields),
            error: error * step.tau,
        }
    }

    fn implicit<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, D, N>,
        collocation: &Collocation,
        run: &mut Run<N>,
        statistics: &mut Statistics,
    ) -> Result<Estimated<N>, StepFailure> {
        let tableau = self.pair.tableau;
        let predicted = match &run.memory.before {
            Some((stages, tau)) => stages.continued(tableau, step.tau / tau),
            None => Stages::each(tableau, |_| Vector::zeros()),
        };
        let prepared = &mut run.memory.prepared;
        let iterations = statistics.newton_iterations;
        let against = Against::Sizes(&run.sizes, run.unsolved);
        let solved = step.iterate(tableau, predicted, prepared, against, statistics);
        let Some(stages) = solved else {
            return Err(StepFailure::NoConvergence {
                residual: predicted.residual(tableau, step).sizes().amax(),
                iterations: statistics.newton_iterations - iterations,
            });
        };
        let increment = stages.increment(tableau, step);
        let terms = collocation.weights.iter().zip(&stages.0);
        let others = terms.fold(Vector::zeros(), |sum, (&e, z)| sum + z * e);
        // with the field at (t₀, x)
        let mut error = |x: &Vector<f64, N>| {
            let field = step.dynamics.vector_field(step.t0, x);
            let bare = field * (collocation.gamma * step.tau) + others;
            let filtered = prepared.filter(collocation.eigenvalue, &bare);
            filtered.ok_or(StepFailure::NotFinite)
        };
        let mut estimate = error(step.x0)?;
        let sizes = run.sizes.sup(&(step.x0 + increment).abs());
        let is_large = norm(&estimate, &sizes) > run.tolerance;
        if is_large && (run.before.is_none() || run.was_rejected) {
            estimate = error(&(step.x0 + estimate))?;
        }
        Ok(Estimated {
            increment,
            stages,
            error: estimate,
        })
    }
}

/// The Euclidean norm of a vector relative to the sizes of its components.
fn norm<const N: usize>(vector: &Vector<f64, N>, sizes: &Vector<f64, N>) -> f64 {
    let parts = vector.iter().zip(sizes);
    let parts = parts.map(|(x, size)| if *x == 0.0 { 0.0 } else { x / size });
    parts.map(|part| part * part).sum::<f64>().sqrt()
}

impl StepSizes<EmbeddedRungeKutta> for ErrorEstimate {
    type Run<const N: usize> = Run<N>;
    type Known<const N: usize> = Known<N>;

    fn begin<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        (map, tolerance): (&EmbeddedRungeKutta, f64),
        dynamics: &D,
        (t, x): (f64, &Vector<f64, N>),
        carried: &Carried<N>,
    ) -> Run<N> {
        // as long as the Taylor coefficients allow, and with their sizes
        let (order, allowed) = (map.estimated_order(), map.allowed(tolerance));
        let mut control = StepSizeControl::new(order, allowed, carried.sizes.as_slice());
        let expansion = control.expand(dynamics, t, x, carried.step);
        Run {
            memory: map.begin(dynamics, None),
            tolerance: allowed,
            unsolved: UNSOLVED * tolerance,
            sizes: Vector::from_column_slice(control.sizes()),
            wanted: FIRST / expansion.rate,
            before: None,
            was_rejected: false,
        }
    }

    fn wanted<const N: usize>(run: &Run<N>) -> f64 {
        run.wanted
    }

    fn sizes<const N: usize>(run: &Run<N>) -> &[f64] {
        run.sizes.as_slice()
    }

    fn attempt<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        map: &EmbeddedRungeKutta,
        run: &mut Run<N>,
        step: &Step<'_, D, N>,
        _end: f64,
        statistics: &mut Statistics,
    ) -> Result<Trial<Known<N>, N>, StepFailure> {
        let made = map.estimated(step, run, statistics)?;
        let x1 = step.x0 + made.increment;
        let sizes = run.sizes.sup(&x1.abs());
        let error = norm(&made.error, &sizes) / run.tolerance;
        if !(is_finite(&x1) && error.is_finite()) {
            return Err(StepFailure::NotFinite);
        }
        let tau = step.tau;
        let power = 1.0 / (map.estimated_order() + 1) as f64;
        if error > 1.0 {
            let factor = (SAFETY * error.powf(-power)).max(SHORTEST);
            run.was_rejected = true;
            return Ok(Trial::TooLong(Some(tau * factor)));
        }
        run.sizes = sizes;
        let mut factor = SAFETY * error.powf(-power);
        if let Some((before, error_before)) = run.before {
            let trend = SAFETY * tau / before * (error_before / (error * error)).powf(power);
            factor = factor.min(trend);
        }
        factor = factor.clamp(SHORTEST, LONGEST);
        if run.was_rejected {
            factor = factor.min(1.0);
        }
        let keeps = (1.0..=KEPT).contains(&factor)
            && !map.pair.tableau.is_explicit()
            && run.memory.prepared.is_good();
        Ok(Trial::Made {
            increment: made.increment,
            known: Known {
                stages: made.stages,
                tau,
                error: error.max(LEAST),
                next: if keeps { tau } else { tau * factor },
            },
        })
    }

    fn restart<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        _map: &EmbeddedRungeKutta,
        run: &mut Run<N>,
        _dynamics: &D,
        failed: bool,
    ) {
        if failed {
            run.was_rejected = true;
            run.memory.prepared.forget();
            run.memory.before = None;
        }
    }

    fn dense<const N: usize>(
        map: &EmbeddedRungeKutta,
        _run: &Run<N>,
        known: &Known<N>,
        (x0, increment, tau): (&Vector<f64, N>, &Vector<f64, N>, f64),
    ) -> Output<N> {
        let mut coefficients = [[0.0; DENSE]; N];
        let stages = &known.stages.0;
        let last = match &map.pair.estimate {
            Estimate::Explicit { dense, .. } => {
                for (field, weights) in stages.iter().zip(*dense) {
                    for (k, weight) in weights.iter().enumerate() {
                        add(&mut coefficients, k + 1, field, tau * weight);
                    }
                }
                4
            }
            Estimate::Collocation(cell) => {
                let collocation = cell.get_or_init(|| Collocation::new(map.pair.tableau));
                for (j, stage) in stages.iter().take(map.pair.tableau.stages()).enumerate() {
                    for k in 0..collocation.powers.nrows() {
                        add(&mut coefficients, k + 1, stage, collocation.powers[(k, j)]);
                    }
                }
                map.pair.tableau.stages()
            }
        };
        for ((coefficients, x0), increment) in coefficients.iter_mut().zip(x0).zip(increment) {
            coefficients[0] = *x0;
            // to the end of the step, without rounding errors
            coefficients[last] = increment - coefficients[1..last].iter().sum::<f64>();
        }
        Output {
            unit: tau,
            coefficients,
        }
    }

    fn decay(_map: &EmbeddedRungeKutta, _tolerance: f64) -> f64 {
        DECAY
    }

    fn advance<const N: usize>(run: &mut Run<N>, known: Known<N>) {
        run.before = Some((known.tau, known.error));
        run.wanted = known.next;
        run.was_rejected = false;
        run.memory.before = Some((known.stages, known.tau));
    }

    fn reach<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        by: (&EmbeddedRungeKutta, f64),
        carried: &Carried<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure> {
        let x = cursor.state.rounded();
        cursor.state = State::new(x);
        let mut run = Self::begin(by, dynamics, (cursor.time.value, &x), carried);
        // most points are no further than a step of the run
        run.wanted = run.wanted.max(carried.step);
        let (until, mut statistics) = (Time::new(to), Statistics::default());
        while until.since(cursor.time) > 0.0 {
            let from = (cursor.time, &cursor.state, until);
            let made =
                shorten::<_, Self, D, N, M>(by.0, &mut run, dynamics, from, &mut statistics)?;
            cursor.state = cursor.state.after(&made.increment).normalised();
            cursor.time = made.time;
            Self::advance(&mut run, made.known);
        }
        Ok(())
    }
}

/// Adds `factor` times a vector to the coefficients of a power.
fn add<const N: usize>(
    coefficients: &mut [[f64; DENSE]; N],
    power: usize,
    vector: &Vector<f64, N>,
    factor: f64,
) {
    for (coefficients, entry) in coefficients.iter_mut().zip(vector) {
        coefficients[power] += factor * entry;
    }
}
