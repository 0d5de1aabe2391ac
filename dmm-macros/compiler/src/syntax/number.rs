//! Literals as exact rationals: `0.1` is 1/10, not the double nearest to it.

use num_bigint::BigInt;
use num_traits::{Pow, ToPrimitive};
use syn::Lit;

use crate::algebra::Rational;
use crate::diagnostics::Code;
use crate::diagnostics::catalogue::syntax::{NUMBER, OPERAND, OPERATOR};

/// Decimal exponents beyond this have no double anyway, and their powers of ten are long.
const LARGEST_EXPONENT: i64 = 400;
/// A number has no more digits than this: every double has an exact decimal of fewer.
const MOST_DIGITS: usize = 1_200;

/// What is wrong with a literal that is a number of too many digits.
pub(super) fn too_long(literal: &str) -> Option<String> {
    if literal.len() <= MOST_DIGITS || !literal.starts_with(|first: char| first.is_ascii_digit()) {
        return None;
    }
    let digits = literal.bytes().filter(u8::is_ascii_digit).count();
    (digits > MOST_DIGITS).then(|| {
        format!("this number has {digits} digits: numbers of up to {MOST_DIGITS} are supported")
    })
}

/// The exact value of a literal, or what is wrong with it.
pub(super) fn exact(literal: &Lit) -> Result<Rational, (Code, String)> {
    let (digits, suffix) = match literal {
        Lit::Int(number) => (number.base10_digits(), number.suffix()),
        Lit::Float(number) => (number.base10_digits(), number.suffix()),
        _ => {
            let message = "a formula is made of real numbers: write one instead of this".into();
            return Err((OPERAND, message));
        }
    };
    let text = literal_text(literal);
    if !suffix.is_empty() {
        return Err(about_suffix(&text, suffix));
    }
    if text.starts_with("0x") || text.starts_with("0o") || text.starts_with("0b") {
        return Err((NUMBER, format!("numbers are decimal: write `{digits}`")));
    }
    decimal(digits)
        .filter(|value| value.to_f64().is_some_and(f64::is_finite))
        .ok_or_else(|| {
            let message = format!("`{text}` is beyond the range of floating-point numbers");
            (NUMBER, message)
        })
}

/// The literal as it was written.
pub(super) fn literal_text(literal: &Lit) -> String {
    match literal {
        Lit::Int(number) => number.token().to_string(),
        Lit::Float(number) => number.token().to_string(),
        _ => String::new(),
    }
}

fn about_suffix(text: &str, suffix: &str) -> (Code, String) {
    let number = text.strip_suffix(suffix).unwrap_or(text);
    let number = number.trim_end_matches('_');
    let is_type = matches!(suffix.as_bytes(), [b'f' | b'i' | b'u', rest @ ..]
        if rest == b"size" || (!rest.is_empty() && rest.iter().all(u8::is_ascii_digit)));
    if is_type {
        let message = format!("numbers are exact and have no type: write `{number}`");
        (NUMBER, message)
    } else {
        let message = format!("missing operator: write `{number}*{suffix}`");
        (OPERATOR, message)
    }
}

/// `12`, `1.5`, `1.`, `1.5e-3` with the underscores removed.
fn decimal(digits: &str) -> Option<Rational> {
    let (mantissa, exponent) = match digits.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().ok()?),
        None => (digits, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let integer: BigInt = format!("{whole}{fraction}").parse().ok()?;
    if exponent.abs() > LARGEST_EXPONENT {
        return None;
    }
    let scale = exponent - i64::try_from(fraction.len()).ok()?;
    let power: BigInt = Pow::pow(BigInt::from(10), scale.unsigned_abs());
    Some(if scale < 0 {
        Rational::new(integer, power)
    } else {
        Rational::from_integer(integer * power)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<String, String> {
        let literal: Lit = syn::parse_str(text).map_err(|error| error.to_string())?;
        exact(&literal)
            .map(|value| value.to_string())
            .map_err(|(_, message)| message)
    }

    #[test]
    fn literals_are_exact() {
        for (text, value) in [
            ("0.1", "1/10"),
            ("1e-3", "1/1000"),
            ("1_000", "1000"),
            ("1.", "1"),
            ("2.50", "5/2"),
            ("1.5e3", "1500"),
            ("12E2", "1200"),
            ("1_0.2_5", "41/4"),
            ("0", "0"),
            ("0.0", "0"),
        ] {
            assert_eq!(read(text).as_deref(), Ok(value), "{text}");
        }
        let long = "0.1234567890123456789012345678901234567890";
        assert_eq!(
            read(long).as_deref(),
            Ok("1234567890123456789012345678901234567890/10000000000000000000000000000000000000000")
                .map(|_| "123456789012345678901234567890123456789/1000000000000000000000000000000000000000")
        );
    }

    #[test]
    fn other_literals_are_refused() {
        for (text, message) in [
            ("1.0f32", "write `1.0`"),
            ("1f64", "write `1`"),
            ("3_u8", "write `3`"),
            ("2x", "write `2*x`"),
            ("2pi", "write `2*pi`"),
            ("0x1F", "numbers are decimal: write `31`"),
            ("1e400", "beyond the range"),
            ("1e99999999999999999999", "beyond the range"),
            ("\"a\"", "made of real numbers"),
            ("true", "made of real numbers"),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.contains(message), "{text}: {error}");
        }
    }
}
