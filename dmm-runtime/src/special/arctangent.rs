//! The divided difference of the arc tangent.
//!
//! The angle between the directions (1, a) and (1, b) is θ = atan b − atan a, with
//! tan θ = w = (b − a)/(1 + ab). Close to each other, θ/(b − a) = A(w²)/(1 + ab); otherwise θ
//! is taken from both coordinates of the angle, |b − a| and 1 + ab. There 1 + ab may cancel,
//! but only where |b − a| ≥ 2 and θ is near π/2, and it is θ that must be accurate.

use std::f64::consts::{FRAC_PI_2, PI};

use super::arc::{CLOSE, arc_remainder};
use super::double::Double;

/// Arguments beyond which their squares may overflow.
const HUGE: f64 = 1e140;

/// What π/2 as a double lacks.
const FRAC_PI_2_LOW: f64 = 6.123_233_995_736_766e-17;

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
    let Double {
        high: cosine,
        low: error,
    } = Double::sum(1.0, a * b);
    let w = (b - a) / cosine;
    let x = w * w;
    if x <= CLOSE && cosine > 0.0 && cosine < HUGE * HUGE {
        let reciprocal = 1.0 / cosine;
        // The last term is what the rounding of the sum took away.
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
        let cosine = Double::sum(1.0, a * b);
        let angle = sine.high.atan2(cosine.high);
        // What the rounding of both coordinates took from the angle.
        let turn = sine.low * cosine.high - cosine.low * sine.high;
        let square = sine.high * sine.high + cosine.high * cosine.high;
        Double::new(angle, turn / square).quotient(sine)
    } else {
        // Both coordinates of the angle over `size`, so that neither overflows.
        let ratio = if a.abs() < b.abs() { a / b } else { b / a };
        let sine = 1.0 - ratio;
        let cosine = 1.0 / size + ratio * size;
        if sine <= 1e-9 * cosine {
            1.0 / cosine / size
        } else {
            sine.atan2(cosine) / sine / size
        }
    }
}

/// The derivative of [`atan_dd`] with respect to its second argument.
///
/// Equation: ∂/∂b (atan b − atan a)/(b − a) = (w C(w²)/(1 + ab) − b/(1 + b²))/(1 + ab), with w
/// as above and C(w²) = (1 − atan(w)/w)/w², or (1/(1 + b²) − θ/(b − a))/(b − a) where the
/// angle θ is large; −a/(1 + a²)² at b = a.
///
/// Domain: all reals; 0 where a or b is infinite.
///
/// Accuracy: 4 ulp; within 2⁻⁴⁸ of the curve on which it vanishes (b ≈ −a/2 for small a), that
/// much of its terms.
///
/// Source: derivative of the formula of [`atan_dd`], with 1 + b² = (1 + ab)(1 + bw).
#[inline]
pub fn atan_dd_prime(a: f64, b: f64) -> f64 {
    let Double {
        high: cosine,
        low: error,
    } = Double::sum(1.0, a * b);
    let w = (b - a) / cosine;
    let x = w * w;
    if x <= CLOSE && cosine > 0.0 && cosine < HUGE * HUGE {
        let reciprocal = 1.0 / cosine;
        let bend = if b.abs() <= 1.0 {
            b / (1.0 + b * b)
        } else {
            1.0 / (b + 1.0 / b)
        };
        let arc = w * arc_remainder(x) * reciprocal;
        if (arc - bend).abs() >= 0.9 * arc.abs().max(bend.abs()) {
            // What the rounding of 1 + ab adds to 3 arcs and 1 bend.
            let rounding = reciprocal * error * (3.0 * arc - bend);
            return reciprocal * (arc - (bend + rounding));
        }
    }
    atan_dd_prime_far(a, b)
}

/// Where the angle is large or the terms cancel.
fn atan_dd_prime_far(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if a.is_nan() || b.is_nan() {
        return f64::NAN;
    }
    if size.is_infinite() {
        return 0.0;
    }
    if size < 1e-100 {
        // atan u = u − u³/3, to all digits.
        return (a + 2.0 * b) / -3.0;
    }
    let (difference, cosine) = (b - a, 1.0 + a * b);
    if difference == 0.0 {
        // −a/(1 + a²)² of an argument beyond HUGE.
        return 0.0;
    }
    let slope = 1.0 / (1.0 + b * b);
    let chord = difference.abs().atan2(cosine) / difference.abs();
    let is_apart = cosine <= difference.abs();
    if is_apart && (slope - chord).abs() >= 0.9 * slope.max(chord) || size > HUGE {
        (slope - chord) / difference
    } else {
        atan_dd_prime_cancelling(Double::from(a), Double::from(b))
    }
}

/// The same two formulas in pairs of doubles.
#[cold]
fn atan_dd_prime_cancelling(a: Double, b: Double) -> f64 {
    let one = Double::from(1.0);
    let cosine = one + a * b;
    let square = one + b * b;
    let difference = b - a;
    let (c, d) = (cosine.high, difference.high.abs());
    if c >= d {
        let w = difference / cosine;
        let arc = w * (w * w).arc_remainder() / cosine;
        return ((arc - b / square) / cosine).high;
    }
    // |θ| from the cotangent or from the tangent, whichever is at most 1.
    let sine = if difference.high < 0.0 {
        -difference
    } else {
        difference
    };
    let arc = |w: Double| {
        let x = w * w;
        w - w * x * x.arc_remainder()
    };
    let angle = if c > -d {
        Double::new(FRAC_PI_2, FRAC_PI_2_LOW) - arc(cosine / sine)
    } else {
        Double::new(PI, 2.0 * FRAC_PI_2_LOW) + arc(sine / cosine)
    };
    ((one / square - angle / sine) / difference).high
}
