//! The state with its rounding remainder.

use crate::arithmetic::Vector;

/// A state x carried as the unevaluated sum of its rounded value and the remainder, so that
/// increments far below the last place of x add up (compensated summation).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct State<const N: usize> {
    /// The rounded state.
    pub x: Vector<f64, N>,
    /// What is missing from it.
    pub remainder: Vector<f64, N>,
}

impl<const N: usize> State<N> {
    /// The state `x` without remainder.
    pub fn new(x: Vector<f64, N>) -> Self {
        Self {
            x,
            remainder: Vector::zeros(),
        }
    }

    /// The state after `increment`. What rounding takes from it goes to the remainder, which
    /// is not added to x here: the next increment need not wait for it.
    #[inline]
    #[must_use]
    pub fn after(&self, increment: &Vector<f64, N>) -> Self {
        let (x, error) = two_sum(&self.x, increment);
        Self {
            x,
            remainder: self.remainder + error,
        }
    }

    /// The same state with a remainder of at most half a unit in the last place of x.
    #[inline]
    #[must_use]
    pub fn normalised(&self) -> Self {
        let (x, remainder) = two_sum(&self.x, &self.remainder);
        Self { x, remainder }
    }

    /// The state rounded once.
    #[inline]
    pub fn rounded(&self) -> Vector<f64, N> {
        self.x + self.remainder
    }
}

/// a + b = s + e exactly, by component; see [`crate::arithmetic::error_free`].
#[inline]
fn two_sum<const N: usize>(
    a: &Vector<f64, N>,
    b: &Vector<f64, N>,
) -> (Vector<f64, N>, Vector<f64, N>) {
    let s = a + b;
    let b_part = s - a;
    let a_part = s - b_part;
    (s, (a - a_part) + (b - b_part))
}
