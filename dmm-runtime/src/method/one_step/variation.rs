//! The derivatives of steps of the discrete multiplier method and of its compositions.

use super::map::Step;
use crate::arithmetic::factors::Factors;
use crate::arithmetic::{Scalar, Vector};
use crate::contract::Dynamics;
use crate::method::Statistics;
use crate::method::variation::Variation;

impl<D, S: Scalar, const N: usize> Variation<'_, D, S, N> {
    /// The increment d of x₁ = x₀ + τ f^τ(t₀, x₀, t₀ + τ, x₁).
    pub(super) fn symmetric<const M: usize>(&self) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
    {
        let dynamics = self.dynamics.over::<f64>();
        let (t0, x0, tau) = self.values();
        let step = Step {
            dynamics: &dynamics,
            t0,
            x0: &x0,
            tau,
        };
        let solved = step.increment::<M>(step.euler(), &mut Statistics::default());
        let solved = solved.ok()?;
        let (_, ref matrix) = step.residual::<M>(&solved);
        let factors = Factors::new(N, matrix.iter().copied())?;
        let t1 = self.t0 + self.tau;
        let mut increment = solved.map(S::from_f64);
        for _ in 0..S::DERIVATIVES {
            let x1 = self.end(&increment);
            let field = (self.dynamics).discrete_vector_field(self.t0, &self.x0, t1, &x1);
            let mut residual = Vector::<S, N>::from_fn(|i, _| increment[i] - field[i] * self.tau);
            factors.solve_over(residual.as_mut_slice(), S::from_f64);
            for (entry, &correction) in increment.iter_mut().zip(&residual) {
                *entry -= correction;
            }
        }
        Some(increment)
    }

    /// The increment of a composition of such steps.
    pub(super) fn composed<const M: usize>(&self, weights: &[f64]) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
    {
        let (mut t0, mut x0) = (self.t0, self.x0);
        for &weight in weights {
            let tau = self.tau * S::from_f64(weight);
            let part = Variation {
                dynamics: self.dynamics,
                t0,
                x0,
                tau,
            };
            x0 = part.end(&part.symmetric::<M>()?);
            t0 += tau;
        }
        Some(Vector::from_fn(|i, _| x0[i] - self.x0[i]))
    }
}
