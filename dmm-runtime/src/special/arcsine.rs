//! The divided difference of the arc sine.
//!
//! With the angles α = asin a and β = asin b, sin β − sin α = 2 cos((α+β)/2) sin((β−α)/2) and
//! cos α + cos β = 2 cos((α+β)/2) cos((β−α)/2), so that tan((β−α)/2) = w = (b − a)/(p + q)
//! with p = cos α = √(1 − a²) and q = cos β = √(1 − b²). No term of it cancels anywhere.

use super::arc::{CLOSE, arc_remainder};
use super::double::Double;

/// The divided difference of the arc sine.
///
/// Equation: (asin b − asin a)/(b − a) = 2 atan(w)/(b − a), w = (b − a)/(√(1−a²) + √(1−b²));
/// 1/√(1 − a²) at b = a.
///
/// Domain: −1 ≤ a, b ≤ 1, NaN outside; ∞ at a = b = ±1.
///
/// Accuracy: 2 ulp. Symmetric in a and b to the last bit.
///
/// Source: the half-angle formula of the module head; series of atan by Abramowitz & Stegun
/// (1964), 4.4.42.
///
/// ```
/// use dmm_runtime::special::asin_dd;
/// assert_eq!(asin_dd(0.0, 0.0), 1.0);
/// assert!((asin_dd(-1.0, 1.0) - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// ```
#[inline]
pub fn asin_dd(a: f64, b: f64) -> f64 {
    let Double {
        high: sum,
        low: error,
    } = Double::sum(cos_asin(a), cos_asin(b));
    let difference = (b - a).abs();
    let w = difference / sum;
    let x = w * w;
    if x <= CLOSE {
        let reciprocal = 2.0 / sum;
        // The last term is what the rounding of the sum took away.
        reciprocal - reciprocal * (x * arc_remainder(x) + 0.5 * reciprocal * error)
    } else if difference == 0.0 {
        2.0 / sum
    } else {
        2.0 * difference.atan2(sum) / difference
    }
}

/// The derivative of [`asin_dd`] with respect to its second argument.
///
/// Equation: ∂/∂b (asin b − asin a)/(b − a) = ((a + b)/q + 2 w C(w²))/(p + q)², with p, q, w
/// as above and C(w²) = (1 − atan(w)/w)/w²; a/(2(1 − a²)^{3/2}) at b = a.
///
/// Domain: −1 ≤ a ≤ 1, −1 < b < 1; ±∞ at b = ±1; NaN outside.
///
/// Accuracy: 4 ulp; within 2⁻⁴⁸ of the curve b ≈ −a/2 on which it vanishes, that much of its
/// terms.
///
/// Source: derivative of the formula of [`asin_dd`], with p − q = (b² − a²)/(p + q).
#[inline]
pub fn asin_dd_prime(a: f64, b: f64) -> f64 {
    let (p_square, q_square) = (cos_asin_square(a), cos_asin_square(b));
    let q = q_square.sqrt();
    let w = (b - a) / (p_square.sqrt() + q);
    let x = w * w;
    let chord = (a + b) / q;
    let arc = 2.0 * w * arc_remainder(x);
    let terms = chord + arc;
    if x <= CLOSE && terms.abs() >= 0.9 * chord.abs().max(arc.abs()) {
        // (p + q)², free of the rounding errors of both roots.
        terms / ((p_square + q_square) + 2.0 * (p_square * q_square).sqrt())
    } else {
        asin_dd_prime_far(a, b)
    }
}

/// Where the angle is large, where the terms cancel, at the limits, and outside the domain.
#[cold]
fn asin_dd_prime_far(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if !(a.abs() <= 1.0 && b.abs() <= 1.0) {
        f64::NAN
    } else if b.abs() == 1.0 {
        b * f64::INFINITY
    } else if size < 1e-100 {
        // asin u = u + u³/6, to all digits.
        (a + 2.0 * b) / 6.0
    } else {
        let cosine = |u: f64| (Double::from(1.0) - Double::product(u, u)).sqrt();
        let (a, b, p, q) = (Double::from(a), Double::from(b), cosine(a), cosine(b));
        let w = (b - a) / (p + q);
        let arc = Double::from(2.0) * w * (w * w).arc_remainder();
        (((a + b) / q + arc) / ((p + q) * (p + q))).high
    }
}

/// cos(asin u) = √(1 − u²)
#[inline]
fn cos_asin(u: f64) -> f64 {
    cos_asin_square(u).sqrt()
}

/// 1 − u²
#[inline]
fn cos_asin_square(u: f64) -> f64 {
    let u = u.abs();
    // Whichever of u and 1 − u is small is squared; 1 − u is then exact.
    let rest = 1.0 - u;
    if u < 0.5 {
        1.0 - u * u
    } else {
        2.0 * rest - rest * rest
    }
}
