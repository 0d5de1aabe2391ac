//! One-step schemes, as interchangeable values.
//!
//! A scheme maps a state x₀ over a step τ to x₁ = x₀ + d, conserving ψ if it is made from
//! the flow's discrete vector field. Regions, transitions, levels, output and time are the
//! integrator's, the same for every scheme (Hirani, Wan & Wojtalewicz, Algorithm 2.1).

mod adaptive;
mod best;
mod composed;
mod compositions;
mod drive;
mod history;
mod newton;
mod pace;
mod propagator;
mod sweep;
mod symmetric;
mod taylor;

pub use adaptive::Adaptive;
pub use best::Best;
pub use composed::Composed;
pub use compositions::Composition;
pub(crate) use drive::{Drive, Maps, Stuck};
pub(crate) use pace::{COEFFICIENTS, Expansion, Pacer};
pub use symmetric::Symmetric;
pub use taylor::Taylor;

use crate::error::StepFailure;
use crate::statistics::Statistics;
use crate::system::{Flow, Vector};

/// A step to be made.
#[derive(Debug)]
pub struct Step<'a, F, const N: usize> {
    /// The flow of the region.
    pub flow: &'a F,
    /// t₀, the start of the step.
    pub t0: f64,
    /// x₀, the state there.
    pub x0: &'a Vector<f64, N>,
    /// τ, its size.
    pub tau: f64,
}

/// What an [`Integrator`](crate::Integrator) integrates by: a [`OneStep`] scheme such as
/// [`Symmetric`], with uniform steps or [`Adaptive`] ones, [`Taylor`] or [`Best`].
pub trait Scheme: Drive {}

impl<Sch: Drive> Scheme for Sch {}

/// A one-step scheme.
///
/// The scheme is asked for increments d = x₁ − x₀ rather than for x₁, so that they keep their
/// relative accuracy however small the step.
pub trait OneStep: Clone + Sync {
    /// What is remembered from step to step within a segment.
    type Memory<const N: usize>: Clone;

    /// The order p of accuracy.
    const ORDER: usize;

    /// The step size τ of uniform steps.
    fn step_size(&self) -> f64;

    /// Whether the state is corrected towards the level of the conserved quantities.
    fn corrects_level(&self) -> bool;

    /// The memory at the start of a segment.
    fn begin<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        t: f64,
        x: &Vector<f64, N>,
    ) -> Self::Memory<N>;

    /// Full steps between corrections of the level, and renormalisations of the state's
    /// remainder, with what is known by now: a power of two, at most 256.
    #[inline(always)]
    fn correction_interval<const N: usize>(_memory: &Self::Memory<N>) -> u64 {
        32
    }

    /// The increment of a full step: τ is the step size up to rounding errors of the time, and
    /// the flow and its segment are those of `memory`. By default the same as of any other step.
    ///
    /// # Errors
    /// If the implicit equation has no solution or a formula no finite value.
    #[inline]
    fn full_step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
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
    fn varied_step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
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
    fn step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure>;

    /// One Newton correction of an approximate increment d of a step, and the velocity ∂d/∂τ
    /// of the one-step map there: what Newton's method in (τ, d) is made of.
    fn correction<const N: usize, const M: usize, F: Flow<f64, N, M>>(
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
