//! sin(u)/u, sinh(u)/u and their derivatives.
//!
//! Power series near 0, the definition elsewhere. The leading term ±u/3 of a derivative's
//! series has an error of its own, 1/3 as a double, which is added to the rest. Only sinc′
//! needs more: its terms cancel around its zeros tan u = u, where it is evaluated from the
//! distance to the zero, and the terms of its series are large from u = 1 on.

use std::f64::consts::FRAC_PI_2;

use super::double::{Double, FRAC_PI_2_LOW};
use super::extended::Extended;
use super::series::power_series;

/// u² up to which a few terms of the series do: consecutive steps of an integration.
const HOT: f64 = 1.0 / 16.0;

/// What π/2 as two doubles lacks: the next 53 bits.
const FRAC_PI_2_LOWEST: f64 = -1.497_384_904_859_169_8e-33;

/// 2⁵⁶: no double beyond it is within 10/u of a zero of cos u. (Those that are would be m·2ᵉ
/// with |m 2ᵉ·2/π − n| < 1/(2m), and n/m a convergent of 2ᵉ⁺¹/π: all of them were examined.)
const NO_ZERO: f64 = (1_u64 << 56) as f64;

/// Up to this part of the greater term, the other one may be subtracted from it.
const REMAINING: f64 = 0.9;

/// 1/3 as a double, and what it lacks.
const THIRD: f64 = 1.0 / 3.0;
const THIRD_LOW: f64 = THIRD / 18014398509481984.0;

/// e¹⁶, and what it lacks as a double.
const EXP_16: f64 = 8886110.520507872;
const EXP_16_LOW: f64 = 5.321182483501564e-10;

/// Beyond this |u|, sinh(u)/u and its derivative are no longer representable.
const OVERFLOW: f64 = 720.0;

/// signᵏ⁺¹/(2k+3)!, the series of (sin(u)/u − 1)/u² (sign −1) and (sinh(u)/u − 1)/u² in u².
const fn remainder_coefficients<const N: usize>(sign: f64) -> [f64; N] {
    let mut coefficients = [0.0; N];
    let mut factor = sign;
    let mut factorial = 6.0;
    let mut k = 0;
    while k < N {
        coefficients[k] = factor / factorial;
        factor *= sign;
        factorial *= ((2 * k + 4) * (2 * k + 5)) as f64;
        k += 1;
    }
    coefficients
}

/// signᵏ⁺¹(2k+4)/(2k+5)!: the series of −sinc′ (sign −1) and sinhc′ over u, without its leading
/// term 1/3, over u².
const fn prime_coefficients<const N: usize>(sign: f64) -> [f64; N] {
    let mut coefficients = [0.0; N];
    let mut factor = sign;
    let mut factorial = 120.0;
    let mut k = 0;
    while k < N {
        coefficients[k] = factor * (2 * k + 4) as f64 / factorial;
        factor *= sign;
        factorial *= ((2 * k + 6) * (2 * k + 7)) as f64;
        k += 1;
    }
    coefficients
}

// For u² ≤ HOT; the first terms left out are below 2⁻⁵⁶ of the sum.
const SINC: [f64; 5] = remainder_coefficients(-1.0);
const SINC_PRIME: [f64; 5] = prime_coefficients(-1.0);
const SINHC: [f64; 5] = remainder_coefficients(1.0);
const SINHC_PRIME: [f64; 5] = prime_coefficients(1.0);
// For |u| ≤ 1; the same.
const SINC_PRIME_WIDE: [f64; 8] = prime_coefficients(-1.0);
const SINHC_WIDE: [f64; 8] = remainder_coefficients(1.0);
const SINHC_PRIME_WIDE: [f64; 8] = prime_coefficients(1.0);

/// Those of sinc′ for |u| ≤ 2.5, from the coefficient of u⁵ on.
const SINC_PRIME_FROM_SECOND: [f64; 13] = {
    let all: [f64; 14] = prime_coefficients(-1.0);
    let mut rest = [0.0; 13];
    let mut k = 0;
    while k < rest.len() {
        rest[k] = all[k + 1];
        k += 1;
    }
    rest
};

