//! The divided difference of the arc sine.
//!
//! With the angles α = asin a and β = asin b, sin β − sin α = 2 cos((α+β)/2) sin((β−α)/2) and
//! cos α + cos β = 2 cos((α+β)/2) cos((β−α)/2), so that tan((β−α)/2) = w = (b − a)/(p + q)
//! with p = cos α = √(1 − a²) and q = cos β = √(1 − b²). No term of it cancels anywhere.

use super::arc::{CLOSE, HOT, arc_remainder};
use super::double::Double;
use super::extended::{Extended, Quotient};
use super::long::Long;
use super::odd::{SMALL, SMALLEST_CUBE, odd_series_prime, plain_odd_series_prime};
use crate::time::two_product;

/// Up to this part of the leading term, the other one need not have all its digits.
const MINOR: f64 = 1.0 / 32.0;

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
/// Accuracy: 2 ulp, also next to the curve b ≈ −a/2 on which it vanishes.
///
/// Source: derivative of the formula of [`asin_dd`], with p − q = (b² − a²)/(p + q).
#[inline]
pub fn asin_dd_prime(a: f64, b: f64) -> f64 {
    let (p, q) = (cos_asin(a), cos_asin(b));
    let sum = Double::sum(p.root, q.root);
    let w = (b - a) / sum.high;
    let x = w * w;
    let ends = Double::sum(a, b);
    // 2wC, to be compared with (a + b)/q
    let arc = 2.0 * w * arc_remainder(x);
    if x <= HOT && (arc * q.root).abs() <= MINOR * ends.high.abs() && q.root > 0.0 {
        let (square, square_error) = two_product(sum.high, sum.high);
        let (divisor, divisor_error) = two_product(q.root, square);
        let leading = ends.high / divisor;
        let inverse = 1.0 / divisor;
        // What rounding took from the divisor, as a part of it: 1/q is square/divisor, and
        // 1/(p + q)² is q/divisor.
        let lost = inverse
            * (divisor_error
                + square_error * q.root
                + 2.0 * (sum.low + lost_by_roots(&p, &q)) * sum.high * q.root
                + 0.5 * q.remainder * inverse * square * square);
        leading + (inverse * (arc * q.root + ends.low) - leading * lost)
    } else {
        asin_dd_prime_far(a, b)
    }
}

/// Where the angle is large, where the terms cancel, at the limits, and outside the domain.
#[cold]
fn asin_dd_prime_far(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if !(a.abs() <= 1.0 && b.abs() <= 1.0) {
        return f64::NAN;
    }
    if b.abs() == 1.0 {
        return b * f64::INFINITY;
    }
    if size < SMALLEST_CUBE {
        // asin u = u + u³/6 + 3u⁵/40; the last term counts at b = −a/2 alone.
        let leading = a + 2.0 * b;
        return if leading == 0.0 {
            3.0 / 160.0 * a * a * a
        } else {
            leading / 6.0
        };
    }
    // 1/6 as a double, and what it lacks; 3/40, 15/336, 105/3456.
    let sixth = Double::new(1.0 / 6.0, 1.0 / 6.0 / (1_u64 << 54) as f64);
    let others = [3.0 / 40.0, 15.0 / 336.0, 105.0 / 3456.0];
    if let Some(value) = plain_odd_series_prime(a, b, sixth, others) {
        return value;
    }
    prime::<Double>(a, b)
        .certain()
        .unwrap_or_else(|| prime::<Long>(a, b).value.high())
}

/// The derivative for |a| ≤ 1, |b| < 1.
fn prime<T: Extended>(a: f64, b: f64) -> Quotient<T> {
    if a.abs().max(b.abs()) <= SMALL {
        return odd_series_prime::<T>(a, b, |k, previous| {
            let odd = (2.0 * k - 1.0) * (2.0 * k - 1.0);
            previous * T::from(odd) / T::from(2.0 * k * (2.0 * k + 1.0))
        });
    }
    let (a, b) = (T::from(a), T::from(b));
    let one = T::from(1.0);
    let (p, q) = ((one - a * a).sqrt(), (one - b * b).sqrt());
    let sum = p + q;
    let w = (b - a) / sum;
    let arc = T::from(2.0) * w * (w * w).arc_remainder();
    Quotient::new((a + b) / q, arc, sum * sum)
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
