//! What a formula needs of numbers with more digits than a double has, so that it can be
//! written once and evaluated in [pairs](super::double), or next to a zero in
//! [fours](super::long).

use std::ops::{Add, Div, Mul, Sub};

/// A number of more digits than a double has.
pub(super) trait Extended:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// A sum that is at least this part of its terms has all the digits of a double.
    const CERTAIN: f64;

    /// How many terms of a series in numbers below 2⁻¹⁶ reach the last digit.
    const TERMS: usize;

    /// π/2
    const FRAC_PI_2: Self;

    /// The number rounded.
    fn high(self) -> f64;

    /// √u
    fn sqrt(self) -> Self;

    /// C(u) for u > −1, see [`super::arc`].
    fn arc_remainder(self) -> Self;

    /// C(u) from C of a smaller argument, see [`super::arc`].
    fn arc_remainder_by_halving(self) -> Self {
        let one = Self::from(1.0);
        let h = one / (one + (one + self).sqrt());
        let remainder = (self * h * h).arc_remainder();
        (one + Self::from(2.0) * h * remainder) * h * h
    }

    /// atan w for |w| ≤ 1
    fn atan(self) -> Self {
        let x = self * self;
        self - self * x * x.arc_remainder()
    }
}

/// The sum of two terms over a divisor, and how large the sum is beside the terms.
pub(super) struct Quotient<T> {
    /// (first + second)/divisor
    pub(super) value: T,
    /// |first + second| over the greater of the two
    pub(super) remaining: f64,
}

impl<T: Extended> Quotient<T> {
    pub(super) fn new(first: T, second: T, divisor: T) -> Self {
        let sum = first + second;
        let size = first.high().abs().max(second.high().abs());
        Self {
            value: sum / divisor,
            remaining: sum.high().abs() / size,
        }
    }

    /// The value, unless too many digits of it were cancelled.
    pub(super) fn certain(&self) -> Option<f64> {
        (self.remaining >= T::CERTAIN).then(|| self.value.high())
    }
}
