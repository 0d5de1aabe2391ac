//! Decisions on scalars of which there may be several at once: a truth value for each lane takes the
//! place of a condition, and a choice by it the place of a branch.

use std::ops::Range;

use super::error_free::{HAS_FUSED, split_error};
use super::{Scalar, Vector};

/// A scalar, or one in each of several lanes, that is compared lane by lane.
pub(crate) trait Masked: Scalar {
    /// What a comparison tells.
    type Mask: Mask<Self>;
    /// How many there are.
    const LANES: usize;

    /// Changes the value in a lane.
    fn set_lane(&mut self, lane: usize, value: f64);
    /// Where u > b, u = self.
    fn above(self, b: Self) -> Self::Mask;
    /// Where u ≤ b, u = self.
    #[inline(always)]
    fn at_most(self, b: Self) -> Self::Mask {
        b.above(self).or(b.equals(self))
    }
    /// Where u = b, u = self.
    fn equals(self, b: Self) -> Self::Mask;
    /// The larger of both.
    fn max(self, b: Self) -> Self;
    /// The smaller of both.
    fn min(self, b: Self) -> Self;
    /// What rounding takes from the product u·b, u = self.
    fn product_error(self, b: Self, product: Self) -> Self;
}

/// A truth value for each lane of a scalar.
pub(crate) trait Mask<S>: Copy {
    /// The same in every lane.
    fn all_are(set: bool) -> Self;
    /// Both.
    fn and(self, other: Self) -> Self;
    /// One or both.
    fn or(self, other: Self) -> Self;
    /// Neither.
    fn not(self) -> Self;
    /// Whether it is true in any lane.
    fn any(self) -> bool;
    /// The one where it is true, the other elsewhere.
    fn select(self, one: S, other: S) -> S;

    /// Whether it is true in every lane.
    #[inline(always)]
    fn all(self) -> bool {
        !self.not().any()
    }

    /// Whether it is true in every lane that is `used`.
    #[inline(always)]
    fn all_of(self, used: Self) -> bool {
        !self.not().and(used).any()
    }

    /// The one vector where it is true, the other elsewhere.
    #[inline(always)]
    fn select_vector<const N: usize>(self, one: &Vector<S, N>, other: &Vector<S, N>) -> Vector<S, N>
    where
        S: Scalar,
    {
        vector!(|i| self.select(one[i], other[i]))
    }
}

/// The vector of what an expression gives for each index: a loop in place, as closures are not inlined
/// for certain and what is not inlined does not compute in lanes.
macro_rules! vector {
    (|$index:ident| $value:expr) => {{
        let mut vector: $crate::arithmetic::Vector<_, _> =
            $crate::arithmetic::filled($crate::arithmetic::Scalar::from_f64(0.0));
        for $index in $crate::arithmetic::masked::indices(&vector) {
            vector[$index] = $value;
        }
        vector
    }};
}
pub(crate) use vector;

/// The indices of a vector.
#[inline(always)]
pub(crate) fn indices<S, const K: usize>(_: &Vector<S, K>) -> Range<usize> {
    0..K
}

impl Masked for f64 {
    type Mask = bool;
    const LANES: usize = 1;

    #[inline(always)]
    fn set_lane(&mut self, _lane: usize, value: f64) {
        *self = value;
    }

    #[inline(always)]
    fn above(self, b: f64) -> bool {
        self > b
    }

    #[inline(always)]
    fn at_most(self, b: f64) -> bool {
        self <= b
    }

    #[inline(always)]
    fn equals(self, b: f64) -> bool {
        self == b
    }

    #[inline(always)]
    fn max(self, b: f64) -> f64 {
        f64::max(self, b)
    }

    #[inline(always)]
    fn min(self, b: f64) -> f64 {
        f64::min(self, b)
    }

    /// By a fused operation, which is a call where the target lacks it; there factors that can be
    /// split without overflow are.
    #[inline(always)]
    fn product_error(self, b: f64, product: f64) -> f64 {
        const LARGEST: f64 = 1e150;
        if !HAS_FUSED && self.abs() < LARGEST && b.abs() < LARGEST {
            return split_error(self, b, product);
        }
        self.mul_add(b, -product)
    }
}

impl Mask<f64> for bool {
    #[inline(always)]
    fn all_are(set: bool) -> bool {
        set
    }

    #[inline(always)]
    fn and(self, other: bool) -> bool {
        self & other
    }

    #[inline(always)]
    fn or(self, other: bool) -> bool {
        self | other
    }

    #[inline(always)]
    fn not(self) -> bool {
        !self
    }

    #[inline(always)]
    fn any(self) -> bool {
        self
    }

    #[inline(always)]
    fn select(self, one: f64, other: f64) -> f64 {
        if self { one } else { other }
    }
}
