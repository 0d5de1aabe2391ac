//! Derivatives of divided differences of odd power series, for small arguments.
//!
//! Of h(u) = u + c₁u³ + c₂u⁵ + …, with Sₙ = (bⁿ − aⁿ)/(b − a) and Dₙ = ∂Sₙ/∂b,
//! ∂/∂b (h(b) − h(a))/(b − a) = Σ cₖ D₂ₖ₊₁, where Sₙ₊₁ = aⁿ + b Sₙ and Dₙ₊₁ = Sₙ + b Dₙ. The
//! leading term c₁(a + 2b) is exact, so that the rest is as accurate as it should be where that
//! one vanishes.

use super::double::Double;
use super::extended::{Extended, Quotient};

/// Arguments up to which the series is used.
pub(super) const SMALL: f64 = 1.0 / 256.0;

/// Arguments whose cubes are normal numbers, with digits to spare.
pub(super) const SMALLEST_CUBE: f64 = 1e-85;

/// The leading term may be this much smaller than the arguments if the rest is to be summed in
/// plain doubles.
const NOT_SMALL: f64 = 1.0 / 8.0;

/// The sum in plain doubles, from c₁ as a quotient of doubles' digits (rounded, and what that
/// lacks) and c₂, c₃, c₄; nothing where the leading term cancels.
#[inline]
pub(super) fn plain_odd_series_prime(
    a: f64,
    b: f64,
    first: Double,
    others: [f64; 3],
) -> Option<f64> {
    let size = a.abs().max(b.abs());
    let ends = Double::sum(a, 2.0 * b);
    if size > SMALL || ends.high.abs() < NOT_SMALL * size {
        return None;
    }
    let mut rest = 0.0;
    let mut power = a * a;
    let mut slope = ends.high;
    let mut secant = power + b * (a + b);
    for factor in others {
        for _ in 0..2 {
            slope = secant + b * slope;
            power *= a;
            secant = power + b * secant;
        }
        rest += factor * slope;
    }
    let lost = ends.low * first.high + ends.high * first.low;
    Some(ends.high * first.high + (rest + lost))
}

/// The sum with more digits, for arguments whose cubes do not underflow. `coefficient` gives cₖ
/// from k and cₖ₋₁.
pub(super) fn odd_series_prime<T: Extended>(
    a: f64,
    b: f64,
    coefficient: impl Fn(f64, T) -> T,
) -> Quotient<T> {
    let (a, b) = (T::from(a), T::from(b));
    let one = T::from(1.0);
    let mut factor = coefficient(1.0, one);
    let leading = factor * (a + b + b);
    let mut rest = T::from(0.0);
    let mut power = a * a;
    let mut slope = a + b + b;
    let mut secant = power + b * (a + b);
    for k in 2..=T::TERMS {
        for _ in 0..2 {
            slope = secant + b * slope;
            power = power * a;
            secant = power + b * secant;
        }
        factor = coefficient(k as f64, factor);
        rest = rest + factor * slope;
    }
    Quotient::new(leading, rest, one)
}
