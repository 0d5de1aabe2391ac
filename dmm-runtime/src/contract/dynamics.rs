//! What the compiler derives for one mode: field, conserved quantities, discrete field, recurrences.

use super::{Guards, Side};
use crate::arithmetic::{Matrix, Scalar, Vector};
use crate::series::{Order, Unroll};

/// What is to be done with the dynamics of a mode; see [`System::visit`](crate::System::visit).
pub trait DynamicsVisitor<const N: usize, S: Scalar = f64> {
    /// The result.
    type Output;

    /// Does it, for dynamics with M conserved quantities.
    fn visit<const M: usize, F: Dynamics<S, N, M>>(self, dynamics: &F) -> Self::Output;
}

/// How the discrete vector field depends on the state at the later end of a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Solvability {
    /// In general: Newton's method.
    Nonlinear,
    /// f^τ = A x₁ + b with A and b depending on x₀, t₀ and t₁: one linear solve.
    Affine,
    /// f^τ = A₀ x₀ + A₁ x₁ + b with A₀, A₁ and b depending on parameters alone: the
    /// propagator is computed once a step size.
    Linear,
}

/// The dynamics of one mode: a smooth vector field f with M conserved quantities, and the conservative scheme
/// that the compiler derived from them.
///
/// Every function is generic over the scalar. `x` has N entries, ψ has M, Λ is M×N, a
/// Jacobian N×N with a row an equation.
pub trait Dynamics<S: Scalar, const N: usize, const M: usize>: Clone {
    /// The guards of the mode.
    type Guards: Guards<S, N>;

    /// The same dynamics over other scalars.
    type Over<Other: Scalar>: Dynamics<Other, N, M>;

    /// The dynamics over other scalars with the same parameters, and with the same values of what
    /// is computed from them alone.
    fn over<Other: Scalar>(&self) -> Self::Over<Other>;

    /// [`Dynamics::is_affine`], where the type tells: then one kind of flow is compiled.
    const AFFINE: Option<bool>;

    /// Whether neither f nor ψ depends on the time.
    fn is_autonomous(&self) -> bool;

    /// How the implicit equation of a step is solved.
    fn solvability(&self) -> Solvability;

    /// Whether f = A x + b with A and b depending on parameters alone: then φ_τ is known exactly.
    /// A is [`Dynamics::jacobian`] anywhere, b is f(0).
    #[inline(always)]
    fn is_affine(&self) -> bool {
        Self::AFFINE == Some(true)
    }

    /// How many of the M quantities there are; dynamics that were compiled at run time may have
    /// room for more.
    #[inline(always)]
    fn quantities(&self) -> usize {
        M
    }

    /// Whether ψ number `quantity` is an affine function of t and x: every Taylor and Runge–Kutta
    /// step conserves it to rounding without a correction.
    fn is_affine_quantity(&self, quantity: usize) -> bool;

    /// Whether a guard keeps the sign that it has where the mode is entered.
    #[inline(always)]
    fn keeps_signs(&self) -> bool {
        false
    }

    /// The guards of the mode.
    fn guards(&self) -> &Self::Guards;

    /// The indices of the guards of the mode, with the sides that it lies on: [`Guards::sides`].
    #[inline(always)]
    fn sides(&self) -> &[(usize, Side)] {
        self.guards().sides()
    }

    /// Whether there are any.
    #[inline(always)]
    fn is_bounded(&self) -> bool {
        <Self::Guards as Guards<S, N>>::MAY_END && !self.sides().is_empty()
    }

    /// dg/dt = ∂ₜg + ∇g·f of a guard at (t, x).
    #[inline]
    fn rate(&self, guard: usize, t: S, x: &Vector<S, N>) -> S {
        let (by_time, gradient) = self.guards().switching_gradient(guard, t, x);
        let field = self.vector_field(t, x);
        let mut rate = by_time;
        for i in 0..N {
            rate += gradient[i] * field[i];
        }
        rate
    }

    /// The dynamics with guards that are positive at (t, x), of those that keep a sign.
    fn oriented(&self, _t: S, _x: &Vector<S, N>) -> Self {
        self.clone()
    }

    /// f(t, x)
    fn vector_field(&self, t: S, x: &Vector<S, N>) -> Vector<S, N>;

    /// ∂f/∂x at (t, x).
    fn jacobian(&self, t: S, x: &Vector<S, N>) -> Matrix<S, N, N>;

    /// ψ(t, x)
    fn conserved(&self, t: S, x: &Vector<S, N>) -> Vector<S, M>;

    /// Σ|terms of ψ(t, x)|, the size that the rounding error of ψ is measured against.
    fn conserved_size(&self, t: S, x: &Vector<S, N>) -> Vector<S, M>;

    /// ψ(t, x) and the multiplier Λ = ∇ψ(t, x).
    fn multiplier(&self, t: S, x: &Vector<S, N>) -> (Vector<S, M>, Matrix<S, M, N>);

    /// f^τ(t₀, x₀, t₁, x₁)
    fn discrete_vector_field(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> Vector<S, N>;

    /// f^τ(t₀, x₀, t₁, x₁) and ∂f^τ/∂x₁.
    fn linearised(
        &self,
        t0: S,
        x0: &Vector<S, N>,
        t1: S,
        x1: &Vector<S, N>,
    ) -> (Vector<S, N>, Matrix<S, N, N>);

    /// ∂f^τ/∂t₁; zero, and not emitted, where the dynamics are autonomous.
    fn time_derivative(
        &self,
        _t0: S,
        _x0: &Vector<S, N>,
        _t1: S,
        _x1: &Vector<S, N>,
    ) -> Vector<S, N> {
        Vector::from_element(S::from_f64(0.0))
    }

    /// The Taylor coefficients x₀ … x_{P−1} of the solution's N components, and of what f is
    /// computed from: an array of P coefficients each, the components first.
    type Series<const P: usize>: Clone + AsRef<[[S; P]]> + AsMut<[[S; P]]>;

    /// Whether [`Dynamics::advance`] is straight-line code for each order.
    type Unrolled: Unroll;

    /// Room for the coefficients.
    fn series<const P: usize>(&self) -> Self::Series<P>;

    /// From the coefficients up to order k, those of order k + 1 of the solution, at time t. Of
    /// the order 0 only those of the components are given.
    fn advance<K: Order, const P: usize>(&self, k: K, t: S, series: &mut Self::Series<P>);
}
