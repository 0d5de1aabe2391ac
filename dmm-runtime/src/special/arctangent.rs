//! The divided difference of the arc tangent.
//!
//! The angle between the directions (1, a) and (1, b) is θ = atan b − atan a, with
//! tan θ = w = (b − a)/(1 + ab). Close to each other, θ/(b − a) = A(w²)/(1 + ab); otherwise θ
//! is taken from both coordinates of the angle, |b − a| and 1 + ab. There 1 + ab may cancel,
//! but only where |b − a| ≥ 2 and θ is near π/2, and it is θ that must be accurate.

use super::arc::{CLOSE, HOT, arc_remainder};
use super::double::Double;
use super::extended::{Extended, Quotient};
use super::long::Long;
use super::odd::{SMALL, SMALLEST_CUBE, odd_series_prime, plain_odd_series_prime};
use crate::time::two_product;

/// Arguments beyond which their squares may overflow.
const HUGE: f64 = 1e140;

/// 1 + ab and 1 + b² up to which their product and its error are normal numbers.
const LARGE: f64 = 1e140;

/// Up to this part of the leading term, the other one need not have all its digits.
const MINOR: f64 = 1.0 / 32.0;

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
/// as above and C(w²) = (1 − atan(w)/w)/w², or ((b − a)/(1 + b²) − θ)/(b − a)² where the
/// angle θ is large; −a/(1 + a²)² at b = a.
///
/// Domain: all reals; 0 where a or b is infinite.
///
/// Accuracy: 2 ulp, also next to the curve on which it vanishes (b ≈ −a/2 for small a,
/// b² ≈ |a|/π for large).
///
/// Source: derivative of the formula of [`atan_dd`], with 1 + b² = (1 + ab)(1 + bw).
#[inline]
pub fn atan_dd_prime(a: f64, b: f64) -> f64 {
    let cosine = Double::sum(1.0, a * b);
    let square = Double::sum(1.0, b * b);
    let w = (b - a) / cosine.high;
    let x = w * w;
    // wC/(1 + ab), to be compared with b/(1 + b²)
    let arc = w * arc_remainder(x);
    let is_minor = (arc * square.high).abs() <= MINOR * (b * cosine.high).abs();
    let is_moderate = cosine.high > 0.0 && cosine.high.max(square.high) < LARGE;
    if x <= HOT && is_minor && is_moderate {
        let (divisor, divisor_error) = two_product(cosine.high, square.high);
        let leading = b / divisor;
        let inverse = 1.0 / divisor;
        // What rounding took from the divisor, as a part of it.
        let lost = inverse
            * (divisor_error
                + (cosine.low + two_product(a, b).1) * square.high
                + (square.low + two_product(b, b).1) * cosine.high);
        // 1/(1 + ab) is (1 + b²)/divisor
        let reciprocal = square.high * inverse;
        (arc * reciprocal * reciprocal + leading * lost) - leading
    } else {
        atan_dd_prime_far(a, b)
    }
}

/// Where the angle is large or the terms cancel.
#[cold]
fn atan_dd_prime_far(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else if size.is_infinite() || size > HUGE && a == b {
        // The second is −a/(1 + a²)², far below the least number.
        0.0
    } else if size < SMALLEST_CUBE {
        // atan u = u − u³/3 + u⁵/5; the last term counts at b = −a/2 alone.
        let leading = a + 2.0 * b;
        if leading == 0.0 {
            1.0 / 20.0 * a * a * a
        } else {
            leading / -3.0
        }
    } else {
        // −1/3 as a double, and what it lacks; the others are ±1/(2k + 1).
        let third = Double::new(-1.0 / 3.0, -1.0 / 3.0 / (1_u64 << 54) as f64);
        plain_odd_series_prime(a, b, third, [1.0 / 5.0, -1.0 / 7.0, 1.0 / 9.0])
            .or_else(|| prime::<Double>(a, b))
            .or_else(|| prime::<Long>(a, b))
            .unwrap_or(f64::NAN)
    }
}

/// The derivative, unless too many digits are cancelled.
fn prime<T: Extended>(a: f64, b: f64) -> Option<f64> {
    let size = a.abs().max(b.abs());
    if size <= SMALL {
        let series = odd_series_prime::<T>(a, b, |k, previous| {
            let odd = T::from(2.0 * k + 1.0);
            // cₖ₋₁ is ±1/(2k − 1) itself.
            T::from(0.0) - previous * T::from(2.0 * k - 1.0) / odd
        });
        return series.certain();
    }
    if size > HUGE || 1.0 + a * b < (b - a).abs() {
        return prime_apart::<T>(a, b);
    }
    let (a, b) = (T::from(a), T::from(b));
    let one = T::from(1.0);
    let cosine = one + a * b;
    let w = (b - a) / cosine;
    let arc = w * (w * w).arc_remainder() / cosine;
    let slope = T::from(0.0) - b / (one + b * b);
    Quotient::new(arc, slope, cosine).certain()
}

/// The derivative from the angle θ.
fn prime_apart<T: Extended>(a: f64, b: f64) -> Option<f64> {
    /// |b| from which 1 does not count beside b².
    const ALONE: f64 = 1e100;
    // Half of |b − a| does not overflow.
    let half = (T::from(0.5 * b) - T::from(0.5 * a)) * T::from(if a > b { -1.0 } else { 1.0 });
    let denominator = T::from(b);
    let slope = if b.abs() > ALONE {
        half / denominator / denominator
    } else {
        half / (T::from(1.0) + denominator * denominator)
    };
    let angle = angle::<T>(a, b, half) * T::from(0.5);
    let two = T::from(if a > b { -2.0 } else { 2.0 });
    let quotient = Quotient::new(slope, T::from(0.0) - angle, half);
    quotient.certain()?;
    Some((quotient.value / half / two).high())
}

/// |θ| from the cotangent or from the tangent, whichever is at most 1.
fn angle<T: Extended>(a: f64, b: f64, half: T) -> T {
    // Half of 1 + ab may overflow: both are taken over the greater argument.
    let (smaller, larger) = if a.abs() < b.abs() { (a, b) } else { (b, a) };
    let scale = T::from(larger.abs());
    let cosine = T::from(0.5) / scale + T::from(0.5 * smaller) * T::from(larger.signum());
    let sine = half / scale;
    let (c, s) = (cosine.high(), sine.high());
    if c.abs() <= s {
        T::FRAC_PI_2 - (cosine / sine).atan()
    } else if c < 0.0 {
        T::FRAC_PI_2 + T::FRAC_PI_2 + (sine / cosine).atan()
    } else {
        (sine / cosine).atan()
    }
}
