//! The state with its rounding remainder.

use super::error_free::two_sum;
use super::{Scalar, Vector, alone};

/// A state x carried as the unevaluated sum of its rounded value and the remainder, so that
/// increments far below the last place of x add up (compensated summation).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct State<const N: usize, S: Scalar = f64> {
    /// The rounded state.
    pub x: Vector<S, N>,
    /// What is missing from it.
    pub remainder: Vector<S, N>,
}

impl<const N: usize, S: Scalar> State<N, S> {
    /// The state `x` without remainder.
    pub fn new(x: Vector<S, N>) -> Self {
        Self {
            x,
            remainder: Vector::from_element(S::from_f64(0.0)),
        }
    }

    /// The state after `increment`. What rounding takes from it goes to the remainder, which
    /// is not added to x here: the next increment need not wait for it.
    #[inline(always)]
    #[must_use]
    pub fn after(&self, increment: &Vector<S, N>) -> Self {
        let mut after = *self;
        for i in 0..N {
            let (sum, error) = two_sum(self.x[i], increment[i]);
            after.x[i] = sum;
            after.remainder[i] = self.remainder[i] + error;
        }
        after
    }

    /// The state after an increment that has the remainder in it, with one of at most half a unit in the last
    /// place of x.
    #[inline(always)]
    #[must_use]
    pub fn moved(&self, increment: &Vector<S, N>) -> Self {
        let mut moved = *self;
        for i in 0..N {
            (moved.x[i], moved.remainder[i]) = two_sum(self.x[i], increment[i]);
        }
        moved
    }

    /// The same state with a remainder of at most half a unit in the last place of x.
    #[inline(always)]
    #[must_use]
    pub fn normalised(&self) -> Self {
        self.moved(&self.remainder)
    }

    /// The same, read number by number; see [`alone`].
    #[inline(always)]
    pub(crate) fn by_numbers(&self) -> Self {
        let mut copy = *self;
        for i in 0..N {
            copy.x[i] = alone(&self.x[i]);
            copy.remainder[i] = alone(&self.remainder[i]);
        }
        copy
    }

    /// The state rounded once.
    #[inline(always)]
    pub fn rounded(&self) -> Vector<S, N> {
        self.x + self.remainder
    }
}
