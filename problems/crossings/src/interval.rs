//! Intervals of doubles, rounded outwards, and intervals with their rates of change.

use std::f64::consts::{FRAC_PI_2, TAU};

/// The numbers from `lower` to `upper`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Interval {
    pub(super) lower: f64,
    pub(super) upper: f64,
}

/// The functions of the standard library are accurate to less than so many units.
const ULPS: usize = 4;

impl Interval {
    pub(super) const ALL: Self = Self {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };

    pub(super) const fn point(value: f64) -> Self {
        Self {
            lower: value,
            upper: value,
        }
    }

    /// middle ± radius
    pub(super) fn around(middle: f64, radius: f64) -> Self {
        Self::outward(middle - radius, middle + radius, 1)
    }

    /// The bounds moved outwards by some units in the last place; everything if one is NaN.
    fn outward(mut lower: f64, mut upper: f64, ulps: usize) -> Self {
        if lower.is_nan() || upper.is_nan() {
            return Self::ALL;
        }
        for _ in 0..ulps {
            lower = lower.next_down();
            upper = upper.next_up();
        }
        Self { lower, upper }
    }

    pub(super) fn contains_zero(self) -> bool {
        self.lower <= 0.0 && self.upper >= 0.0
    }

    /// The sign of all its numbers, if they have one.
    pub(super) fn sign(self) -> Option<f64> {
        if self.contains_zero() {
            None
        } else {
            Some(self.lower.signum())
        }
    }

    /// max |x|
    pub(super) fn magnitude(self) -> f64 {
        self.lower.abs().max(self.upper.abs())
    }

    pub(super) fn add(self, other: Self) -> Self {
        Self::outward(self.lower + other.lower, self.upper + other.upper, 1)
    }

    pub(super) fn negative(self) -> Self {
        Self {
            lower: -self.upper,
            upper: -self.lower,
        }
    }

    pub(super) fn mul(self, other: Self) -> Self {
        let products = [
            self.lower * other.lower,
            self.lower * other.upper,
            self.upper * other.lower,
            self.upper * other.upper,
        ];
        // 0·∞ is NaN, which makes it everything
        if products.iter().any(|product| product.is_nan()) {
            return Self::ALL;
        }
        let lower = products.iter().copied().fold(f64::INFINITY, f64::min);
        let upper = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self::outward(lower, upper, 1)
    }

    pub(super) fn square(self) -> Self {
        let (a, b) = (self.lower * self.lower, self.upper * self.upper);
        let least = if self.contains_zero() { 0.0 } else { a.min(b) };
        let square = Self::outward(least, a.max(b), 1);
        Self {
            lower: square.lower.max(0.0),
            ..square
        }
    }

    pub(super) fn inverse(self) -> Self {
        if self.contains_zero() {
            Self::ALL
        } else {
            Self::outward(1.0 / self.upper, 1.0 / self.lower, 1)
        }
    }

    pub(super) fn sqrt(self) -> Self {
        if self.lower < 0.0 {
            Self::ALL
        } else {
            Self::outward(self.lower.sqrt(), self.upper.sqrt(), 1)
        }
    }

    pub(super) fn ln(self) -> Self {
        if self.lower <= 0.0 {
            Self::ALL
        } else {
            self.growing(f64::ln)
        }
    }

    /// Its image under a function that grows.
    pub(super) fn growing(self, function: fn(f64) -> f64) -> Self {
        Self::outward(function(self.lower), function(self.upper), ULPS)
    }

    pub(super) fn cos(self) -> Self {
        // beyond it quarters of a turn are not told apart with certainty
        const LARGEST: f64 = 1e9;
        let width = self.upper - self.lower;
        if !(width < TAU && self.magnitude() < LARGEST) {
            return Self {
                lower: -1.0,
                upper: 1.0,
            };
        }
        // 1 at 2πn, −1 at π + 2πn; a little more is taken for inside
        let slack = 1e-15 * (1.0 + self.magnitude());
        let holds = |phase: f64| {
            let n = ((self.lower - slack - phase) / TAU).ceil();
            phase + n * TAU <= self.upper + slack
        };
        let (a, b) = (self.lower.cos(), self.upper.cos());
        let ends = Self::outward(a.min(b), a.max(b), ULPS);
        Self {
            lower: if holds(std::f64::consts::PI) {
                -1.0
            } else {
                ends.lower.max(-1.0)
            },
            upper: if holds(0.0) { 1.0 } else { ends.upper.min(1.0) },
        }
    }

    pub(super) fn sin(self) -> Self {
        // the argument of the cosine is rounded
        let rounding = f64::EPSILON * (1.0 + self.magnitude());
        let moved = Self {
            lower: self.lower - FRAC_PI_2 - rounding,
            upper: self.upper - FRAC_PI_2 + rounding,
        };
        moved.cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function of intervals and of numbers.
    type Functions = (fn(Interval) -> Interval, fn(f64) -> f64);

    #[test]
    fn intervals_hold_the_values_of_their_points() {
        let functions: [Functions; 6] = [
            (Interval::sin, f64::sin),
            (Interval::cos, f64::cos),
            (Interval::square, |x| x * x),
            (|x| x.growing(f64::exp), f64::exp),
            (|x| x.growing(f64::tanh), f64::tanh),
            (Interval::inverse, |x| 1.0 / x),
        ];
        for k in -60..60 {
            for width in [0.0, 1e-9, 0.1, 1.5, 4.0] {
                let lower = f64::from(k) * 0.3;
                let interval = Interval {
                    lower,
                    upper: lower + width,
                };
                for (over, at) in functions {
                    let image = over(interval);
                    for n in 0..=20 {
                        let value = at(lower + width * f64::from(n) / 20.0);
                        assert!(image.lower <= value && value <= image.upper || !value.is_finite());
                    }
                }
            }
        }
    }

    #[test]
    fn intervals_are_not_much_wider_than_needed() {
        let interval = Interval {
            lower: 1.0,
            upper: 1.5,
        };
        let image = interval.sin();
        assert!((image.lower - 1f64.sin()).abs() < 1e-14 && image.upper < 1.5f64.sin() + 1e-14);
        let image = interval.mul(interval.negative());
        assert!((image.lower + 2.25).abs() < 1e-14 && (image.upper + 1.0).abs() < 1e-14);
    }
}
