//! One-step maps: what a scheme is asked for.

use std::fmt::Debug;

use crate::arithmetic::Scalar;
use crate::contract::{Dynamics, Vector};
use crate::method::{Statistics, StepFailure, Variation};

/// A step to be made.
#[derive(Debug)]
pub struct Step<'a, F, const N: usize> {
    /// The dynamics of the mode.
    pub dynamics: &'a F,
    /// t₀, the start of the step.
    pub t0: f64,
    /// x₀, the state there.
    pub x0: &'a Vector<f64, N>,
    /// τ, its size.
    pub tau: f64,
}

/// A one-step scheme.
///
/// The scheme is asked for increments d = x₁ − x₀ rather than for x₁, so that they keep their
/// relative accuracy however small the step.
pub trait OneStep: Clone + Sync {
    /// What is remembered from step to step within a segment.
    type Memory<const N: usize>: Clone + Debug;

    /// Whether a step conserves ψ but for rounding errors. Where it does not, the correction of the
    /// level is repeated until it does.
    #[inline(always)]
    fn conserves(&self) -> bool {
        true
    }

    /// Whether the velocity of [`OneStep::correction`] is exact, so that Newton's method for a crossing
    /// converges quadratically. Where it is that of a close map, the iteration goes on to rounding.
    #[inline(always)]
    fn has_exact_velocity(&self) -> bool {
        true
    }

    /// The order p of accuracy.
    fn order(&self) -> usize;

    /// The memory at the start of a segment, of steps of one size if that is given.
    fn begin<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        step_size: Option<f64>,
    ) -> Self::Memory<N>;

    /// Full steps between corrections of the level, and renormalisations of the state's
    /// remainder, with what is known by now: a power of two, at most 256.
    #[inline(always)]
    fn correction_interval<const N: usize>(_memory: &Self::Memory<N>) -> u64 {
        32
    }

    /// The increment of a full step: τ is the step size up to rounding errors of the time, and
    /// the dynamics and the segment are those of `memory`. By default the same as of any other step.
    ///
    /// # Errors
    /// If the implicit equation has no solution or a formula no finite value.
    #[inline]
    fn full_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        _memory: &mut Self::Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        self.step(step, statistics)
    }

    /// The increment of one of many steps whose size varies slowly, in the segment of `memory`.
    /// By default the same as of any other step.
    ///
    /// # Errors
    /// If the implicit equation has no solution or a formula no finite value.
    #[inline]
    fn varied_step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        _memory: &mut Self::Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        self.step(step, statistics)
    }

    /// The increment of a step of any size.
    ///
    /// # Errors
    /// If the implicit equation has no solution or a formula no finite value.
    fn step<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure>;

    /// The increment of a step over dual numbers, whose derivatives are those of the step (by
    /// default of the flow); nothing if
    /// there are none.
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

    /// One Newton correction of an approximate increment d of a step, and the velocity ∂d/∂τ
    /// of the one-step map there: what Newton's method in (τ, d) is made of.
    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>>;
}

/// See [`OneStep::correction`].
#[derive(Clone, Copy, Debug)]
pub struct Correction<const N: usize> {
    /// What to add to the increment.
    pub delta: Vector<f64, N>,
    /// ∂d/∂τ
    pub velocity: Vector<f64, N>,
}
