//! The function that arc tangent, arc sine and logarithm share.
//!
//! A(x) = atan(√x)/√x for x ≥ 0 and atanh(√−x)/√−x for −1 < x < 0 is one analytic function,
//! 1 − x/3 + x²/5 − …; so is the remainder C(x) = (1 − A(x))/x = 1/3 − x/5 + x²/7 − …
//! (Abramowitz & Stegun 1964, 4.4.42 and 4.6.33).
//!
//! Where the series converges slowly the argument is halved: atan w = 2 atan(w/(1 + v)) with
//! v = √(1 + w²), likewise for atanh, which in terms of C reads
//! C(x) = (1 + 2 C(x/(1+v)²)/(1+v))/(1+v)², v = √(1 + x). Nothing in it cancels.

use super::series::power_series;

/// |x| up to which the series is summed; in terms of the logarithm, b/a from 1/2 to 2.
pub(super) const CLOSE: f64 = 0.1112;

/// |x| up to which a few terms do: consecutive steps of an integration.
const HOT: f64 = 1.0 / 256.0;

/// The coefficients (−1)ᵏ/(2k + 3) of C.
const fn coefficients<const N: usize>() -> [f64; N] {
    let mut coefficients = [0.0; N];
    let mut k = 0;
    while k < N {
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        coefficients[k] = sign / (2 * k + 3) as f64;
        k += 1;
    }
    coefficients
}

/// The first term left out is 2⁻⁵⁸ of the sum.
const HOT_COEFFICIENTS: [f64; 7] = coefficients();
/// The first term left out is 2⁻⁵⁷ of the sum.
const CLOSE_COEFFICIENTS: [f64; 17] = coefficients();

/// C(x) for x > −1.
#[inline]
pub(super) fn arc_remainder(x: f64) -> f64 {
    if x.abs() <= HOT {
        power_series(x, &HOT_COEFFICIENTS)
    } else {
        arc_remainder_wide(x)
    }
}

fn arc_remainder_wide(x: f64) -> f64 {
    if x.abs() <= CLOSE || x.is_nan() {
        power_series(x, &CLOSE_COEFFICIENTS)
    } else {
        let h = 1.0 / (1.0 + (1.0 + x).sqrt());
        (1.0 + 2.0 * h * arc_remainder_wide(x * h * h)) * (h * h)
    }
}
