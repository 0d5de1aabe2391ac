//! Series whose recurrences are alike, two or four side by side: their coefficients of an order are
//! computed together, in a vector of the processor.

use std::ops::{Add, Mul, Neg, Sub};

use crate::arithmetic::Scalar;

/// What recurrences compute with: a scalar, or a [`Pack`].
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

/// The coefficients of L series, two or four.
#[derive(Clone, Copy, Debug)]
pub struct Pack<S, const L: usize>(pub [S; L]);

impl<S: Scalar, const L: usize> Pack<S, L> {
    /// The same in every lane.
    #[inline(always)]
    pub fn all(value: S) -> Self {
        Self([value; L])
    }

    /// Values as one vector: the row of a table that is written by parts cannot be read as a whole at
    /// once.
    #[inline(always)]
    pub fn joined(values: [S; L]) -> Self {
        Self(S::joined(values))
    }

    /// Those of the lanes from `lane` on.
    #[inline(always)]
    pub fn of_lanes(lanes: &[S], lane: usize) -> Self {
        match lanes[lane..].first_chunk() {
            Some(&pack) => Self(pack),
            None => Self::of(f64::NAN),
        }
    }
}

impl<S: Scalar, const L: usize> Arithmetic for Pack<S, L> {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::all(S::from_f64(value))
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        Self(S::pack_fused(self.0, b.0, c.0))
    }

    #[inline(always)]
    fn square(self) -> Self {
        self * self
    }
}

impl<S: Scalar, const L: usize> Neg for Pack<S, L> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(S::pack_negatives(self.0))
    }
}

/// The operators, by the functions of the scalar.
macro_rules! operators {
    ($($operator:ident $function:ident $of_packs:ident;)*) => {$(
        impl<S: Scalar, const L: usize> $operator for Pack<S, L> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(S::$of_packs(self.0, other.0))
            }
        }
    )*};
}

operators! {
    Add add pack_sums;
    Sub sub pack_differences;
    Mul mul pack_products;
}

/// The coefficients of order `order` in the lanes from `lane` on of a table of W lanes.
#[inline(always)]
pub fn pack<S: Scalar, const P: usize, const W: usize, const L: usize>(
    table: &[[S; P]],
    order: usize,
    lane: usize,
) -> Pack<S, L> {
    Pack::of_lanes(&table.as_flattened()[order * W..(order + 1) * W], lane)
}

/// Sets the coefficients of an order in the lanes from `lane` on of a table.
#[inline(always)]
pub fn set_pack<S: Scalar, const P: usize, const L: usize>(
    table: &mut [[S; P]],
    order: usize,
    lane: usize,
    pack: Pack<S, L>,
) {
    let at = order * table.len() + lane;
    table.as_flattened_mut()[at..at + L].copy_from_slice(&pack.0);
}
