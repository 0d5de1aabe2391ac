//! What decides on the size of a step, for a map and a tolerance.

use std::fmt::Debug;

use super::map::{OneStep, Step};
use super::step_size::COEFFICIENTS;
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Vector};
use crate::method::{Cursor, Failure, Statistics, StepFailure};

/// What a rejected step is multiplied by.
const SHORTER: f64 = 0.5;
/// So many times a step is made shorter before it is given up.
const MOST_REJECTIONS: u32 = 60;
/// The remaining time is one step where it is less than this many, and halved where it is less
/// than two.
const NEARLY: f64 = 1.000_001;

/// Coefficients of the dense output of a step.
pub(super) const DENSE: usize = COEFFICIENTS + 1;

/// The dense output of a step.
#[derive(Debug)]
pub struct Output<const N: usize> {
    /// The unit of time of the coefficients.
    pub unit: f64,
    /// Those of powers of the time since the start, by component.
    pub coefficients: [[f64; DENSE]; N],
}

/// What goes from segment to segment.
#[derive(Clone, Debug)]
pub struct Carried<const N: usize> {
    /// The step that was made last.
    pub step: f64,
    /// The largest size of each component so far.
    pub sizes: Vector<f64, N>,
}

/// A step of the size that was asked for.
#[derive(Debug)]
pub enum Trial<K, const N: usize> {
    /// It is good.
    Made {
        /// d
        increment: Vector<f64, N>,
        /// What is known of the step.
        known: K,
    },
    /// It is too long; the size that is wanted instead, if that is known.
    TooLong(Option<f64>),
}

/// A step that was made.
pub(super) struct Made<K, const N: usize> {
    pub increment: Vector<f64, N>,
    pub tau: f64,
    pub time: Time,
    /// What is known of it.
    pub known: K,
}

/// How the sizes of steps by a tolerance are decided on: by [`TaylorCoefficients`](crate::TaylorCoefficients) or by an
/// [`ErrorEstimate`](crate::ErrorEstimate).
pub trait StepSizes<Map: OneStep>: Copy + Default + Sync {
    /// What goes from step to step within a segment.
    type Run<const N: usize>: Clone + Debug;
    /// What is known of a step that was made.
    type Known<const N: usize>;

    /// At the start (t, x) of a segment.
    fn begin<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        by: (&Map, f64),
        dynamics: &D,
        start: (f64, &Vector<f64, N>),
        carried: &Carried<N>,
    ) -> Self::Run<N>;

    /// The size of the next step.
    fn wanted<const N: usize>(run: &Self::Run<N>) -> f64;

    /// The largest size of each component so far.
    fn sizes<const N: usize>(run: &Self::Run<N>) -> &[f64];

    /// A step that ends at the time `end`.
    ///
    /// # Errors
    /// If it cannot be made.
    fn attempt<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        map: &Map,
        run: &mut Self::Run<N>,
        step: &Step<'_, D, N>,
        end: f64,
        statistics: &mut Statistics,
    ) -> Result<Trial<Self::Known<N>, N>, StepFailure>;

    /// Forgets what the step before has left, where another one is made in the place of one that was
    /// too long or has `failed`.
    fn restart<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        map: &Map,
        run: &mut Self::Run<N>,
        dynamics: &D,
        failed: bool,
    );

    /// The dense output of a step from x₀ over τ.
    fn dense<const N: usize>(
        map: &Map,
        run: &Self::Run<N>,
        known: &Self::Known<N>,
        step: (&Vector<f64, N>, &Vector<f64, N>, f64),
    ) -> Output<N>;

    /// The coefficients of g along the dense output fall off like powers of this.
    fn decay(map: &Map, tolerance: f64) -> f64;

    /// Moves on to the end of a step.
    fn advance<const N: usize>(run: &mut Self::Run<N>, known: Self::Known<N>);

    /// The run of a solution that is to be reached from a point, whatever its guards do, in steps
    /// like those that were made.
    ///
    /// # Errors
    /// A step that cannot be made; the cursor is at its start.
    fn reach<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
        by: (&Map, f64),
        carried: &Carried<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure>;
}

/// A step as long as it may be: shorter, until it can be made and is not too long.
pub(super) fn shorten<Map, Sizes, D, const N: usize, const M: usize>(
    map: &Map,
    run: &mut Sizes::Run<N>,
    dynamics: &D,
    (start, state, until): (Time, &State<N>, Time),
    statistics: &mut Statistics,
) -> Result<Made<Sizes::Known<N>, N>, Failure>
where
    Map: OneStep,
    Sizes: StepSizes<Map>,
    D: Dynamics<f64, N, M>,
{
    let remaining = until.since(start);
    let mut wanted = Sizes::wanted(run);
    let mut failure = StepFailure::NotFinite;
    for _ in 0..=MOST_REJECTIONS {
        let (tau, time) = match remaining {
            left if left <= wanted * NEARLY => (left, until),
            left if left <= 2.0 * wanted => step_from(dynamics, start, 0.5 * left),
            _ => step_from(dynamics, start, wanted),
        };
        let trial = if tau > 0.0 && time != start {
            let step = Step {
                dynamics,
                t0: start.value,
                x0: &state.x,
                tau,
            };
            Sizes::attempt(map, run, &step, time.value, statistics)
        } else {
            Err(StepFailure::NotFinite)
        };
        let mut instead = None;
        let failed = trial.is_err();
        match trial {
            Ok(Trial::Made { increment, known }) => {
                return Ok(Made {
                    increment,
                    tau,
                    time,
                    known,
                });
            }
            Ok(Trial::TooLong(size)) => instead = size,
            Err(found) => failure = found,
        }
        statistics.rejected += 1;
        wanted = instead.unwrap_or_else(|| wanted.min(remaining) * SHORTER);
        Sizes::restart(map, run, dynamics, failed);
    }
    Err(failure.over(wanted))
}

/// The size and the end of a step of about `tau` from `start`.
fn step_from<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
    dynamics: &D,
    start: Time,
    tau: f64,
) -> (f64, Time) {
    if dynamics.is_autonomous() {
        return (tau, start.after(tau));
    }
    // the formulas are evaluated at a double
    let time = Time::new(start.value + tau);
    (time.since(start), time)
}
