//! Pairs of doubles.
//!
//! u = high + low with |low| ≤ ulp(high)/2: about 104 bits (Joldes, Muller & Popescu 2017, ACM
//! Trans. Math. Softw. 44(2), algorithms 1, 2, 6 and 11; quotient and root by long division).
//! Levels of conserved quantities and the propagators of exact flows are such pairs, and so are
//! the sums in a divided difference whose rounding errors are put back.

use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::arithmetic::Scalar;
use crate::arithmetic::error_free::{two_product, two_sum};

/// What π/2 as a double lacks: the next 53 bits.
const FRAC_PI_2_LOW: f64 = 6.123_233_995_736_766e-17;

/// An unevaluated sum of two doubles.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug, Default)]
pub(crate) struct Double {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl Double {
    pub(crate) const ONE: Self = Self::new(1.0, 0.0);

    /// π/2
    pub(super) const FRAC_PI_2: Self = Self::new(FRAC_PI_2, FRAC_PI_2_LOW);

    /// A number of more digits than a double has.
    pub(crate) const fn new(high: f64, low: f64) -> Self {
        Self { high, low }
    }

    /// a + b exactly, where |a| ≥ |b|.
    #[inline(always)]
    pub(crate) fn fast_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self {
            high,
            low: b - (high - a),
        }
    }

    /// a + b exactly.
    #[inline]
    pub(crate) fn sum(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Self { high, low }
    }

    /// a/b
    pub(crate) fn ratio(a: f64, b: f64) -> Self {
        Self::from(a) / Self::from(b)
    }

    /// The sum in fewer operations than [`Add`]: the error is relative to the larger term.
    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        let sum = Self::sum(self.high, other.high);
        Self::fast_sum(sum.high, sum.low + (self.low + other.low))
    }

    /// The product with a double.
    #[inline(always)]
    pub(crate) fn scaled(self, factor: f64) -> Self {
        let product = Self::product(self.high, factor);
        Self::fast_sum(product.high, self.low.fused(factor, product.low))
    }

    /// a·b exactly. The fused operation is a call where the target lacks it; there factors
    /// that can be split without overflow are.
    #[inline(always)]
    pub(super) fn product(a: f64, b: f64) -> Self {
        const LARGEST: f64 = 1e150;
        let has_fused = cfg!(any(target_feature = "fma", target_arch = "aarch64"));
        if !has_fused && a.abs() < LARGEST && b.abs() < LARGEST {
            let (high, low) = two_product(a, b);
            return Self { high, low };
        }
        let high = a * b;
        let low = a.mul_add(b, -high);
        Self { high, low }
    }

    /// self/other, rounded once but for terms of second order.
    pub(super) fn quotient(self, other: Self) -> f64 {
        let quotient = self.high / other.high;
        let remainder = (-quotient).mul_add(other.high, self.high);
        let correction = (remainder + (self.low - quotient * other.low)) / other.high;
        if correction.is_finite() {
            quotient + correction
        } else {
            quotient
        }
    }

    /// √u
    pub(super) fn root(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 {
            return Self::from(root);
        }
        let remainder = self - Self::product(root, root);
        Self::fast_sum(root, remainder.high / (2.0 * root))
    }

    /// The angle of the direction (cosine, sine): that of the rounded coordinates, and what
    /// their rounding took from it.
    pub(super) fn angle(cosine: Self, sine: Self) -> Self {
        let turn = sine.low * cosine.high - cosine.low * sine.high;
        let square = sine.high * sine.high + cosine.high * cosine.high;
        Self::new(sine.high.atan2(cosine.high), turn / square)
    }
}

impl From<f64> for Double {
    #[inline]
    fn from(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }
}

impl Neg for Double {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for Double {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let sum = Self::fast_sum(high.high, high.low + low.high);
        Self::fast_sum(sum.high, low.low + sum.low)
    }
}

impl Sub for Double {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high.fused(other.low, self.low * other.high);
        Self::fast_sum(product.high, product.low + cross)
    }
}

impl Div for Double {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let remainder = self - other * Self::from(first);
        let second = remainder.high / other.high;
        let remainder = remainder - other * Self::from(second);
        Self::fast_sum(first, second) + Self::from(remainder.high / other.high)
    }
}
