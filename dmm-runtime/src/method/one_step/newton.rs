//! Newton's method for the implicit equation of a step, in the increment d = x₁ − x₀:
//!
//! F(d) = d − τ f^τ(t₀, x₀, t₁, x₀ + d) = 0, ∂F/∂d = I − τ ∂f^τ/∂x₁.

use super::map::{Correction, Step};
use crate::arithmetic::linear::{is_finite, solve};
use crate::contract::{Dynamics, Matrix, Solvability, Vector};
use crate::method::Statistics;
use crate::method::StepFailure;

/// Iterations before Newton's method is given up.
const LARGEST_ITERATIONS: u64 = 30;
/// Halvings of a damped Newton correction before it is given up.
const LARGEST_HALVINGS: u32 = 12;
/// A correction s smaller than this part of the increment is the last: the error that it
/// leaves is of the order of s², which is below rounding.
const CONVERGED: f64 = 7.450_580_596_923_828e-9; // 2⁻²⁷ = √(2⁻⁵⁴)
/// Where a component of the increment passes through zero, its correction is measured
/// against this part of the state.
const SHARE_OF_STATE: f64 = 2.441_406_25e-4; // 2⁻¹²

/// A residual this small against its terms is rounding error.
const ROUNDING: f64 = 8.881_784_197_001_252e-16; // 4ε

