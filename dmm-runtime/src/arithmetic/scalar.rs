//! The scalars that generated evaluation functions are generic over.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use pulp::NullaryFnOnce;

use super::rows;

/// A value of each lane, as an array like u: by a loop, as closures are not inlined for certain.
macro_rules! lane_by_lane {
    ($i:ident, $u:ident: $value:expr) => {{
        let mut lanes = $u;
        for ($i, lane) in lanes.iter_mut().enumerate() {
            *lane = $value;
        }
        lanes
    }};
}

/// A real scalar: `f64`; within this crate also pairs of doubles, and several doubles at once.
///
/// Constants enter through [`Scalar::from_f64`]. The elementary functions are those of the
/// declaration language; the others are the divided differences that the Discrete Multiplier
/// Method needs, see [`special`](crate::special).
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// Half the distance from 1 to the next scalar: the relative rounding error.
    const ROUNDING: f64;

    /// Orders of derivatives that it carries.
    const DERIVATIVES: usize = 0;

    /// What work gives, by a function of its own. Of several scalars at once it is compiled for
    /// vector registers if it is inlined always, as closures are not.
    #[doc(hidden)]
    #[inline(never)]
    fn apart<Work: NullaryFnOnce>(work: Work) -> Work::Output {
        work.call()
    }
    /// The scalar nearest to `value`.
    fn from_f64(value: f64) -> Self;
    /// The value as a double.
    fn to_f64(self) -> f64;
    /// The value in a lane, where there are several at once.
    #[inline(always)]
    fn lane(self, _lane: usize) -> f64 {
        self.to_f64()
    }
    /// The scalar nearest to `value(i)` in every lane i.
    #[inline(always)]
    fn by_lane(value: impl Fn(usize) -> f64) -> Self {
        Self::from_f64(value(0))
    }
    /// u·b + c, u = self: with one rounding where the processor has an instruction for it,
    /// which the target's features tell, and otherwise with two. (A library's fused operation
    /// takes several times as long as a product and a sum.)
    fn fused(self, b: Self, c: Self) -> Self;
    /// Σ aⱼ bₙ₋₁₋ⱼ over n rows of W numbers, by column; W is a multiple of four.
    #[inline(always)]
    fn products_by_column<const W: usize>(a: &[Self], b: &[Self]) -> [Self; W] {
        rows::products(Self::from_f64(0.0), Self::fused, a, b)
    }
    /// L scalars in one vector, where there are such.
    #[doc(hidden)]
    #[inline(always)]
    fn joined<const L: usize>(u: [Self; L]) -> [Self; L] {
        u
    }
    /// u + v of L scalars, 2 or 4.
    #[doc(hidden)]
    #[inline(always)]
    fn pack_sums<const L: usize>(u: [Self; L], v: [Self; L]) -> [Self; L] {
        lane_by_lane!(i, u: u[i] + v[i])
    }
    /// u − v of L scalars.
    #[doc(hidden)]
    #[inline(always)]
    fn pack_differences<const L: usize>(u: [Self; L], v: [Self; L]) -> [Self; L] {
        lane_by_lane!(i, u: u[i] - v[i])
    }
    /// u v of L scalars.
    #[doc(hidden)]
    #[inline(always)]
    fn pack_products<const L: usize>(u: [Self; L], v: [Self; L]) -> [Self; L] {
        lane_by_lane!(i, u: u[i] * v[i])
    }
    /// −u of L scalars.
    #[doc(hidden)]
    #[inline(always)]
    fn pack_negatives<const L: usize>(u: [Self; L]) -> [Self; L] {
        lane_by_lane!(i, u: -u[i])
    }
    /// u·v + w of L scalars; see [`Scalar::fused`].
    #[doc(hidden)]
    #[inline(always)]
    fn pack_fused<const L: usize>(u: [Self; L], v: [Self; L], w: [Self; L]) -> [Self; L] {
        lane_by_lane!(i, u: u[i].fused(v[i], w[i]))
    }
    /// u, where a chain of operations is so long that it is better interrupted. (Of several
    /// scalars at once the compiler finds only ten operations or so that belong together.)
    #[inline(always)]
    fn settled(self) -> Self {
        self
    }
    /// u²
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
    /// Whether it is zero with all the derivatives that it carries.
    #[inline(always)]
    fn is_zero(self) -> bool {
        self.to_f64() == 0.0
    }
    /// |u|
    fn abs(self) -> Self;
    /// √u
    fn sqrt(self) -> Self;
    /// eᵘ
    fn exp(self) -> Self;
    /// ln u
    fn ln(self) -> Self;
    /// sin u
    fn sin(self) -> Self;
    /// cos u
    fn cos(self) -> Self;
    /// tan u
    fn tan(self) -> Self;
    /// sinh u
    fn sinh(self) -> Self;
    /// cosh u
    fn cosh(self) -> Self;
    /// tanh u
    fn tanh(self) -> Self;
    /// asin u
    fn asin(self) -> Self;
    /// acos u
    fn acos(self) -> Self;
    /// atan u
    fn atan(self) -> Self;
    /// uⁿ for an integer n
    fn powi(self, n: i32) -> Self;
    /// uᵛ
    fn powf(self, v: Self) -> Self;
    /// e^{u·b}, u = self, without the rounding error of the product
    fn exp_product(self, b: Self) -> Self;
    /// sin(u)/u
    fn sinc(self) -> Self;
    /// d sinc(u)/du
    fn sinc_prime(self) -> Self;
    /// sinh(u)/u
    fn sinhc(self) -> Self;
    /// d sinhc(u)/du
    fn sinhc_prime(self) -> Self;
    /// (ln b − ln a)/(b − a), a = self
    fn ln_dd(self, b: Self) -> Self;
    /// ∂ ln_dd(a, b)/∂b
    fn ln_dd_prime(self, b: Self) -> Self;
    /// (asin b − asin a)/(b − a), a = self
    fn asin_dd(self, b: Self) -> Self;
    /// ∂ asin_dd(a, b)/∂b
    fn asin_dd_prime(self, b: Self) -> Self;
    /// (atan b − atan a)/(b − a), a = self
    fn atan_dd(self, b: Self) -> Self;
    /// ∂ atan_dd(a, b)/∂b
    fn atan_dd_prime(self, b: Self) -> Self;
}

/// A scalar that carries derivatives.
pub(crate) trait Derived: Scalar {
    /// h′(u) at a double; nothing where h has no value.
    fn derivative(at: f64, h: impl FnOnce(Self) -> Option<Self>) -> Option<f64>;
}

/// A sum that is so many rounding errors of its terms away from zero is not distinguished from it.
const NOISE: f64 = 16.0;

/// The rounding error of a sum whose terms are of a size; see [`NOISE`].
#[inline(always)]
pub(crate) fn noise<S: Scalar>(size: S) -> S {
    S::from_f64(NOISE * f64::ROUNDING) * size
}
