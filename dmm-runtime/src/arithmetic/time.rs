//! Time as a pair of doubles.
//!
//! A plain double loses two digits of phase by t = 10⁴; the unevaluated sum of two doubles
//! keeps the time of a transition to the last bit of its increment, however long the run.

use super::error_free::two_sum;
use super::{Scalar, alone};

/// A point in time: the unevaluated sum of two doubles.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Time<S: Scalar = f64> {
    /// The time as a double.
    pub value: S,
    /// What is missing from it, at most a unit in its last place.
    pub remainder: S,
}

impl<S: Scalar> Time<S> {
    /// The scalar `value`.
    pub fn new(value: S) -> Self {
        Self {
            value,
            remainder: S::from_f64(0.0),
        }
    }

    /// This time plus `delta`.
    #[inline]
    #[must_use]
    pub fn after(self, delta: S) -> Self {
        let (sum, error) = two_sum(self.value, delta);
        let (value, remainder) = two_sum(sum, error + self.remainder);
        Self { value, remainder }
    }

    /// The same, read number by number; see [`alone`].
    #[inline(always)]
    pub(crate) fn by_numbers(&self) -> Self {
        Self {
            value: alone(&self.value),
            remainder: alone(&self.remainder),
        }
    }

    /// This time minus `earlier`, rounded once.
    #[inline]
    pub fn since(self, earlier: Self) -> S {
        let (difference, error) = two_sum(self.value, -earlier.value);
        difference + (error + (self.remainder - earlier.remainder))
    }
}
