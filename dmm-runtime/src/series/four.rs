//! Four series whose recurrences are alike, side by side: their coefficients of an order are computed
//! together, in a vector of the processor.

use std::ops::{Add, Mul, Neg, Sub};

use super::Order;
use crate::arithmetic::Scalar;

/// How many there are.
const LANES: usize = 4;

/// What recurrences compute with: a scalar, or [`Four`].
pub trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The constant nearest to `value`.
    fn of(value: f64) -> Self;
    /// u·b + c, u = self; see [`Scalar::fused`].
    fn times_plus(self, b: Self, c: Self) -> Self;
    /// u²
    fn square(self) -> Self;
}

impl<S: Scalar> Arithmetic for S {
    #[inline(always)]
    fn of(value: f64) -> Self {
        S::from_f64(value)
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        self.fused(b, c)
    }

    #[inline(always)]
    fn square(self) -> Self {
        self.squared()
    }
}

/// The coefficients of four series.
#[derive(Clone, Copy, Debug)]
pub struct Four<S>(pub [S; LANES]);

impl<S: Scalar> Four<S> {
    /// The same four times.
    #[inline(always)]
    pub fn all(value: S) -> Self {
        Self([value; LANES])
    }

    /// Four values as one vector: the row of a table that is written by parts cannot be read as a whole at
    /// once.
    #[inline(always)]
    pub fn joined(values: [S; LANES]) -> Self {
        Self(S::joined(values))
    }

    /// Those of the lanes from `lane` on.
    #[inline(always)]
    pub fn of_lanes(lanes: &[S], lane: usize) -> Self {
        match lanes[lane..].first_chunk() {
            Some(&four) => Self(four),
            None => Self::of(f64::NAN),
        }
    }
}

impl<S: Scalar> Arithmetic for Four<S> {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::all(S::from_f64(value))
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        Self(S::four_fused(self.0, b.0, c.0))
    }

    #[inline(always)]
    fn square(self) -> Self {
        self * self
    }
}

impl<S: Scalar> Neg for Four<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(S::four_negatives(self.0))
    }
}

/// The operators, by the functions of the scalar.
macro_rules! operators {
    ($($operator:ident $function:ident $of_four:ident;)*) => {$(
        impl<S: Scalar> $operator for Four<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(S::$of_four(self.0, other.0))
            }
        }
    )*};
}

operators! {
    Add add four_sums;
    Sub sub four_differences;
    Mul mul four_products;
}

/// The coefficients of order `order` in the lanes from `lane` on of a table of W lanes.
#[inline(always)]
pub fn four<S: Scalar, const P: usize, const W: usize>(
    table: &[[S; P]],
    order: usize,
    lane: usize,
) -> Four<S> {
    Four::of_lanes(&table.as_flattened()[order * W..(order + 1) * W], lane)
}

/// Sets the coefficients of order k in the lanes from `lane` on of a table.
#[inline(always)]
pub fn set_four<S: Scalar, K: Order, const P: usize>(
    k: K,
    table: &mut [[S; P]],
    lane: usize,
    four: Four<S>,
) {
    let at = k.get() * table.len() + lane;
    table.as_flattened_mut()[at..at + LANES].copy_from_slice(&four.0);
}
