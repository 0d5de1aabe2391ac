//! The divided difference of the logarithm.
//!
//! In terms of z = (b − a)/(a + b), ln b − ln a = 2 atanh z, so that the divided difference
//! is 2 A(−z²)/(a + b): the reciprocal of the mean, times a series that depends on the relative
//! step alone. What the sum a + b loses in rounding is known exactly and put back.

use super::arc::{CLOSE, HOT, arc_remainder};
use super::double::Double;
use super::extended::Extended;
use crate::time::two_product;

/// a + b between which every intermediate result of a divided difference is a normal number.
const TINY: f64 = 1e-300;
const HUGE: f64 = 1e300;

/// The same for its derivative, which takes products.
const TINY_FACTOR: f64 = 1e-140;
const HUGE_FACTOR: f64 = 1e140;

/// b/a from which the terms of the derivative hardly cancel, so that a logarithm with the
/// digits of a double does.
const APART: f64 = 64.0;

/// 2¹⁰⁰, by which arguments beyond TINY and HUGE are scaled; exact.
const SCALE: f64 = (1_u128 << 100) as f64;

/// The divided difference of the logarithm.
///
/// Equation: (ln b − ln a)/(b − a) = 2 atanh(z)/(z (a + b)), z = (b − a)/(a + b); 1/a at b = a.
/// It is the reciprocal of the logarithmic mean.
///
/// Domain: a, b > 0; limits ∞ where one is 0, 0 where one is infinite; NaN for negative
/// arguments and for 0 together with ∞.
///
/// Accuracy: 2 ulp. Symmetric in a and b to the last bit.
///
/// Source: Abramowitz & Stegun (1964), 4.6.22 and 4.6.33.
///
/// ```
/// use dmm_runtime::special::ln_dd;
/// assert_eq!(ln_dd(2.0, 2.0), 0.5);
/// assert!((ln_dd(1.0, 2.0) - 2.0_f64.ln()).abs() < 1e-15);
/// ```
#[inline]
pub fn ln_dd(a: f64, b: f64) -> f64 {
    let Double {
        high: sum,
        low: error,
    } = Double::sum(a, b);
    let z = (b - a) / sum;
    let x = z * z;
    if x <= CLOSE && sum > TINY && sum < HUGE {
        let reciprocal = 2.0 / sum;
        // The last term is what the rounding of the sum took away.
        reciprocal + reciprocal * (x * arc_remainder(-x) - 0.5 * reciprocal * error)
    } else {
        ln_dd_far(a, b, x)
    }
}

#[cold]
fn ln_dd_far(a: f64, b: f64, x: f64) -> f64 {
    if let Some(limit) = limit(a, b, 1.0) {
        limit
    } else if x <= CLOSE {
        let scale = if a > 1.0 { 1.0 / SCALE } else { SCALE };
        ln_dd(a * scale, b * scale) * scale
    } else {
        let (low, high) = (a.min(b), a.max(b));
        ln_quotient(high, low).quotient(Double::sum(high, -low))
    }
}

/// The derivative of [`ln_dd`] with respect to its second argument.
///
/// Equation: ∂/∂b (ln b − ln a)/(b − a) = −(1/b + 2 z B/(a + b))/(a + b), z = (b − a)/(a + b),
/// B = (atanh(z)/z − 1)/z²; −1/(2a²) at b = a.
///
/// Domain: a, b > 0; limits −∞ where one is 0, 0 where one is infinite; NaN for negative
/// arguments and for 0 together with ∞.
///
/// Accuracy: 2 ulp.
///
/// Source: derivative of the formula of [`ln_dd`].
#[inline]
pub fn ln_dd_prime(a: f64, b: f64) -> f64 {
    let sum = Double::sum(a, b);
    let z = (b - a) / sum.high;
    let x = z * z;
    if sum.high > TINY_FACTOR && sum.high < HUGE_FACTOR {
        if x <= HOT {
            return near_tangent(b, z, sum, 0.0);
        }
        if x <= CLOSE {
            return ln_dd_prime_close(b, z, sum);
        }
    }
    ln_dd_prime_far(a, b)
}

/// Where the term 2zB/(a + b) is so large that its own error leaves no room for that of the
/// quotient 1/(b (a + b)).
fn ln_dd_prime_close(b: f64, z: f64, sum: Double) -> f64 {
    let divisor = b * sum.high;
    let (back, back_error) = two_product(1.0 / divisor, divisor);
    near_tangent(b, z, sum, (back - 1.0) + back_error)
}

/// −(1 + 2zB b/(a + b))/(b (a + b)), `lost` what the rounding of 1/(b (a + b)) took away.
#[inline]
fn near_tangent(b: f64, z: f64, sum: Double, lost: f64) -> f64 {
    let (divisor, divisor_error) = two_product(b, sum.high);
    let leading = 1.0 / divisor;
    // The second term as a part of the first, less what the rounding of the sum took away.
    let bend = (2.0 * z * arc_remainder(-(z * z)) * b - sum.low) / sum.high;
    let lost = lost + divisor_error * leading;
    leading * (lost - bend) - leading
}

#[cold]
fn ln_dd_prime_far(a: f64, b: f64) -> f64 {
    if let Some(limit) = limit(a, b, -1.0) {
        return limit;
    }
    let (low, high) = (a.min(b), a.max(b));
    let is_close = high / low < APART;
    if high < TINY_FACTOR || is_close && high > HUGE_FACTOR {
        // Powers of two: the arguments are moved towards 1 exactly.
        let scale = if high > 1.0 { 1.0 / SCALE } else { SCALE };
        return ln_dd_prime_far(a * scale, b * scale) * scale * scale;
    }
    if is_close {
        let (a, b) = (Double::from(a), Double::from(b));
        let sum = a + b;
        let z = (b - a) / sum;
        let bend = Double::from(2.0) * z * (-(z * z)).arc_remainder() / sum;
        return -((Double::from(1.0) / b + bend) / sum).high;
    }
    let logarithm = ln_quotient(high, low);
    let difference = Double::sum(high, -low);
    // How far the secant's slope is from the tangent's, times b − a or times b.
    let one = Double::from(1.0);
    if a < b {
        let bend = logarithm - (one - Double::from(low) / Double::from(high));
        -(bend / difference).quotient(difference)
    } else {
        let bend = one - logarithm * (Double::from(low) / difference);
        -(bend / difference).quotient(Double::from(low))
    }
}

/// ln(high/low) for high/low ≥ 2.
fn ln_quotient(high: f64, low: f64) -> Double {
    let quotient = high / low;
    if quotient.is_finite() {
        let remainder = (-quotient).mul_add(low, high);
        Double::new(quotient.ln(), remainder / high)
    } else {
        Double::sum(high.ln(), -low.ln())
    }
}

/// The values outside 0 < a, b < ∞.
fn limit(a: f64, b: f64, sign: f64) -> Option<f64> {
    if !(a >= 0.0 && b >= 0.0) {
        return Some(f64::NAN);
    }
    match (a == 0.0 || b == 0.0, a.is_infinite() || b.is_infinite()) {
        (true, true) => Some(f64::NAN),
        (true, false) => Some(sign * f64::INFINITY),
        (false, true) => Some(0.0),
        (false, false) => None,
    }
}
