//! Doubles as scalars.

use wide::f64x4;

use crate::arithmetic::Scalar;
use crate::arithmetic::error_free::HAS_FUSED;
use crate::arithmetic::rows;
use crate::special;

/// Implements functions of [`Scalar`] by those of the same name in a module or of a type.
macro_rules! forward {
    ($module:ident: $($function:ident($($other:ident)?))*) => {$(
        #[inline]
        fn $function(self $(, $other: Self)?) -> Self {
            $module::$function(self $(, $other)?)
        }
    )*};
}

impl Scalar for f64 {
    const ROUNDING: f64 = f64::EPSILON / 2.0;

    #[inline]
    fn from_f64(value: f64) -> Self {
        value
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline]
    fn fused(self, b: Self, c: Self) -> Self {
        if HAS_FUSED {
            self.mul_add(b, c)
        } else {
            self * b + c
        }
    }

    #[inline(always)]
    fn products_by_column<const W: usize>(a: &[f64], b: &[f64]) -> [f64; W] {
        rows::products_by_vectors(a, b)
    }

    /// The larger of −∞ and each, as LLVM would take a vector that nothing is done with apart again.
    #[inline(always)]
    fn joined(four: [f64; 4]) -> [f64; 4] {
        let least = f64x4::splat(f64::NEG_INFINITY);
        least.fast_max(f64x4::new(four)).to_array()
    }

    #[inline(always)]
    fn four_sums(u: [f64; 4], v: [f64; 4]) -> [f64; 4] {
        (f64x4::new(u) + f64x4::new(v)).to_array()
    }

    #[inline(always)]
    fn four_differences(u: [f64; 4], v: [f64; 4]) -> [f64; 4] {
        (f64x4::new(u) - f64x4::new(v)).to_array()
    }

    #[inline(always)]
    fn four_products(u: [f64; 4], v: [f64; 4]) -> [f64; 4] {
        (f64x4::new(u) * f64x4::new(v)).to_array()
    }

    #[inline(always)]
    fn four_negatives(u: [f64; 4]) -> [f64; 4] {
        (-f64x4::new(u)).to_array()
    }

    #[inline(always)]
    fn four_fused(u: [f64; 4], v: [f64; 4], w: [f64; 4]) -> [f64; 4] {
        f64x4::new(u)
            .mul_add(f64x4::new(v), f64x4::new(w))
            .to_array()
    }

    #[inline]
    fn powi(self, n: i32) -> Self {
        f64::powi(self, n)
    }

    forward! {
        f64: abs() sqrt() exp() ln() sin() cos() tan() sinh() cosh() tanh() asin() acos() atan()
            powf(v)
    }
    forward! {
        special: exp_product(b) sinc() sinc_prime() sinhc() sinhc_prime() ln_dd(b) ln_dd_prime(b)
            asin_dd(b) asin_dd_prime(b) atan_dd(b) atan_dd_prime(b)
    }
}