impl<F, const N: usize> Step<'_, F, N> {
    /// The increment of the explicit Euler step.
    #[inline]
    pub(super) fn euler<const M: usize>(&self) -> Vector<f64, N>
    where
        F: Dynamics<f64, N, M>,
    {
        self.dynamics.vector_field(self.t0, self.x0) * self.tau
    }

    /// F(d) and I − τ ∂f^τ/∂x₁.
    #[inline]
    pub(super) fn residual<const M: usize>(
        &self,
        increment: &Vector<f64, N>,
    ) -> (Vector<f64, N>, Matrix<f64, N, N>)
    where
        F: Dynamics<f64, N, M>,
    {
        let x1 = self.x0 + increment;
        let t1 = self.t0 + self.tau;
        // where it is returned to: a matrix of 64 unknowns is better not copied
        let mut both = self.dynamics.linearised(self.t0, self.x0, t1, &x1);
        both.0 = increment - both.0 * self.tau;
        both.1 *= -self.tau;
        for i in 0..N {
            both.1[(i, i)] += 1.0;
        }
        both
    }

    /// The increment, from a predicted one.
    #[inline]
    pub(super) fn increment<const M: usize>(
        &self,
        predicted: Vector<f64, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        match self.dynamics.solvability() {
            Solvability::Nonlinear => self.solve::<M>(predicted, statistics),
            // the residual is affine in d: its correction from any d is the solution
            Solvability::Affine | Solvability::Linear => self
                .correction::<M>(&Vector::zeros())
                .map(|correction| correction.delta)
                .filter(is_finite)
                .ok_or(StepFailure::NotFinite),
        }
    }

    /// Solves the equation from a predicted increment; if that fails, once more with damping
    /// from the explicit Euler step.
    #[inline]
    pub(super) fn solve<const M: usize>(
        &self,
        predicted: Vector<f64, N>,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        let mut increment = predicted;
        for _ in 0..LARGEST_ITERATIONS {
            let (ref residual, ref matrix) = self.residual::<M>(&increment);
            statistics.newton_iterations += 1;
            let Some(correction) = solve(matrix, residual) else {
                break;
            };
            increment -= correction;
            if self.is_converged(&increment, &correction)
                || self.is_rounding(residual, matrix, &increment)
            {
                return Ok(increment);
            }
        }
        self.solve_damped::<M>(statistics)
    }

    /// The increment of one sweep of the fixed-point iteration.
    #[inline(always)]
    pub(super) fn sweep<const M: usize>(&self, increment: &Vector<f64, N>) -> Vector<f64, N>
    where
        F: Dynamics<f64, N, M>,
    {
        let x1 = self.x0 + increment;
        let t1 = self.t0 + self.tau;
        self.dynamics
            .discrete_vector_field(self.t0, self.x0, t1, &x1)
            * self.tau
    }

    /// Whether the error that `correction` leaves is below rounding.
    #[inline]
    pub(super) fn is_converged(
        &self,
        increment: &Vector<f64, N>,
        correction: &Vector<f64, N>,
    ) -> bool {
        (0..N).all(|i| {
            let scale = increment[i].abs() + SHARE_OF_STATE * self.x0[i].abs();
            correction[i].abs() <= CONVERGED * scale
        })
    }

    /// Whether the residual is what rounding x₁ and the increment makes of it, so that no
    /// iteration makes it smaller: |F|ᵢ ≤ c ε (|d|ᵢ + Σⱼ |τ ∂f^τᵢ/∂x₁ⱼ| (|x₀| + |d|)ⱼ).
    #[cold]
    fn is_rounding(
        &self,
        residual: &Vector<f64, N>,
        matrix: &Matrix<f64, N, N>,
        increment: &Vector<f64, N>,
    ) -> bool {
        (0..N).all(|i| {
            let mut size = increment[i].abs();
            for j in 0..N {
                let slope = matrix[(i, j)] - if i == j { 1.0 } else { 0.0 };
                size += slope.abs() * (self.x0[j].abs() + increment[j].abs());
            }
            residual[i].abs() <= ROUNDING * size
        })
    }

    /// Newton's method with halved corrections until the residual falls.
    #[cold]
    fn solve_damped<const M: usize>(
        &self,
        statistics: &mut Statistics,
    ) -> Result<Vector<f64, N>, StepFailure>
    where
        F: Dynamics<f64, N, M>,
    {
        let mut increment = self.euler::<M>();
        let (mut residual, mut matrix) = self.residual::<M>(&increment);
        let mut iterations = 0;
        while iterations < LARGEST_ITERATIONS {
            iterations += 1;
            statistics.newton_iterations += 1;
            if !is_finite(&residual) {
                return Err(StepFailure::NotFinite);
            }
            let Some(correction) = solve(&matrix, &residual) else {
                break;
            };
            if self.is_converged(&increment, &correction) {
                return Ok(increment - correction);
            }
            let mut share = 1.0;
            let accepted = (0..LARGEST_HALVINGS).find_map(|_| {
                let trial = increment - correction * share;
                share *= 0.5;
                let (r, m) = self.residual::<M>(&trial);
                (is_finite(&r) && r.norm() < residual.norm()).then_some((trial, r, m))
            });
            match accepted {
                Some((trial, r, m)) => (increment, residual, matrix) = (trial, r, m),
                None if self.is_rounding(&residual, &matrix, &increment) => return Ok(increment),
                None => break,
            }
        }
        Err(StepFailure::NoConvergence {
            residual: residual.amax(),
            iterations,
        })
    }

    /// One correction and the velocity of the one-step map:
    /// ∂d/∂τ = (I − τ ∂f^τ/∂x₁)⁻¹ (f^τ + τ ∂f^τ/∂t₁).
    pub(super) fn correction<const M: usize>(
        &self,
        increment: &Vector<f64, N>,
    ) -> Option<Correction<N>>
    where
        F: Dynamics<f64, N, M>,
    {
        let (ref residual, ref matrix) = self.residual::<M>(increment);
        let t1 = self.t0 + self.tau;
        let x1 = self.x0 + increment;
        let mut right = self
            .dynamics
            .discrete_vector_field(self.t0, self.x0, t1, &x1);
        if !self.dynamics.is_autonomous() {
            right += self.dynamics.time_derivative(self.t0, self.x0, t1, &x1) * self.tau;
        }
        Some(Correction {
            delta: -solve(matrix, residual)?,
            velocity: solve(matrix, &right)?,
        })
    }
    /// ∂x₁/∂s, where x₀, t₀ and t₁ change with s by `rates`:
    ///
    /// (I − τ ∂f^τ/∂x₁) ∂x₁ = (I + τ ∂f^τ/∂x₀) ∂x₀ + f^τ ∂τ + τ (∂f^τ/∂t₀ ∂t₀ + ∂f^τ/∂t₁ ∂t₁).
    ///
    /// f^τ is symmetric: its derivatives by the one end are those by the other with the ends
    /// exchanged.
    pub(super) fn tangent<const M: usize>(
        &self,
        increment: &Vector<f64, N>,
        (x0_rate, t0_rate, t1_rate): (Vector<f64, N>, f64, f64),
    ) -> Option<Vector<f64, N>>
    where
        F: Dynamics<f64, N, M>,
    {
        let Self {
            dynamics,
            t0,
            x0,
            tau,
        } = *self;
        let (t1, x1) = (t0 + tau, x0 + increment);
        let (field, by_x1) = dynamics.linearised(t0, x0, t1, &x1);
        let (_, by_x0) = dynamics.linearised(t1, &x1, t0, x0);
        let mut right = x0_rate + (by_x0 * x0_rate) * tau + field * (t1_rate - t0_rate);
        if !dynamics.is_autonomous() {
            let by_t0 = dynamics.time_derivative(t1, &x1, t0, x0) * t0_rate;
            let by_t1 = dynamics.time_derivative(t0, x0, t1, &x1) * t1_rate;
            right += (by_t0 + by_t1) * tau;
        }
        solve(&(Matrix::identity() - by_x1 * tau), &right)
    }
}