/// u/3 + u·rest, rounded once but for the error of the rest.
#[inline]
fn third_and(u: f64, rest: f64) -> f64 {
    u * THIRD + u * (rest + THIRD_LOW)
}

/// The cardinal sine.
///
/// Equation: sinc u = sin(u)/u = 1 − u²/3! + u⁴/5! − …; 1 at 0.
///
/// Domain: all reals; 0 at ±∞.
///
/// Accuracy: 2 ulp. Even to the last bit.
///
/// Source: Abramowitz & Stegun (1964), 4.3.65.
///
/// ```
/// use dmm_runtime::special::sinc;
/// assert_eq!(sinc(0.0), 1.0);
/// assert_eq!(sinc(1e-9), 1.0);
/// ```
#[inline]
pub fn sinc(u: f64) -> f64 {
    let x = u * u;
    if x <= HOT {
        1.0 + x * power_series(x, &SINC)
    } else if u.is_infinite() {
        0.0
    } else {
        u.sin() / u
    }
}

/// The derivative of the cardinal sine.
///
/// Equation: sinc′ u = (cos u − sin(u)/u)/u = −u/3 + u³/30 − …; 0 at 0. It is −j₁(u), a
/// spherical Bessel function.
///
/// Domain: all reals; 0 at ±∞.
///
/// Accuracy: 2 ulp, next to its zeros too. Odd to the last bit.
///
/// Source: series by Abramowitz & Stegun (1964), 4.3.65; around the zeros
/// u cos u − sin u = √(1 + u²) cos(u + atan(1/u)).
#[inline]
pub fn sinc_prime(u: f64) -> f64 {
    let x = u * u;
    if x <= HOT {
        -third_and(u, x * power_series(x, &SINC_PRIME))
    } else {
        sinc_prime_wide(u, x)
    }
}

fn sinc_prime_wide(u: f64, x: f64) -> f64 {
    if x <= 1.0 {
        return -third_and(u, x * power_series(x, &SINC_PRIME_WIDE));
    }
    if u.abs() <= 2.5 {
        return sinc_prime_alternating(u, x);
    }
    if u.is_infinite() {
        return 0.0;
    }
    let (sin, cos) = u.sin_cos();
    let secant = sin / u;
    let slope = Double::sum(cos, -secant);
    if slope.high.abs() >= REMAINING * cos.abs().max(secant.abs()) || u.abs() >= NO_ZERO {
        // What the rounding of sin(u)/u took away.
        let lost = (-secant).mul_add(u, sin) / u;
        Double::new(slope.high, slope.low - lost).quotient(Double::from(u))
    } else {
        sinc_prime_near_zero(u, sin)
    }
}

/// The series −u/3·(1 − x/10 + x²/280 − …), x = u² ≤ 6.25, of which x/10 has more digits than
/// a double.
fn sinc_prime_alternating(u: f64, x: f64) -> f64 {
    const TENTH: Double = Double::new(0.1, -5.551_115_123_125_783e-18);
    let rest = 3.0 * (x * x) * power_series(x, &SINC_PRIME_FROM_SECOND);
    let leading = Double::from(1.0) - Double::product(u, u) * TENTH;
    let sum = leading + Double::from(rest);
    -(Double::from(u) * sum).quotient(Double::from(3.0))
}

/// sinc′ u where u + atan(1/u) is near an odd multiple (2k+1)π/2, |u| > 2.5: the two differ by
/// δ, and sinc′ u = √(1 + u²) (−1)ᵏ sin δ/u² for u > 0, (−1)ᵏ the sign of sin u.
#[cold]
fn sinc_prime_near_zero(u: f64, sin: f64) -> f64 {
    let size = u.abs();
    let multiple = 2.0 * (size / (2.0 * FRAC_PI_2) - 0.5).round() + 1.0;
    let mut beside = multiples_less(Double::from(size), multiple);
    // Beyond 2⁵³ the multiple was rounded to an even one that is not the nearest.
    if multiple % 2.0 == 0.0 {
        let odd = 2.0 * (beside.high / (2.0 * FRAC_PI_2) - 0.5).round() + 1.0;
        beside = multiples_less(beside, odd);
    }
    let w = Double::from(1.0) / Double::from(size);
    let delta = -beside - w.atan();
    // sin δ/u, and √(1 + 1/u²)
    let (sin_delta, cos_delta) = delta.high.sin_cos();
    let root = (Double::from(1.0) + w * w).sqrt();
    let value = Double::new(sin_delta, cos_delta * delta.low) * root;
    value.quotient(Double::from(size)) * sin.signum()
}

