//! Taylor's method of high order, with conservation.

mod ahead;
mod crossing;
mod reach;
mod segment;
mod steps;

pub(crate) use steps::step_to;

use super::{Cursor, Ended, Failure, InLanes, Method, Sink, Variation, check_tolerance};
use crate::arithmetic::{Scalar, State, Vector};
use crate::contract::Dynamics;
use crate::error::Error;
use crate::events::ends::Decay;
use crate::series::Unroll;

/// Taylor's method
///
/// x₁ = P(τ) − Λᵀ(ΛΛᵀ)⁻¹ (ψ(x₁) − ψ_ref), P(τ) = Σ xₖ τᵏ,
///
/// of an order and with steps that a tolerance decides: the fast scheme, from three digits to
/// all that a double has. The coefficients come from recurrences that `pws!` derives from f.
///
/// A step is the part of the radius of convergence, estimated by the root test on the last two
/// coefficients, over which the first neglected term is below the tolerance relative to the
/// state (Jorba & Zou, Experimental Mathematics 14, 2005, sections 3.1–3.2). After each step,
/// and at each transition, the state is put back on the level of the conserved quantities: up to the
/// square of its displacement where nobody is shown the point, to rounding elsewhere. In a region that
/// no interface bounds steps go on from where they are two times out of three, while that is as near to
/// the level as the tolerance; what is shown lies on it.
/// Every zero of a switching function in a step is found, however slowly its own series
/// converges: see [the front page](crate#every-crossing).
///
/// ```
/// use dmm_runtime::{Integrator, Taylor, pws};
///
/// pws! {
///     /// A pendulum.
///     pub system Pendulum {
///         state q, p;
///         der(q) = p;
///         der(p) = -sin(q);
///         conserved energy = p^2 / 2 - cos(q);
///     }
/// }
///
/// let solution = Integrator::new(&Pendulum {}, Taylor::tolerance(1e-12))
///     .initial(0.0, [0.5, 1.0])
///     .run_until(100.0)?;
/// assert!(solution.statistics().steps < 200);
/// let x = solution.at(100.0)?;
/// assert!((x[1] * x[1] / 2.0 - x[0].cos() - (0.5 - 0.5f64.cos())).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Taylor {
    tolerance: f64,
    level_correction: bool,
}

impl Taylor {
    /// An error of at most about `tolerance` a step, relative to the size of the state: between
    /// 2⁻⁵² and 10⁻¹; the integrator refuses others.
    pub fn tolerance(tolerance: f64) -> Self {
        Self {
            tolerance,
            level_correction: true,
        }
    }

    /// Whether the state is put back on the level of the conserved quantities (default: yes).
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            level_correction,
            ..self
        }
    }

    pub(crate) fn corrects_level(&self) -> bool {
        self.level_correction
    }

    /// The order: where the cost of a unit of time is about least, of a few that straight-line
    /// code is compiled for.
    fn order(&self) -> usize {
        match self.tolerance {
            tolerance if tolerance >= 1e-7 => 12,
            tolerance if tolerance >= 2e-12 => 18,
            _ => 22,
        }
    }

    /// The part of g's terms that g may be off by along a step.
    fn undecided(&self) -> f64 {
        /// Errors of the state enter g by its gradient.
        const MARGIN: f64 = 8.0;
        MARGIN * self.tolerance
    }

    /// Where nothing bounds a region and a displacement towards the level was no larger part of the
    /// state than this, some steps are made without one.
    pub(crate) fn near(&self) -> f64 {
        self.tolerance
    }

    /// The part of a step whose error is below rounding.
    fn finest(&self) -> f64 {
        (f64::EPSILON / self.tolerance).powf(1.0 / self.order() as f64)
    }

    /// The part of the radius of convergence that a step takes.
    fn fraction(&self) -> f64 {
        self.fraction_at(self.order())
    }

    /// The same with steps of another order.
    pub(crate) fn fraction_at(&self, order: usize) -> f64 {
        self.tolerance.powf(1.0 / order as f64)
    }
}

/// What Taylor steps carry from segment to segment.
#[derive(Clone, Copy, Debug)]
pub struct Memory<const N: usize> {
    /// The part of the radius of convergence that a step takes.
    fraction: f64,
    decay: Decay,
    /// The size of the step before, or 0.
    pub(crate) step: f64,
    /// The unit of time of the coefficients.
    pub(crate) unit: f64,
    /// How many steps are still made without a correction of the level.
    pub(crate) free: f64,
    /// The state of steps that were stopped, which is near the level; what was shown of it lies on it.
    stopped: Option<State<N>>,
}

impl Method for Taylor {
    type Memory<const N: usize> = Memory<N>;

    fn check(&self, _t0: f64, _t_end: f64) -> Result<(), Error> {
        check_tolerance(self.tolerance)
    }

    fn in_lanes(&self) -> Option<InLanes> {
        Some(InLanes {
            tolerance: self.tolerance,
            level_correction: self.level_correction,
        })
    }

    fn memory<const N: usize>(&self, _t0: f64, _t_end: f64) -> Memory<N> {
        let fraction = self.fraction();
        Memory {
            fraction,
            decay: Decay::new(fraction),
            step: 0.0,
            unit: 1.0,
            free: 0.0,
            stopped: None,
        }
    }

    fn segment<D, S, const N: usize, const M: usize>(
        &self,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        until: f64,
        memory: &mut Memory<N>,
        sink: &mut S,
    ) -> Result<Ended, Failure>
    where
        D: Dynamics<f64, N, M>,
        S: Sink<N>,
    {
        let segment = segment::Segment {
            method: self,
            cursor,
            until,
            memory,
            sink: &mut sink.erased(),
        };
        let choice = steps::Choose::<D, _, N, M> { segment, dynamics };
        D::Unrolled::choose(self.order(), choice)
    }

    fn reach<D, const N: usize, const M: usize>(
        &self,
        memory: &Memory<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure>
    where
        D: Dynamics<f64, N, M>,
    {
        let reach = reach::Reach::<D, N, M> {
            method: self,
            dynamics,
            cursor,
            to,
            unit: memory.unit,
        };
        D::Unrolled::choose(self.order(), reach)
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        step.flow::<M>()
    }
}
