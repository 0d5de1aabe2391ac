//! The steps of a linear field: an increment d = K x₀ + k, the same for every step of one size.

use crate::arithmetic::linear::solve;
use crate::contract::{Dynamics, Matrix, Vector};
use crate::method::StepFailure;

/// d = K x₀ + k
#[derive(Clone, Debug)]
pub(super) struct Propagator<const N: usize> {
    /// K
    linear: Matrix<f64, N, N>,
    /// k, where it is not zero.
    offset: Option<Vector<f64, N>>,
}

impl<const N: usize> Propagator<N> {
    /// That of x₁ = x₀ + τ f^τ: from d = τ(A(x₀ + x₁) + b), with the same A at both ends
    /// because f^τ is symmetric, follows d = (I − τA)⁻¹ τ (2A x₀ + b).
    pub(super) fn new<const M: usize, F: Dynamics<f64, N, M>>(
        dynamics: &F,
        tau: f64,
    ) -> Option<Self> {
        let zero = Vector::zeros();
        let (offset, slope) = dynamics.linearised(0.0, &zero, tau, &zero);
        let mut matrix = slope * -tau;
        for i in 0..N {
            matrix[(i, i)] += 1.0;
        }
        let mut linear = slope * (2.0 * tau);
        for mut column in linear.column_iter_mut() {
            let solution = solve(&matrix, &column.clone_owned())?;
            column.copy_from(&solution);
        }
        let offset = if offset == zero {
            None
        } else {
            Some(solve(&matrix, &(offset * tau))?)
        };
        Some(Self { linear, offset })
    }

    /// That of a step by `self` and one by `next` after it: d = d₁ + K₂(x₀ + d₁) + k₂.
    pub(super) fn then(&self, next: &Self) -> Self {
        let linear = self.linear + next.linear + next.linear * self.linear;
        let offset = match (&self.offset, &next.offset) {
            (None, offset) => *offset,
            (Some(first), None) => Some(first + next.linear * first),
            (Some(first), Some(second)) => Some(first + next.linear * first + second),
        };
        Self { linear, offset }
    }

    /// Whether an increment may be more than a small part of the state.
    pub(super) fn is_long(&self) -> bool {
        const SMALL: f64 = 1.0 / 64.0;
        self.linear.amax() > SMALL
    }

    /// The increment from `x0`.
    #[inline]
    pub(super) fn increment(&self, x0: &Vector<f64, N>) -> Vector<f64, N> {
        match &self.offset {
            None => self.linear * x0,
            Some(offset) => {
                rarely();
                self.linear * x0 + offset
            }
        }
    }
}

/// Marks a branch as one that is not to be computed where the other is taken.
#[cold]
fn rarely() {}

/// The increment by a propagator, which there is unless I − τA is singular.
#[inline]
pub(super) fn propagate<const N: usize>(
    propagator: Option<&Propagator<N>>,
    x0: &Vector<f64, N>,
) -> Result<Vector<f64, N>, StepFailure> {
    let propagator = propagator.ok_or(StepFailure::NotFinite)?;
    Ok(propagator.increment(x0))
}