/// u − n·π/2 for an integer n
fn multiples_less(u: Double, n: f64) -> Double {
    let high = u - Double::product(n, FRAC_PI_2);
    high - Double::product(n, FRAC_PI_2_LOW) - Double::from(n * FRAC_PI_2_LOWEST)
}

/// The cardinal hyperbolic sine.
///
/// Equation: sinhc u = sinh(u)/u = 1 + u²/3! + u⁴/5! + …; 1 at 0.
///
/// Domain: all reals; ∞ at ±∞, and from |u| = 717.2 on, where the value overflows.
///
/// Accuracy: 2 ulp. Even to the last bit.
///
/// Source: Abramowitz & Stegun (1964), 4.5.1 and 4.5.62.
///
/// ```
/// use dmm_runtime::special::sinhc;
/// assert_eq!(sinhc(0.0), 1.0);
/// assert!((sinhc(1.0) - 1.0_f64.sinh()).abs() < 1e-15);
/// ```
#[inline]
pub fn sinhc(u: f64) -> f64 {
    let x = u * u;
    if x <= HOT {
        1.0 + x * power_series(x, &SINHC)
    } else {
        sinhc_wide(u, x)
    }
}

fn sinhc_wide(u: f64, x: f64) -> f64 {
    let u = u.abs();
    if x <= 1.0 {
        1.0 + x * power_series(x, &SINHC_WIDE)
    } else if u < 700.0 {
        let e = u.exp();
        Double::sum(e, -1.0 / e).quotient(Double::from(2.0 * u))
    } else if u > OVERFLOW {
        f64::INFINITY
    } else {
        // eᵘ overflows before eᵘ/2u does.
        let divisor = Double::from(2.0 * u);
        let factor = Double::new(EXP_16, EXP_16_LOW) / divisor;
        scaled_by_exp(factor, u - 16.0)
    }
}

/// The derivative of the cardinal hyperbolic sine.
///
/// Equation: sinhc′ u = (u cosh u − sinh u)/u² = (eᵘ(u − 1) + e⁻ᵘ(u + 1))/(2u²)
/// = u/3 + u³/30 + …; 0 at 0.
///
/// Domain: all reals; ±∞ at ±∞, and from |u| = 717.2 on, where the value overflows.
///
/// Accuracy: 2 ulp. Odd to the last bit.
///
/// Source: Abramowitz & Stegun (1964), 4.5.1, 4.5.2 and 4.5.62.
#[inline]
pub fn sinhc_prime(u: f64) -> f64 {
    let x = u * u;
    if x <= HOT {
        third_and(u, x * power_series(x, &SINHC_PRIME))
    } else {
        sinhc_prime_wide(u, x)
    }
}

fn sinhc_prime_wide(u: f64, x: f64) -> f64 {
    let size = u.abs();
    let value = if x <= 1.0 {
        third_and(size, x * power_series(x, &SINHC_PRIME_WIDE))
    } else if size < 700.0 {
        let e = size.exp();
        let reciprocal = 1.0 / e;
        let inverse = Double::new(reciprocal, (-reciprocal).mul_add(e, 1.0) * reciprocal);
        let falling = Double::sum(size, 1.0) * inverse;
        let rising = Double::product(e, size - 1.0);
        (rising + falling).quotient(Double::product(2.0 * size, size))
    } else if size > OVERFLOW {
        f64::INFINITY
    } else {
        let factor = Double::new(EXP_16, EXP_16_LOW) * Double::from(size - 1.0);
        scaled_by_exp(factor / Double::product(2.0 * size, size), size - 16.0)
    };
    value.copysign(u)
}

/// factor·eᵘ, whose last operation alone may overflow
fn scaled_by_exp(factor: Double, u: f64) -> f64 {
    let e = u.exp();
    e.mul_add(factor.high, e * factor.low)
}
