//! The symmetric scheme of order 2.

use crate::error::StepFailure;
use crate::scheme::history::History;
use crate::scheme::propagator::{Propagator, propagate};
use crate::scheme::{Correction, OneStep, Step};
use crate::statistics::Statistics;
use crate::system::{Flow, Solvability, Vector};

/// The discrete multiplier scheme
///
/// x₁ = x₀ + τ f^τ(t₀, x₀, t₁, x₁)
///
/// with uniform steps: symmetric under the exchange of its ends, hence of even order (2), and
/// conserving every declared ψ exactly (Wan, Bihlo & Nave 2017; Hirani, Wan & Wojtalewicz,
/// eq. 2.3).
///
/// Where f^τ is affine in x₁ the solution is in closed form; elsewhere it is found by
/// Newton's method in the increment with the generated Jacobian, from an explicit predictor
/// (the polynomial through the last six increments), down to rounding.
///
/// ```
/// use dmm_runtime::Symmetric;
///
/// let scheme = Symmetric::step_size(1e-3);            // levels are kept
/// let bare = Symmetric::step_size(1e-3).level_correction(false);
/// # let _ = (scheme, bare);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Symmetric {
    step_size: f64,
    level_correction: bool,
}

impl Symmetric {
    /// Uniform steps of `step_size` (in the unit of time), which must be positive and finite;
    /// the integrator refuses others.
    pub fn step_size(step_size: f64) -> Self {
        Self {
            step_size,
            level_correction: true,
        }
    }

    /// Whether the rounding errors of ψ are corrected towards the level at the entry into the
    /// region (default: yes). Without it they add up: at τ = 10⁻³ to less than 10⁻¹³ of the
    /// size of ψ's terms in a million steps, at coarse steps of a linear flow, whose propagator
    /// is rounded once and for all, to some 10⁻¹¹.
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            level_correction,
            ..self
        }
    }
}

/// What [`Symmetric`] remembers within a segment.
#[derive(Clone, Debug)]
pub struct Memory<const N: usize> {
    /// Increments of full steps.
    increments: History<N>,
    /// Of a linear flow.
    propagator: Option<Propagator<N>>,
}

impl OneStep for Symmetric {
    type Memory<const N: usize> = Memory<N>;

    fn step_size(&self) -> f64 {
        self.step_size
    }

    fn corrects_level(&self) -> bool {
        self.level_correction
    }

    fn begin<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        _t: f64,
        _x: &Vector<f64, N>,
    ) -> Memory<N> {
        Memory {
            increments: History::new(),
            propagator: match F::SOLVABILITY {
                Solvability::Linear => Propagator::new(flow, self.step_size),
                Solvability::Affine | Solvability::Nonlinear => None,
            },
        }
    }

    // there is one call of it, in the loop over full steps; inlined there, a step in two variables
    // takes a third of the instructions less
    #[inline(always)]
    fn full_step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        memory: &mut Memory<N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        match F::SOLVABILITY {
            Solvability::Linear => propagate(memory.propagator.as_ref(), step.x0),
            Solvability::Affine => self.step(step, statistics),
            Solvability::Nonlinear => {
                let predicted = memory.increments.predict();
                let predicted = predicted.unwrap_or_else(|| step.euler());
                let increment = step.increment::<M>(predicted, statistics)?;
                memory.increments.remember(increment);
                Ok(increment)
            }
        }
    }

    fn step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        step.increment::<M>(step.euler(), statistics)
    }

    fn correction<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        step.correction::<M>(increment)
    }
}
