//! The divided difference of the arc sine.
//!
//! With the angles α = asin a and β = asin b, sin β − sin α = 2 cos((α+β)/2) sin((β−α)/2) and
//! cos α + cos β = 2 cos((α+β)/2) cos((β−α)/2), so that tan((β−α)/2) = w = (b − a)/(p + q)
//! with p = cos α = √(1 − a²) and q = cos β = √(1 − b²). No term of it cancels anywhere.

use super::arc::{CLOSE, arc_remainder};
use crate::arithmetic::double::Double;
use crate::arithmetic::error_free::two_product;

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
    let (p, q) = (cos_asin(a), cos_asin(b));
    let sum = Double::sum(p.root, q.root);
    // What the rounding of the roots and of their sum took away.
    let error = sum.low + lost_by_roots(&p, &q);
    let difference = (b - a).abs();
    let reciprocal = 2.0 / sum.high;
    let w = 0.5 * difference * reciprocal;
    let x = w * w;
    if x <= CLOSE {
        reciprocal - reciprocal * (x * arc_remainder(x) + 0.5 * reciprocal * error)
    } else {
        asin_dd_far(a, b, Double::new(sum.high, error))
    }
}

/// Where the angle is large, at a = b = ±1, and outside the domain; `cosine` is p + q.
fn asin_dd_far(a: f64, b: f64, cosine: Double) -> f64 {
    let sine = Double::sum(a.max(b), -a.min(b));
    if sine.high == 0.0 {
        return 2.0 / cosine.high;
    }
    2.0 * Double::angle(cosine, sine).quotient(sine)
}

/// The derivative of [`asin_dd`] with respect to its second argument.
///
/// Equation: ∂/∂b (asin b − asin a)/(b − a) = ((a + b)/q + 2 w C(w²))/(p + q)², with p, q, w
/// as above and C(w²) = (1 − atan(w)/w)/w²; a/(2(1 − a²)^{3/2}) at b = a.
///
/// Domain: −1 ≤ a ≤ 1, −1 < b < 1; ±∞ at b = ±1; NaN outside.
///
/// Accuracy: that of the [derivatives](super); it vanishes on a curve next to b = −a/2.
///
/// Source: derivative of the formula of [`asin_dd`], with p − q = (b² − a²)/(p + q).
#[inline]
pub fn asin_dd_prime(a: f64, b: f64) -> f64 {
    let p = ((1.0 - a) * (1.0 + a)).sqrt();
    let q = ((1.0 - b) * (1.0 + b)).sqrt();
    if q == 0.0 && p >= 0.0 {
        return b * f64::INFINITY;
    }
    let sum = p + q;
    let w = (b - a) / sum;
    ((a + b) / q + 2.0 * w * arc_remainder(w * w)) / (sum * sum)
}

/// cos(asin u) = √(1 − u²)
struct CosAsin {
    /// The root, rounded.
    root: f64,
    /// 1 − u² less the square of that.
    remainder: f64,
}

#[inline]
fn cos_asin(u: f64) -> CosAsin {
    let u = u.abs();
    // Whichever of u and 1 − u is small is squared; 1 − u is then exact.
    let rest = 1.0 - u;
    let (whole, part) = if u < 0.5 {
        (1.0, u * u)
    } else {
        (2.0 * rest, rest * rest)
    };
    let square = whole - part;
    let square_error = (whole - square) - part;
    let root = square.sqrt();
    let (back, back_error) = two_product(root, root);
    CosAsin {
        root,
        remainder: ((square - back) - back_error) + square_error,
    }
}

/// What the rounding of two roots took from their sum, Σ remainder/(2 root); the remainder of
/// the root 0 is 0.
#[inline]
fn lost_by_roots(p: &CosAsin, q: &CosAsin) -> f64 {
    let product = (p.root * q.root).max(f64::MIN_POSITIVE);
    0.5 * (p.remainder * q.root + q.remainder * p.root) / product
}
