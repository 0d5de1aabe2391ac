//! Constants: exact rationals, π and square roots before lowering, exact rationals in lowered
//! operations, the nearest double for a machine.

use num_bigint::{BigInt, Sign};
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::algebra::{Function, Id, Math, Rational};

/// π to 60 digits: far more than a double needs after any cancellation worth writing down.
const PI_DIGITS: &str = "3141592653589793238462643383279502884197169399375105820974944";
const PI_SCALE: u32 = 60;

/// Binary digits of a square root.
const ROOT_BITS: u64 = 200;

/// Powers of constants are folded up to this exponent.
const LARGEST_EXPONENT: u32 = 64;

/// Larger numerators and denominators are not folded.
const MOST_BITS: u64 = 1 << 14;

/// The value of `node` if it is made of rationals, π and square roots, to about 60 digits;
/// nothing if it has variables, other functions, or no value. `child` tells the values of its
/// children.
pub(super) fn fold(node: &Math, child: impl Fn(Id) -> Option<Rational>) -> Option<Rational> {
    let value = match node {
        Math::Constant(value) => return Some(value.clone()),
        Math::Pi => pi(),
        Math::Add([a, b]) => Some(child(*a)? + child(*b)?),
        Math::Sub([a, b]) => Some(child(*a)? - child(*b)?),
        Math::Mul([a, b]) => Some(child(*a)? * child(*b)?),
        Math::Neg(a) => Some(-child(*a)?),
        Math::Div([a, b]) => {
            let denominator = child(*b)?;
            (!denominator.is_zero()).then_some(())?;
            Some(child(*a)? / denominator)
        }
        Math::Pow([a, b]) => power(&child(*a)?, &child(*b)?),
        Math::Call(Function::Sqrt, a) => square_root(&child(*a)?),
        Math::Call(Function::Abs, a) => Some(child(*a)?.abs()),
        Math::Call(..) | Math::Pair(..) | Math::Variable(_) => None,
    };
    value.filter(|value| value.numer().bits() < MOST_BITS && value.denom().bits() < MOST_BITS)
}

fn pi() -> Option<Rational> {
    let digits: BigInt = PI_DIGITS.parse().ok()?;
    Some(Rational::new(digits, BigInt::from(10).pow(PI_SCALE)))
}

fn power(base: &Rational, exponent: &Rational) -> Option<Rational> {
    let exponent = exponent
        .is_integer()
        .then(|| exponent.to_integer().to_i64())??;
    let size = u32::try_from(exponent.unsigned_abs()).ok()?;
    if size > LARGEST_EXPONENT || (base.is_zero() && exponent < 0) {
        return None;
    }
    let power = num_traits::pow(base.clone(), size as usize);
    Some(if exponent < 0 { power.recip() } else { power })
}

fn square_root(value: &Rational) -> Option<Rational> {
    if value.is_negative() {
        return None;
    }
    if value.is_zero() {
        return Some(value.clone());
    }
    let (numerator, denominator) = (value.numer(), value.denom());
    // enough digits behind the point, whatever the magnitude: √(n/d) = √(n·d·4ˢ)/(d·2ˢ)
    let scale = ROOT_BITS + denominator.bits();
    let root = ((numerator * denominator) << (2 * scale)).sqrt();
    Some(Rational::new(root, denominator << scale))
}

/// The double nearest to `value`, ties to even; infinite where it is too large.
pub fn nearest_double(value: &Rational) -> f64 {
    if value.is_zero() {
        return 0.0;
    }
    let magnitude = value.abs();
    let (numerator, denominator) = (magnitude.numer(), magnitude.denom());
    // a quotient of 63 or 64 bits, its last bit made odd if a remainder is left: rounding it
    // to 53 bits is rounding the rational
    let shift = 63 - (bits(numerator) - bits(denominator));
    let (numerator, denominator) = if shift >= 0 {
        (numerator << shift.unsigned_abs(), denominator.clone())
    } else {
        (numerator.clone(), denominator << shift.unsigned_abs())
    };
    let quotient = &numerator / &denominator;
    let remainder = numerator - &quotient * denominator;
    let sticky = u64::from(!remainder.is_zero());
    let rounded = (quotient.to_u64().unwrap_or(u64::MAX) | sticky) as f64;
    // in two halves, so that neither power of two overflows
    let (half, rest) = (-shift / 2, -shift - -shift / 2);
    let size = rounded * power_of_two(half) * power_of_two(rest);
    match value.numer().sign() {
        Sign::Minus => -size,
        _ => size,
    }
}

fn bits(value: &BigInt) -> i64 {
    i64::try_from(value.bits()).unwrap_or(i64::MAX / 4)
}

fn power_of_two(exponent: i64) -> f64 {
    2f64.powi(exponent.clamp(-2000, 2000) as i32)
}

/// Whether `value` is a double.
pub(super) fn is_double(value: &Rational) -> bool {
    let denominator = value.denom();
    let shift = denominator.trailing_zeros().unwrap_or(0);
    let odd = value.numer().abs();
    let odd = &odd >> odd.trailing_zeros().unwrap_or(0);
    (denominator >> shift).is_one()
        && shift < 1000
        && odd.bits() <= 53
        && value.numer().bits() < 1000
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(numerator: i64, denominator: i64) -> Rational {
        Rational::new(numerator.into(), denominator.into())
    }

    #[test]
    fn rounds_like_the_parser_of_doubles() {
        for (numerator, denominator, text) in [
            (1, 10, 0.1),
            (-1, 3, -1.0 / 3.0),
            (2, 3, 2.0 / 3.0),
            (9_007_199_254_740_993, 1, 9_007_199_254_740_992.0), // a tie: to even
            (i64::MAX, 7, i64::MAX as f64 / 7.0),
        ] {
            assert_eq!(nearest_double(&rational(numerator, denominator)), text);
        }
        let tiny = num_traits::pow(rational(1, 10), 300);
        assert_eq!(nearest_double(&tiny), 1e-300);
        assert_eq!(nearest_double(&tiny.recip()), 1e300);
        assert_eq!(
            nearest_double(&(tiny.recip() * tiny.recip())),
            f64::INFINITY
        );
    }

    #[test]
    fn folds_pi_and_square_roots() {
        let pi = fold(&Math::Pi, |_| None);
        let two = rational(2, 1);
        let circle = pi.map(|pi| nearest_double(&(pi * &two)));
        assert_eq!(circle, Some(std::f64::consts::TAU));
        let root = Math::Call(Function::Sqrt, Id::from(0));
        let root = fold(&root, |_| Some(two.clone())).map(|root| nearest_double(&root));
        assert_eq!(root, Some(std::f64::consts::SQRT_2));
    }

    #[test]
    fn knows_the_doubles() {
        assert!(is_double(&rational(3, 8)));
        assert!(!is_double(&rational(1, 10)));
        assert!(!is_double(&rational(9_007_199_254_740_993, 1)));
    }
}
