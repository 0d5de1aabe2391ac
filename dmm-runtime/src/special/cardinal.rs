//! sin(u)/u, sinh(u)/u and their derivatives.
//!
//! Power series near 0, the definition elsewhere.

use super::series::power_series;
use crate::arithmetic::double::Double;

/// u² up to which a few terms of the series do: consecutive steps of an integration.
const HOT: f64 = 1.0 / 16.0;

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

/// signᵏ(2k+2)/(2k+3)!, the series of −sinc′ (sign −1) and sinhc′ over u, in u².
const fn prime_coefficients<const N: usize>(sign: f64) -> [f64; N] {
    let mut coefficients = remainder_coefficients(sign);
    let mut k = 0;
    while k < N {
        coefficients[k] *= sign * (2 * k + 2) as f64;
        k += 1;
    }
    coefficients
}

// For u² ≤ HOT; the first terms left out are below 2⁻⁵⁶ of the sum.
const SINC: [f64; 5] = remainder_coefficients(-1.0);
const SINC_PRIME: [f64; 6] = prime_coefficients(-1.0);
const SINHC: [f64; 5] = remainder_coefficients(1.0);
const SINHC_PRIME: [f64; 6] = prime_coefficients(1.0);
// For |u| ≤ 1; the same.
const SINC_PRIME_WIDE: [f64; 9] = prime_coefficients(-1.0);
const SINHC_WIDE: [f64; 8] = remainder_coefficients(1.0);
const SINHC_PRIME_WIDE: [f64; 9] = prime_coefficients(1.0);

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
/// Accuracy: that of the [derivatives](super). Odd to the last bit.
///
/// Source: series by Abramowitz & Stegun (1964), 4.3.65.
#[inline]
pub fn sinc_prime(u: f64) -> f64 {
    let x = u * u;
    if x <= HOT {
        -u * power_series(x, &SINC_PRIME)
    } else if x <= 1.0 {
        -u * power_series(x, &SINC_PRIME_WIDE)
    } else if u.is_infinite() {
        0.0
    } else {
        (u.cos() - u.sin() / u) / u
    }
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
/// Accuracy: that of the [derivatives](super). Odd to the last bit.
///
/// Source: Abramowitz & Stegun (1964), 4.5.1, 4.5.2 and 4.5.62.
#[inline]
pub fn sinhc_prime(u: f64) -> f64 {
    let x = u * u;
    if x <= HOT {
        u * power_series(x, &SINHC_PRIME)
    } else if x <= 1.0 {
        u * power_series(x, &SINHC_PRIME_WIDE)
    } else if u.abs() > OVERFLOW {
        u.signum() * f64::INFINITY
    } else {
        // eᵘ in two factors: it overflows before the quotient does.
        let size = u.abs();
        let e = (0.5 * size).exp();
        let bracket = (size - 1.0) + (size + 1.0) * (-2.0 * size).exp();
        (e * (bracket / (2.0 * x)) * e).copysign(u)
    }
}

/// factor·eᵘ, whose last operation alone may overflow
fn scaled_by_exp(factor: Double, u: f64) -> f64 {
    let e = u.exp();
    e.mul_add(factor.high, e * factor.low)
}
