//! Interval arithmetic: a scalar that encloses every value that an expression takes.
//!
//! Each operation gives the smallest interval of doubles around all results, widened by a unit in
//! the last place on each side (two for elementary functions), so that rounding cannot lose a
//! value (Moore, *Interval Analysis*, 1966). Where an argument leaves the domain of a function,
//! the result is the whole line: nothing is known then, and nothing may be concluded from it.
//!
//! The generated functions are generic over the scalar; over intervals they enclose a switching
//! function and its Taylor coefficients on a piece of a trajectory.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::arithmetic::Scalar;

/// All values from `low` to `high`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// The next double below, but for zero, which sums give exactly.
#[inline]
fn down(value: f64) -> f64 {
    if value == 0.0 {
        value
    } else {
        value.next_down()
    }
}

/// The next double above, but for zero.
#[inline]
fn up(value: f64) -> f64 {
    if value == 0.0 { value } else { value.next_up() }
}

/// The product of two bounds: a bound of infinity is not attained, and zero times it is zero.
#[inline]
fn bound_product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

impl Interval {
    /// All reals.
    pub(crate) const WHOLE: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// From `low` to `high`; everything if a bound is not a number.
    #[inline]
    pub(crate) fn new(low: f64, high: f64) -> Self {
        if low <= high {
            Self { low, high }
        } else {
            Self::WHOLE
        }
    }

    /// The largest absolute value.
    #[inline]
    pub(crate) fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The interval times −1 where `sign` is negative.
    #[inline]
    pub(crate) fn turned(self, sign: f64) -> Self {
        if sign < 0.0 { -self } else { self }
    }

    /// The image under an increasing function whose values are within two units in the last place.
    fn increasing(self, function: impl Fn(f64) -> f64) -> Self {
        Self::new(down(down(function(self.low))), up(up(function(self.high))))
    }

    /// The image under a decreasing function.
    fn decreasing(self, function: impl Fn(f64) -> f64) -> Self {
        Self::new(down(down(function(self.high))), up(up(function(self.low))))
    }

    /// The image under an even function that increases from 0 on.
    fn even(self, function: impl Fn(f64) -> f64) -> Self {
        Scalar::abs(self).increasing(function)
    }

    /// The interval if it lies in the domain from `low` to `high`, else everything.
    fn within(self, low: f64, high: f64, image: impl Fn(Self) -> Self) -> Self {
        if self.low >= low && self.high <= high {
            image(self)
        } else {
            Self::WHOLE
        }
    }

    /// Whether phase + 2πn lies in the interval for an integer n.
    fn meets(self, phase: f64) -> bool {
        /// The arguments of sines this large are not known to a part of a turn.
        const MARGIN: f64 = 1e-9;
        let turn = 2.0 * PI;
        let first = ((self.low - phase) / turn - MARGIN).ceil();
        first * turn + phase <= self.high + MARGIN * turn
    }

    /// The image of a wave between −1 and 1 with its crest at `crest` + 2πn.
    fn wave(self, function: impl Fn(f64) -> f64, crest: f64) -> Self {
        /// Beyond this a turn is not resolved.
        const FAR: f64 = 1e6;
        let is_near = self.magnitude() < FAR;
        if !is_near {
            return Self::new(-1.0, 1.0);
        }
        let (a, b) = (function(self.low), function(self.high));
        let low = if self.meets(crest + PI) {
            -1.0
        } else {
            down(down(a.min(b)))
        };
        let high = if self.meets(crest) {
            1.0
        } else {
            up(up(a.max(b)))
        };
        Self::new(low, high)
    }
}

impl PartialOrd for Interval {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self.high < other.low {
            Some(Ordering::Less)
        } else if self.low > other.high {
            Some(Ordering::Greater)
        } else if self == other && self.low == self.high {
            Some(Ordering::Equal)
        } else {
            None
        }
    }
}

impl Neg for Interval {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }
}

impl Add for Interval {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(down(self.low + other.low), up(self.high + other.high))
    }
}

impl Sub for Interval {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let products = [
            bound_product(self.low, other.low),
            bound_product(self.low, other.high),
            bound_product(self.high, other.low),
            bound_product(self.high, other.high),
        ];
        let [first, rest @ ..] = products;
        let low = rest.iter().fold(first, |low, &p| low.min(p));
        let high = rest.iter().fold(first, |high, &p| high.max(p));
        Self::new(down(low), up(high))
    }
}

