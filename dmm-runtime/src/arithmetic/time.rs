//! Time as a pair of doubles.
//!
//! A plain double loses two digits of phase by t = 10⁴; the unevaluated sum of two doubles
//! keeps the time of a transition to the last bit of its increment, however long the run.

use super::error_free::two_sum;

/// A point in time: the unevaluated sum of two doubles.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Time {
    /// The time as a double.
    pub value: f64,
    /// What is missing from it, at most a unit in its last place.
    pub remainder: f64,
}

impl Time {
    /// The double `value`.
    pub fn new(value: f64) -> Self {
        Self {
            value,
            remainder: 0.0,
        }
    }

    /// This time plus `delta`.
    #[inline]
    #[must_use]
    pub fn after(self, delta: f64) -> Self {
        let (sum, error) = two_sum(self.value, delta);
        let (value, remainder) = two_sum(sum, error + self.remainder);
        Self { value, remainder }
    }

    /// This time minus `earlier`, rounded once.
    #[inline]
    pub fn since(self, earlier: Self) -> f64 {
        let (difference, error) = two_sum(self.value, -earlier.value);
        difference + (error + (self.remainder - earlier.remainder))
    }
}
