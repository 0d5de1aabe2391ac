//! The best that a system allows, mode by mode.

use super::exact::{self, is_exact, is_exact_type};
use super::taylor::{self, Taylor};
use super::{Cursor, Ended, Failure, Method, Sink, Variation};
use crate::arithmetic::{Scalar, Vector};
use crate::contract::Dynamics;
use crate::error::Error;

/// The best scheme for each region of a system: its exact flow where it has one, [`Taylor`]'s
/// method elsewhere.
///
/// | region | scheme |
/// |---|---|
/// | f = A x + b with A and b depending on parameters alone, at most 8 states, every switching function that bounds the region affine | exact flow |
/// | any other | [`Taylor`] with the tolerance |
///
/// The **exact flow** of ẋ = A x + b over a time h is
///
/// x₁ = exp(hA) x₀ + ∫₀ʰ exp(sA) b ds,
///
/// computed in pairs of doubles once a run and step size: there is no truncation error, whatever
/// the tolerance. A singular or defective A is like any other (Moler & Van Loan, SIAM Review 45,
/// 2003). Steps are as long as the switching functions allow. Every crossing is found: it is
/// excluded by a bound of g⁗ along the step, or located on the flow, to the last bit of a pair of
/// doubles. A stiff region takes short steps only while its fast modes decay. Between crossings
/// there may be few points; ask for output times to see the solution there. Rates ‖A‖ may lie
/// between 10⁻¹⁸ and 10¹⁸ in the unit of time; the powers of others leave the range of doubles, and
/// their crossings are refused.
///
/// Regions of both kinds may be in one system. A crossing changes the scheme, no more.
///
/// ```
/// use dmm_runtime::{Best, Integrator, pws};
///
/// pws! {
///     /// An oscillator whose spring stiffens below y = 0.
///     pub system Oscillator {
///         state x, y;
///         interface spring = y;
///         region above where spring > 0 {
///             der(x) = y;
///             der(y) = -x;
///             conserved energy = (y^2 + x^2) / 2;
///         }
///         region below where spring < 0 {
///             der(x) = y;
///             der(y) = -4 * x;
///             conserved energy = (y^2 + 4 * x^2) / 2;
///         }
///     }
/// }
///
/// let solution = Integrator::new(&Oscillator {}, Best::tolerance(1e-12))
///     .initial(0.0, [0.0, 1.0])
///     .run_until(1000.0)?;
/// // half a circle above, half an ellipse below: a period of π + π/2
/// let crossings = solution.transitions();
/// assert_eq!(crossings.len(), 424);
/// let last = 211.5 * 1.5 * std::f64::consts::PI + 0.25 * std::f64::consts::PI;
/// assert!((crossings[423].t - last).abs() < 1e-11, "{}", crossings[423].t);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Best {
    taylor: Taylor,
}

impl Best {
    /// An error of at most about `tolerance` a step, relative to the size of the state, where a
    /// region has no exact flow: between 2⁻⁵² and 10⁻¹; the integrator refuses others.
    pub fn tolerance(tolerance: f64) -> Self {
        Self {
            taylor: Taylor::tolerance(tolerance),
        }
    }

    /// Whether the state is put back on the level of the conserved quantities (default: yes).
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            taylor: self.taylor.level_correction(level_correction),
        }
    }
}

/// What steps of either kind carry from segment to segment.
#[derive(Clone, Debug)]
pub struct Memory<const N: usize> {
    taylor: taylor::Memory<N>,
    exact: exact::Memory<N>,
}

impl Method for Best {
    type Memory<const N: usize> = Memory<N>;

    fn check(&self, t0: f64, t_end: f64) -> Result<(), Error> {
        self.taylor.check(t0, t_end)
    }

    fn memory<const N: usize>(&self, t0: f64, t_end: f64) -> Memory<N> {
        Memory {
            taylor: self.taylor.memory::<N>(t0, t_end),
            exact: exact::Memory::default(),
        }
    }

    fn forget_modes<const N: usize>(&self, memory: &mut Memory<N>) {
        memory.exact = exact::Memory::default();
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
        if const { matches!(is_exact_type::<D, N, M>(), Some(true)) }
            || const { is_exact_type::<D, N, M>().is_none() } && is_exact(dynamics)
        {
            let sink = (sink, self.taylor.corrects_level());
            exact::segment(dynamics, cursor, until, &mut memory.exact, sink)
        } else {
            (self.taylor).segment(dynamics, cursor, until, &mut memory.taylor, sink)
        }
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
        if const { matches!(is_exact_type::<D, N, M>(), Some(true)) }
            || const { is_exact_type::<D, N, M>().is_none() } && is_exact(dynamics)
        {
            exact::reach(dynamics, cursor, to)
        } else {
            self.taylor.reach(&memory.taylor, dynamics, cursor, to)
        }
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
