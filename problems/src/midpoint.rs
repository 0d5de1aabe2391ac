//! The explicit midpoint rule, x₁ = x₀ + τ f(t₀ + τ/2, x₀ + τ/2 f(t₀, x₀)): the Runge–Kutta
//! method of order 2 that Hirani, Wan & Wojtalewicz compare with (their Figs 5 and 8). It
//! does not conserve ψ.

use dmm_runtime::{Correction, Flow, OneStep, Statistics, Step, StepFailure, Vector};

/// The explicit midpoint rule with uniform steps, without a correction of the level.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ExplicitMidpoint {
    step_size: f64,
}

impl ExplicitMidpoint {
    /// Uniform steps of `step_size`.
    pub fn step_size(step_size: f64) -> Self {
        Self { step_size }
    }
}

fn increment<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    &Step { flow, t0, x0, tau }: &Step<'_, F, N>,
) -> Vector<f64, N> {
    let half = 0.5 * tau;
    let middle = x0 + flow.vector_field(t0, x0) * half;
    flow.vector_field(t0 + half, &middle) * tau
}

impl OneStep for ExplicitMidpoint {
    type Memory<const N: usize> = ();

    const ORDER: usize = 2;

    fn step_size(&self) -> f64 {
        self.step_size
    }

    fn corrects_level(&self) -> bool {
        false
    }

    fn begin<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        _flow: &F,
        _t: f64,
        _x: &Vector<f64, N>,
    ) {
    }

    fn step<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        _statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure> {
        let increment = increment(step);
        match increment.iter().all(|component| component.is_finite()) {
            true => Ok(increment),
            false => Err(StepFailure::NotFinite),
        }
    }

    /// The velocity is that of the exact flow, off by O(τ²): the locator's iteration converges
    /// linearly with that factor, to the same point.
    fn correction<const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        step: &Step<'_, F, N>,
        current: &Vector<f64, N>,
    ) -> Option<Correction<N>> {
        let end = increment(step);
        let &Step { flow, t0, x0, tau } = step;
        Some(Correction {
            delta: end - current,
            velocity: flow.vector_field(t0 + tau, &(x0 + end)),
        })
    }
}
