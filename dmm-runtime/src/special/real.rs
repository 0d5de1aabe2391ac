//! Doubles as scalars.

use wide::{f64x2, f64x4};

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

/// Functions of packs of two or four doubles, by vectors.
macro_rules! by_vectors {
    ($($function:ident($($u:ident),+) => $value:expr;)*) => {$(
        #[inline(always)]
        fn $function<const L: usize>($($u: [f64; L]),+) -> [f64; L] {
            const { assert!(L == 2 || L == 4) };
            if L == 2 {
                $(let $u = f64x2::new(resized($u));)+
                resized(($value).to_array())
            } else {
                $(let $u = f64x4::new(resized($u));)+
                resized(($value).to_array())
            }
        }
    )*};
}

/// The same array; zeros where its length is another one.
#[inline(always)]
fn resized<const A: usize, const B: usize>(u: [f64; A]) -> [f64; B] {
    u.first_chunk().copied().unwrap_or([0.0; B])
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

    by_vectors! {
        // the larger of −∞ and each, as LLVM would take a vector that nothing is done with apart again
        joined(u) => u.fast_max(f64::NEG_INFINITY.into());
        pack_sums(u, v) => u + v;
        pack_differences(u, v) => u - v;
        pack_products(u, v) => u * v;
        pack_negatives(u) => -u;
        pack_fused(u, v, w) => u.mul_add(v, w);
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
