//! Pairs of doubles.
//!
//! u = high + low with |low| ≤ ulp(high)/2: about 104 bits (Joldes, Muller & Popescu 2017, ACM
//! Trans. Math. Softw. 44(2), algorithms 1, 2, 5, 11 and 17; root by long division). The error of a sum is relative to the
//! larger term, like those of the terms.
//! Levels of conserved quantities and the propagators of exact flows are such pairs, and so are
//! the sums in a divided difference whose rounding errors are put back.

use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::Scalar;
use super::alone;
use super::error_free::{split_error, two_sum};
use super::masked::Masked;

/// What π/2 as a double lacks: the next 53 bits.
const FRAC_PI_2_LOW: f64 = 6.123_233_995_736_766e-17;

/// An unevaluated sum of two scalars.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug, Default)]
pub(crate) struct Pair<S> {
    pub(crate) high: S,
    pub(crate) low: S,
}

/// An unevaluated sum of two doubles.
pub(crate) type Double = Pair<f64>;

impl<S> Pair<S> {
    /// A number of more digits than a scalar has.
    pub(crate) const fn new(high: S, low: S) -> Self
    where
        S: Copy,
    {
        Self { high, low }
    }

    /// The same, read number by number; see [`alone`].
    #[inline(always)]
    pub(crate) fn by_numbers(&self) -> Self
    where
        S: Copy,
    {
        Self {
            high: alone(&self.high),
            low: alone(&self.low),
        }
    }
}

impl<S: Masked> Pair<S> {
    /// a + b exactly, where |a| ≥ |b|.
    #[inline(always)]
    pub(crate) fn fast_sum(a: S, b: S) -> Self {
        let high = a + b;
        Self::new(high, b - (high - a))
    }

    /// a + b exactly.
    #[inline(always)]
    pub(crate) fn sum(a: S, b: S) -> Self {
        let (high, low) = two_sum(a, b);
        Self { high, low }
    }

    /// The product with a scalar.
    #[inline(always)]
    pub(crate) fn scaled(self, factor: S) -> Self {
        let product = Self::product(self.high, factor);
        Self::fast_sum(product.high, self.low.fused(factor, product.low))
    }

    /// a·b exactly.
    #[inline(always)]
    pub(crate) fn product(a: S, b: S) -> Self {
        let high = a * b;
        Self::new(high, a.product_error(b, high))
    }

    /// See [`Scalar::settled`].
    #[inline(always)]
    fn settled(self) -> Self {
        Self::new(self.high.settled(), self.low.settled())
    }

    /// The results of `value` by lane.
    #[inline(always)]
    pub(crate) fn each(self, value: impl Fn(Double) -> Double) -> Self {
        let mut result = self;
        for lane in 0..S::LANES {
            let u = value(Pair::new(self.high.lane(lane), self.low.lane(lane)));
            result.high.set_lane(lane, u.high);
            result.low.set_lane(lane, u.low);
        }
        result
    }
}

impl Double {
    pub(crate) const ONE: Self = Self::new(1.0, 0.0);

    /// π/2
    pub(crate) const FRAC_PI_2: Self = Self::new(FRAC_PI_2, FRAC_PI_2_LOW);

    /// 1/n, where the product of n and the double next to 1/n is almost 1.
    pub(crate) const fn inverse_of(n: f64) -> Self {
        let high = 1.0 / n;
        let product = high * n;
        let remainder = (1.0 - product) - split_error(high, n, product);
        Self::new(high, remainder / n)
    }

    /// self/other, rounded once but for terms of second order.
    pub(crate) fn quotient(self, other: Self) -> f64 {
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
    pub(crate) fn root(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 {
            return Self::from(root);
        }
        let remainder = self - Self::product(root, root);
        Self::fast_sum(root, remainder.high / (2.0 * root))
    }

    /// The angle of the direction (cosine, sine): that of the rounded coordinates, and what
    /// their rounding took from it.
    pub(crate) fn angle(cosine: Self, sine: Self) -> Self {
        let turn = sine.low * cosine.high - cosine.low * sine.high;
        let square = sine.high * sine.high + cosine.high * cosine.high;
        Self::new(sine.high.atan2(cosine.high), turn / square)
    }
}

// what is not inlined does not compute in lanes
impl<S: Scalar> From<S> for Pair<S> {
    #[inline(always)]
    fn from(value: S) -> Self {
        Self {
            high: value,
            low: S::from_f64(0.0),
        }
    }
}

impl<S: Masked> Neg for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl<S: Masked> Add for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let sum = Self::sum(self.high, other.high);
        Self::fast_sum(sum.high, sum.low + (self.low + other.low)).settled()
    }
}

impl<S: Masked> Sub for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<S: Masked> Mul for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high.fused(other.low, self.low * other.high);
        Self::fast_sum(product.high, product.low + cross).settled()
    }
}

impl<S: Masked> Div for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        // first × other, whose high part is subtracted exactly
        let product = other.scaled(first);
        let rest = (self.high - product.high) + (self.low - product.low);
        Self::fast_sum(first, rest / other.high)
    }
}

/// The assigning operators.
macro_rules! assigning {
    ($($operator:ident $function:ident $symbol:tt;)*) => {$(
        impl<S: Masked> $operator for Pair<S> {
            #[inline(always)]
            fn $function(&mut self, other: Self) {
                *self = *self $symbol other;
            }
        }
    )*};
}

assigning! {
    AddAssign add_assign +;
    SubAssign sub_assign -;
    MulAssign mul_assign *;
    DivAssign div_assign /;
}
