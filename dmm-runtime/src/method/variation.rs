//! Steps whose start, size and parameters depend on other things: what the derivatives of a solution
//! are made of.

use crate::arithmetic::{Scalar, Vector};
use crate::contract::Dynamics;
use crate::series::{InUnits, MOST_COEFFICIENTS};

/// A step over dual numbers.
///
/// The derivatives of an implicit step come from its own equation F(d) = 0, solved over doubles: each
/// correction by the Jacobian of the values makes those of one order more right (Griewank & Walther,
/// Evaluating Derivatives, section 15.3), so that [`Scalar::DERIVATIVES`] corrections do.
#[derive(Debug)]
pub struct Variation<'a, D, S, const N: usize> {
    pub(crate) dynamics: &'a D,
    pub(crate) t0: S,
    pub(crate) x0: Vector<S, N>,
    pub(crate) tau: S,
}

impl<D, S: Scalar, const N: usize> Variation<'_, D, S, N> {
    /// t₀, x₀ and τ as doubles.
    pub(crate) fn values(&self) -> (f64, Vector<f64, N>, f64) {
        (
            self.t0.to_f64(),
            self.x0.map(Scalar::to_f64),
            self.tau.to_f64(),
        )
    }

    /// x₀ + d
    pub(crate) fn end(&self, increment: &Vector<S, N>) -> Vector<S, N> {
        Vector::from_fn(|i, _| self.x0[i] + increment[i])
    }

    /// The increment by the flow: its Taylor polynomial at the start, or at the starts of parts in
    /// which a linear field does not turn by more than a radian.
    pub(crate) fn flow<const M: usize>(&self) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
    {
        /// Beyond it a linear field is too stiff for its polynomial.
        const MOST_PARTS: f64 = 1e5;
        let (t0, x0, tau) = self.values();
        let mut parts = 1.0;
        if self.dynamics.is_affine() {
            let jacobian = self.dynamics.over::<f64>().jacobian(t0, &x0);
            let rows = jacobian
                .row_iter()
                .map(|row| row.iter().map(|a| a.abs()).sum());
            let norm = rows.fold(0.0, |largest: f64, row: f64| largest.max(row));
            parts = (norm * tau.abs()).ceil().max(1.0);
            if parts > MOST_PARTS || parts.is_nan() {
                return None;
            }
        }
        let share = S::from_f64(1.0 / parts);
        let tau = self.tau * share;
        let (mut t, mut x) = (self.t0, self.x0);
        for _ in 0..parts as usize {
            x = polynomial(self.dynamics, t, &x, tau);
            t += tau;
        }
        Some(Vector::from_fn(|i, _| x[i] - self.x0[i]))
    }
}

/// The solution from (t, x) after τ, by its Taylor polynomial.
fn polynomial<D: Dynamics<S, N, M>, S: Scalar, const N: usize, const M: usize>(
    dynamics: &D,
    t: S,
    x: &Vector<S, N>,
    tau: S,
) -> Vector<S, N> {
    let mut series = dynamics.series::<MOST_COEFFICIENTS>();
    for (component, &x) in series.as_mut().iter_mut().zip(x) {
        component[0] = x;
    }
    // where τ = 0 its derivatives count, and their powers
    let (unit, orders) = match tau.to_f64() {
        0.0 => (1.0, S::DERIVATIVES),
        unit => (unit, MOST_COEFFICIENTS - 1),
    };
    for order in 0..orders {
        dynamics.advance(InUnits { order, unit }, t, &mut series);
    }
    let s = tau / S::from_f64(unit);
    let sum = |c: &[S]| c.iter().rev().fold(S::from_f64(0.0), |sum, &c| sum * s + c);
    Vector::from_fn(|i, _| sum(&series.as_ref()[i][..=orders]))
}
