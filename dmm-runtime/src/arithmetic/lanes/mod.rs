//! Several scalars at once, the lanes of a vector register.

#[cfg_attr(
    all(target_feature = "avx2", target_feature = "fma"),
    path = "vectors.rs"
)]
#[cfg_attr(
    not(all(target_feature = "avx2", target_feature = "fma")),
    path = "arrays.rs"
)]
mod parts;

use std::array::from_fn;
use std::cmp::Ordering;
use std::hint::black_box;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use pulp::NullaryFnOnce;

use super::Scalar;
use super::masked::{Mask, Masked};
use parts::{Bits, in_lanes};

/// L doubles that are computed with together, each in a lane of its own.
///
/// A build for a processor that has vectors of four doubles and the fused operation computes with the
/// vectors of [`wide`] (`vectors`). Any other has arrays (`arrays`): what [`wide`] computes with is decided
/// when it is compiled, while the compiler turns operations of arrays into instructions for vector
/// registers where the function that they are inlined into allows them. [`Scalar::fused`] is one instruction
/// there, and slow elsewhere.
///
/// A comparison holds if it holds in every lane.
#[derive(Clone, Copy, PartialEq, Debug)]
#[repr(align(64))]
pub(crate) struct Lanes<const L: usize>(pub [f64; L]);

impl<const L: usize> Lanes<L> {
    /// The results of `value` by lane.
    #[inline(always)]
    fn each(value: impl FnMut(usize) -> f64) -> Self {
        Self(from_fn(value))
    }
}

/// The right to compute in lanes.
///
/// What is compiled for every processor of an architecture uses the least of them: x86-64 has
/// vectors of two doubles and no fused operation. So the lanes are compiled for the processors
/// since 2013 (AVX2 and FMA) besides, and used where they run on one. [`pulp`] makes that safe.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vectorised {
    #[cfg(target_arch = "x86_64")]
    level: pulp::x86::V3,
}

impl Vectorised {
    /// It, if the processor has what it takes.
    #[inline]
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn new() -> Option<Self> {
        pulp::x86::V3::try_new().map(|level| Self { level })
    }

    /// It, if the processor has what it takes.
    #[inline]
    #[cfg(not(target_arch = "x86_64"))]
    pub(crate) fn new() -> Option<Self> {
        cfg!(target_arch = "aarch64").then_some(Self {})
    }

    /// Does the work.
    #[inline(always)]
    pub(crate) fn run<Work: NullaryFnOnce>(self, work: Work) -> Work::Output {
        #[cfg(target_arch = "x86_64")]
        return self.level.vectorize(work);
        #[cfg(not(target_arch = "x86_64"))]
        return work.call();
    }
}

/// A truth value for each lane: all bits or none, as vector registers have it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneMask<const L: usize>([Bits; L]);

impl<const L: usize> Mask<Lanes<L>> for LaneMask<L> {
    #[inline(always)]
    fn all_are(set: bool) -> Self {
        Self([parts::bits(set); L])
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(in_lanes!(a = self.0, b = other.0; a & b))
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(in_lanes!(a = self.0, b = other.0; a | b))
    }

    #[inline(always)]
    fn not(self) -> Self {
        Self(in_lanes!(a = self.0; !a))
    }

    #[inline(always)]
    fn any(self) -> bool {
        parts::any(&self.0)
    }

    #[inline(always)]
    fn select(self, one: Lanes<L>, other: Lanes<L>) -> Lanes<L> {
        Lanes(in_lanes!(mask = self.0, a = one.0, b = other.0; parts::select(mask, a, b)))
    }
}

impl<const L: usize> Masked for Lanes<L> {
    type Mask = LaneMask<L>;
    const LANES: usize = L;

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        self.0[lane] = value;
    }

    #[inline(always)]
    fn above(self, b: Self) -> LaneMask<L> {
        LaneMask(in_lanes!(a = self.0, b = b.0; parts::above(a, b)))
    }

    #[inline(always)]
    fn equals(self, b: Self) -> LaneMask<L> {
        LaneMask(in_lanes!(a = self.0, b = b.0; parts::equals(a, b)))
    }

    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Self(in_lanes!(a = self.0, b = b.0; parts::larger(a, b)))
    }

    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Self(in_lanes!(a = self.0, b = b.0; parts::smaller(a, b)))
    }

    #[inline(always)]
    fn product_error(self, b: Self, product: Self) -> Self {
        self.fused(b, -product)
    }
}

impl<const L: usize> PartialOrd for Lanes<L> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let mut orders = self.0.iter().zip(&other.0).map(|(a, b)| a.partial_cmp(b));
        let first = orders.next()??;
        orders.all(|order| order == Some(first)).then_some(first)
    }

    #[inline]
    fn le(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(a, b)| a <= b)
    }

    #[inline]
    fn ge(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(a, b)| a >= b)
    }
}

impl<const L: usize> Neg for Lanes<L> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(in_lanes!(a = self.0; -a))
    }
}

/// The operators, by lane.
macro_rules! operators {
    ($($operator:ident $function:ident $assign:ident $assign_function:ident $symbol:tt;)*) => {$(
        impl<const L: usize> $operator for Lanes<L> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(in_lanes!(a = self.0, b = other.0; a $symbol b))
            }
        }

        impl<const L: usize> $assign for Lanes<L> {
            #[inline(always)]
            fn $assign_function(&mut self, other: Self) {
                *self = *self $symbol other;
            }
        }
    )*};
}

operators! {
    Add add AddAssign add_assign +;
    Sub sub SubAssign sub_assign -;
    Mul mul MulAssign mul_assign *;
    Div div DivAssign div_assign /;
}

/// The functions of a double, by lane.
macro_rules! by_lane {
    ($($function:ident($($other:ident)?))*) => {$(
        #[inline(always)]
        fn $function(self $(, $other: Self)?) -> Self {
            Self::each(|i| Scalar::$function(self.0[i] $(, $other.0[i])?))
        }
    )*};
}

impl<const L: usize> Scalar for Lanes<L> {
    const ROUNDING: f64 = f64::ROUNDING;

    #[inline(never)]
    fn apart<Work: NullaryFnOnce>(work: Work) -> Work::Output {
        match Vectorised::new() {
            Some(how) => how.run(work),
            None => work.call(),
        }
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self([value; L])
    }

    /// Lane 0.
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0.first().copied().unwrap_or(f64::NAN)
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    fn by_lane(value: impl Fn(usize) -> f64) -> Self {
        Self::each(value)
    }

    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        Self(in_lanes!(a = self.0, b = b.0, c = c.0; a.mul_add(b, c)))
    }

    /// By way of memory.
    #[inline(always)]
    fn settled(self) -> Self {
        black_box(self)
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        Self::each(|i| Scalar::powi(self.0[i], n))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(in_lanes!(a = self.0; a.abs()))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(in_lanes!(a = self.0; a.sqrt()))
    }

    by_lane! {
        exp() ln() sin() cos() tan() sinh() cosh() tanh() asin() acos() atan()
        powf(v) exp_product(b) sinc() sinc_prime() sinhc() sinhc_prime() ln_dd(b) ln_dd_prime(b)
        asin_dd(b) asin_dd_prime(b) atan_dd(b) atan_dd_prime(b)
    }
}
