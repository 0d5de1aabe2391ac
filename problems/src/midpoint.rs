//! The explicit midpoint rule, x₁ = x₀ + τ f(t₀ + τ/2, x₀ + τ/2 f(t₀, x₀)): the Runge–Kutta
//! method of order 2 that Hirani, Wan & Wojtalewicz compare with (their Figs 5 and 8). It
//! does not conserve ψ.

use dmm_runtime::{Correction, Dynamics, OneStep, Statistics, Step, StepFailure, Uniform, Vector};

/// The explicit midpoint rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct ExplicitMidpoint;

impl ExplicitMidpoint {
    /// Uniform steps of `step_size`, without a correction of the level.
    pub fn step_size(step_size: f64) -> Uniform<Self> {
        Uniform::new(Self, step_size).level_correction(false)
    }
}

fn increment<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    &Step {
        dynamics,
        t0,
        x0,
        tau,
    }: &Step<'_, F, N>,
) -> Vector<f64, N> {
    let half = 0.5 * tau;
    let middle = x0 + dynamics.vector_field(t0, x0) * half;
    dynamics.vector_field(t0 + half, &middle) * tau
}

impl OneStep for ExplicitMidpoint {
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
        _statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        let increment = increment(step);
        if increment.iter().all(|component| component.is_finite()) {
            Ok(increment)
        } else {
            Err(StepFailure::NotFinite)
        }
    }

    /// The velocity is that of the exact flow, off by O(τ²): the locator's iteration converges
    /// linearly with that factor, to the same point.
    fn correction<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        current: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        let end = increment(step);
        let &Step {
            dynamics,
            t0,
            x0,
            tau,
        } = step;
        Some(Correction {
            delta: end - current,
            velocity: dynamics.vector_field(t0 + tau, &(x0 + end)),
        })
    }
}
