//! The divided difference of the logarithm.
//!
//! In terms of z = (b − a)/(a + b), ln b − ln a = 2 atanh z, so that the divided difference
//! is 2 A(−z²)/(a + b): the reciprocal of the mean, times a series that depends on the relative
//! step alone. What the sum a + b loses in rounding is known exactly and put back.

use super::arc::{CLOSE, arc_remainder};
use crate::arithmetic::double::Double;

/// a + b between which every intermediate result of a divided difference is a normal number.
const TINY: f64 = 1e-300;
const HUGE: f64 = 1e300;

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
/// B = (atanh(z)/z − 1)/z²; where b/a is above 2 or below 1/2, (1/b − h[a, b])/(b − a);
/// −1/(2a²) at b = a.
///
/// Domain: a, b > 0; limits −∞ where one is 0, 0 where one is infinite; NaN for negative
/// arguments and for 0 together with ∞.
///
/// Accuracy: that of the [derivatives](super).
///
/// Source: derivative of the formula of [`ln_dd`].
#[inline]
pub fn ln_dd_prime(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let z = (b - a) / sum;
    let x = z * z;
    if x <= CLOSE && sum > 0.0 {
        -(1.0 / b + 2.0 * z * arc_remainder(-x) / sum) / sum
    } else {
        // Over b at last: 1/b alone may overflow.
        limit(a, b, -1.0).unwrap_or_else(|| (1.0 - b * ln_dd(a, b)) / (b - a) / b)
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
    let is_zero = a == 0.0 || b == 0.0;
    let is_infinite = a.is_infinite() || b.is_infinite();
    if is_zero && is_infinite {
        Some(f64::NAN)
    } else if is_zero {
        Some(sign * f64::INFINITY)
    } else if is_infinite {
        Some(0.0)
    } else {
        None
    }
}
