//! Pairs of doubles without quotients of pairs: what propagators are computed in.

use crate::scalar::Scalar;
use crate::time::{two_product, two_sum};

/// An unevaluated sum of two doubles, |low| ≤ ulp(high)/2, of about 104 bits (Dekker, Numer. Math.
/// 18, 1971; Joldes, Muller & Popescu, ACM Trans. Math. Softw. 44, 2017).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Pair {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl Pair {
    pub(crate) const ONE: Self = Self {
        high: 1.0,
        low: 0.0,
    };

    /// a + b exactly, where |a| ≥ |b|.
    #[inline(always)]
    pub(crate) fn fast_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self {
            high,
            low: b - (high - a),
        }
    }

    /// a/b
    pub(crate) fn ratio(a: f64, b: f64) -> Self {
        let high = a / b;
        let (product, error) = two_product(high, b);
        Self {
            high,
            low: ((a - product) - error) / b,
        }
    }

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        Self::fast_sum(high, error + (self.low + other.low))
    }

    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        let (high, error) = two_product(self.high, other.high);
        Self::fast_sum(
            high,
            error + (self.high * other.low + self.low * other.high),
        )
    }

    #[inline(always)]
    pub(crate) fn scaled(self, factor: f64) -> Self {
        let (high, error) = two_product(self.high, factor);
        Self::fast_sum(high, self.low.fused(factor, error))
    }
}

impl From<f64> for Pair {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}