impl Div for Interval {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let inverse = if other.low > 0.0 || other.high < 0.0 {
            Self::new(down(1.0 / other.high), up(1.0 / other.low))
        } else if other.low == 0.0 && other.high > 0.0 {
            Self::new(down(1.0 / other.high), f64::INFINITY)
        } else if other.high == 0.0 && other.low < 0.0 {
            Self::new(f64::NEG_INFINITY, up(1.0 / other.low))
        } else {
            return Self::WHOLE;
        };
        self * inverse
    }
}

/// The assigning operators, by the others.
macro_rules! assign {
    ($($operator:ident $function:ident $symbol:tt;)*) => {$(
        impl $operator for Interval {
            #[inline]
            fn $function(&mut self, other: Self) {
                *self = *self $symbol other;
            }
        }
    )*};
}

assign! {
    AddAssign add_assign +;
    SubAssign sub_assign -;
    MulAssign mul_assign *;
    DivAssign div_assign /;
}

impl Scalar for Interval {
    const ROUNDING: f64 = f64::ROUNDING;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::new(value, value)
    }

    #[inline]
    fn to_f64(self) -> f64 {
        f64::midpoint(self.low, self.high)
    }

    #[inline]
    fn fused(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    #[inline]
    fn squared(self) -> Self {
        let size = Scalar::abs(self);
        Self::new(
            down(size.low * size.low).max(0.0),
            up(size.high * size.high),
        )
    }

    fn abs(self) -> Self {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            -self
        } else {
            Self::new(0.0, self.magnitude())
        }
    }

    fn sqrt(self) -> Self {
        self.within(0.0, f64::INFINITY, |u| u.increasing(f64::sqrt))
    }

    fn exp(self) -> Self {
        let image = self.increasing(f64::exp);
        Self::new(image.low.max(0.0), image.high)
    }

    fn ln(self) -> Self {
        self.within(0.0, f64::INFINITY, |u| u.increasing(f64::ln))
    }

    fn sin(self) -> Self {
        self.wave(f64::sin, FRAC_PI_2)
    }

    fn cos(self) -> Self {
        self.wave(f64::cos, 0.0)
    }

    fn tan(self) -> Self {
        let is_whole = self.high - self.low >= PI
            || self.magnitude() > 1e6
            || self.meets(FRAC_PI_2)
            || self.meets(-FRAC_PI_2);
        if is_whole {
            Self::WHOLE
        } else {
            self.increasing(f64::tan)
        }
    }

    fn sinh(self) -> Self {
        self.increasing(f64::sinh)
    }

    fn cosh(self) -> Self {
        self.even(f64::cosh)
    }

    fn tanh(self) -> Self {
        self.increasing(f64::tanh)
    }

    fn asin(self) -> Self {
        self.within(-1.0, 1.0, |u| u.increasing(f64::asin))
    }

    fn acos(self) -> Self {
        self.within(-1.0, 1.0, |u| u.decreasing(f64::acos))
    }

    fn atan(self) -> Self {
        self.increasing(f64::atan)
    }

    fn powi(self, n: i32) -> Self {
        let power = |u: f64| u.powi(n.abs());
        let image = if n % 2 == 0 {
            self.even(power)
        } else {
            self.increasing(power)
        };
        let image = if n % 2 == 0 {
            Self::new(image.low.max(0.0), image.high)
        } else {
            image
        };
        if n < 0 {
            Self::from_f64(1.0) / image
        } else {
            image
        }
    }

    fn powf(self, v: Self) -> Self {
        // powers of negative numbers have integer exponents
        let integer = v.low as i32;
        if v.low == v.high && v.low == f64::from(integer) {
            return self.powi(integer);
        }
        self.within(0.0, f64::INFINITY, |u| Scalar::exp(v * Scalar::ln(u)))
    }

    fn exp_product(self, b: Self) -> Self {
        Scalar::exp(self * b)
    }

    // The divided differences belong to the steps of schemes, which are not enclosed.

    fn sinc(self) -> Self {
        Self::new(-1.0, 1.0)
    }

    fn sinc_prime(self) -> Self {
        Self::new(-1.0, 1.0)
    }

    fn sinhc(self) -> Self {
        Self::new(1.0, f64::INFINITY)
    }

    fn sinhc_prime(self) -> Self {
        Self::WHOLE
    }

    fn ln_dd(self, _: Self) -> Self {
        Self::WHOLE
    }

    fn ln_dd_prime(self, _: Self) -> Self {
        Self::WHOLE
    }

    fn asin_dd(self, _: Self) -> Self {
        Self::WHOLE
    }

    fn asin_dd_prime(self, _: Self) -> Self {
        Self::WHOLE
    }

    fn atan_dd(self, _: Self) -> Self {
        Self::WHOLE
    }

    fn atan_dd_prime(self, _: Self) -> Self {
        Self::WHOLE
    }
}

#[cfg(test)]
mod tests;
