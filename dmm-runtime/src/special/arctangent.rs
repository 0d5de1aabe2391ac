//! The divided difference of the arc tangent.
//!
//! The angle between the directions (1, a) and (1, b) is θ = atan b − atan a, with
//! tan θ = w = (b − a)/(1 + ab). Close to each other, θ/(b − a) = A(w²)/(1 + ab); otherwise θ
//! is taken from both coordinates of the angle, |b − a| and 1 + ab. There 1 + ab may cancel,
//! but only where |b − a| ≥ 2 and θ is near π/2, and it is θ that must be accurate.

use super::arc::{CLOSE, arc_remainder};
use crate::arithmetic::double::Double;
use crate::arithmetic::error_free::two_product;

/// Arguments beyond which their squares may overflow.
const HUGE: f64 = 1e140;

/// The divided difference of the arc tangent.
///
/// Equation: (atan b − atan a)/(b − a) = atan(w)/(b − a) (mod π), w = (b − a)/(1 + ab);
/// 1/(1 + a²) at b = a.
///
/// Domain: all reals; 0 where a or b is infinite.
///
/// Accuracy: 2 ulp. Symmetric in a and b to the last bit.
///
/// Source: addition theorem, Abramowitz & Stegun (1964), 4.4.34; series 4.4.42.
///
/// ```
/// use dmm_runtime::special::atan_dd;
/// assert_eq!(atan_dd(1.0, 1.0), 0.5);
/// assert!((atan_dd(-1.0, 1.0) - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
/// ```
#[inline]
pub fn atan_dd(a: f64, b: f64) -> f64 {
    let product = a * b;
    let cosine = Double::sum(1.0, product);
    let w = (b - a) / cosine.high;
    let x = w * w;
    if x <= CLOSE && cosine.high > 0.0 && cosine.high < HUGE * HUGE {
        let reciprocal = 1.0 / cosine.high;
        // What the rounding of the product and of the sum took away.
        let error = cosine.low + two_product(a, b).1;
        reciprocal - reciprocal * (x * arc_remainder(x) + reciprocal * error)
    } else {
        atan_dd_far(a, b)
    }
}

fn atan_dd_far(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else if size.is_infinite() {
        0.0
    } else if size < HUGE {
        let sine = Double::sum(a.max(b), -a.min(b));
        let cosine = Double::from(1.0) + Double::product(a, b);
        Double::angle(cosine, sine).quotient(sine)
    } else {
        // Both coordinates of the angle over `size`, so that neither overflows.
        let (smaller, larger) = if a.abs() < b.abs() { (a, b) } else { (b, a) };
        let sine = Double::from(1.0) - Double::from(smaller) / Double::from(larger);
        let cosine = Double::sum(1.0 / size, smaller * larger.signum());
        if sine.high <= 1e-9 * cosine.high {
            1.0 / cosine.high / size
        } else {
            // A quarter of b − a does not overflow.
            let quarter = Double::sum(0.25 * a.max(b), -0.25 * a.min(b));
            0.25 * Double::angle(cosine, sine).quotient(quarter)
        }
    }
}

/// The derivative of [`atan_dd`] with respect to its second argument.
///
/// Equation: ∂/∂b (atan b − atan a)/(b − a) = (w C(w²)/(1 + ab) − b/(1 + b²))/(1 + ab), with w
/// as above and C(w²) = (1 − atan(w)/w)/w²; where |w| > 1, (1/(1 + b²) − h[a, b])/(b − a);
/// −a/(1 + a²)² at b = a.
///
/// Domain: all reals; 0 where a or b is infinite.
///
/// Accuracy: that of the [derivatives](super); it vanishes on a curve (b ≈ −a/2 for small a,
/// b² ≈ |a|/π for large).
///
/// Source: derivative of the formula of [`atan_dd`], with 1 + b² = (1 + ab)(1 + bw).
#[inline]
pub fn atan_dd_prime(a: f64, b: f64) -> f64 {
    let cosine = 1.0 + a * b;
    let difference = b - a;
    if difference.abs() <= cosine && a.abs().max(b.abs()) < HUGE {
        let w = difference / cosine;
        (w * arc_remainder(w * w) / cosine - b / (1.0 + b * b)) / cosine
    } else {
        atan_dd_prime_far(a, b)
    }
}

/// Where the angle is large, or the arguments are.
fn atan_dd_prime_far(a: f64, b: f64) -> f64 {
    let is_infinite = a.is_infinite() || b.is_infinite();
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else if is_infinite || a == b {
        // The second is −a/(1 + a²)² for |a| > HUGE, far below the least number.
        0.0
    } else {
        (1.0 / (1.0 + b * b) - atan_dd(a, b)) / (b - a)
    }
}
