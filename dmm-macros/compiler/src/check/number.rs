//! Constant parts of formulas: a part without variables must have a finite real value.

use num_traits::{ToPrimitive, Zero};

use super::Value;
use crate::algebra::{Dag, Domain, Function, Id, Math, Rational};
use crate::diagnostics::Code;
use crate::diagnostics::catalogue::check as codes;
use crate::syntax::Operator;

/// The largest exponent of a varying base that the derived formulas are written out for.
const LARGEST_EXPONENT: i64 = 100;
/// The most bits of numerator and denominator together that an exact constant may have: more
/// than any sum of two doubles needs.
const MOST_BITS: u64 = 6_000;
/// Functions, powers, and sums within products are nested up to this level: what reads formulas
/// by recursion has the stack of a macro.
pub(super) const MOST_LEVELS: usize = 160;

/// A kind of mistake, and what is wrong.
pub(super) type Problem = (Code, String);

/// The double nearest to an exact constant.
pub(super) fn double(value: &Rational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

/// The value of `left operator right`, of which both are numbers.
pub(super) fn operation(operator: Operator, left: f64, right: f64) -> f64 {
    match operator {
        Operator::Add => left + right,
        Operator::Subtract => left - right,
        Operator::Multiply => left * right,
        Operator::Divide => left / right,
        Operator::Power => left.powf(right),
        Operator::Remainder => left.rem_euclid(right),
    }
}

/// The value of `function(argument)`; ln 0 = −∞ is refused as not finite.
pub(super) fn call(function: Function, argument: f64) -> f64 {
    (function.properties().value)(argument)
}

/// Why `function` has no value at `argument`.
pub(super) fn call_problem(function: Function, argument: f64) -> Problem {
    let (code, domain) = match function.properties().domain {
        Domain::NotNegative => (codes::OUTSIDE_DOMAIN, "its argument must not be negative"),
        Domain::Positive => (codes::OUTSIDE_DOMAIN, "its argument must be positive"),
        Domain::WithinOne => (codes::OUTSIDE_DOMAIN, "its argument must be in [-1, 1]"),
        Domain::All | Domain::NonZero(_) => (
            codes::OUT_OF_RANGE,
            "its value is beyond the range of floating-point numbers",
        ),
    };
    let message = format!("`{function}` of {argument} cannot be evaluated: {domain}");
    (code, message)
}

/// Why `left operator right` has no value, of which both are numbers.
pub(super) fn operation_problem(operator: Operator, left: f64, right: f64) -> Problem {
    let (code, reason) = match operator {
        Operator::Divide if right == 0.0 => {
            return (codes::DIVISION_BY_ZERO, "division by zero".into());
        }
        Operator::Power if left == 0.0 => {
            let message = "zero to a negative power divides by zero".into();
            return (codes::DIVISION_BY_ZERO, message);
        }
        Operator::Power if left < 0.0 && right.fract() != 0.0 => (
            codes::OUTSIDE_DOMAIN,
            "a negative number has no real power with a fractional exponent",
        ),
        _ => (
            codes::OUT_OF_RANGE,
            "it is beyond the range of floating-point numbers",
        ),
    };
    let [left, right] = [left, right].map(|number| {
        if number < 0.0 {
            format!("({number})")
        } else {
            number.to_string()
        }
    });
    let formula = match operator {
        Operator::Power => format!("{left}^{right}"),
        _ => format!("{left} {} {right}", operator.symbol()),
    };
    (code, format!("{formula} cannot be evaluated: {reason}"))
}

/// Why the power with this varying base or exponent cannot be evaluated or derived from.
pub(super) fn power_problem(dag: &Dag, base: Value, exponent: Value) -> Option<Problem> {
    match (base.number, exponent.number) {
        (Some(number), None) if number <= 0.0 => {
            let message = format!(
                "a varying power of {number} cannot be evaluated: the base must be positive"
            );
            Some((codes::OUTSIDE_DOMAIN, message))
        }
        (None, Some(_)) => is_large_exponent(dag, exponent.id).then(large_exponent),
        _ => None,
    }
}

fn is_large_exponent(dag: &Dag, exponent: Id) -> bool {
    dag.as_constant(exponent).is_some_and(Rational::is_integer)
        && dag
            .as_integer(exponent)
            .is_none_or(|n| n.unsigned_abs() > LARGEST_EXPONENT.unsigned_abs())
}

fn large_exponent() -> Problem {
    let message = format!("integer powers are supported up to the exponent {LARGEST_EXPONENT}");
    (codes::LARGE_EXPONENT, message)
}

/// The size of an exact constant in bits; 0 of anything else.
fn bits(dag: &Dag, id: Id) -> u64 {
    dag.as_constant(id)
        .map_or(0, |value| value.numer().bits() + value.denom().bits())
}

/// Why the exact value of a sum, product or quotient cannot be kept.
pub(super) fn size_problem(dag: &Dag, left: Value, right: Value) -> Option<Problem> {
    let (left, right) = (bits(dag, left.id), bits(dag, right.id));
    (left > 0 && right > 0 && left + right > MOST_BITS).then(|| {
        let message = "the exact value of this constant has too many digits";
        (codes::OUT_OF_RANGE, message.into())
    })
}

/// Whether the exact value of a power would have too many digits.
pub(super) fn is_long_power(dag: &Dag, base: Value, exponent: Value) -> bool {
    dag.as_integer(exponent.id)
        .is_some_and(|n| bits(dag, base.id).saturating_mul(n.unsigned_abs()) > MOST_BITS)
}

/// What exact arithmetic with these operands costs, in nodes: a greatest common divisor takes
/// the square of their bits.
pub(super) fn work(dag: &Dag, left: Value, right: Value) -> usize {
    let (left, right) = (bits(dag, left.id), bits(dag, right.id));
    if left == 0 || right == 0 {
        return 0;
    }
    let square = left.max(right).saturating_pow(2);
    usize::try_from(square / 1_500).unwrap_or(usize::MAX)
}

/// How deep a node is nested, by the `levels` of its operands: a sum within a sum, and a product
/// within a product, are of the same level.
pub(super) fn level(dag: &Dag, id: Id, levels: &[usize]) -> usize {
    let of = |child: &Id| {
        let level = levels.get(usize::from(*child)).copied().unwrap_or(0);
        let is_sum = |id: Id| matches!(dag[id], Math::Add(_) | Math::Sub(_) | Math::Neg(_));
        let is_product = |id: Id| matches!(dag[id], Math::Mul(_) | Math::Div(_));
        let goes_on = is_sum(id) && is_sum(*child) || is_product(id) && is_product(*child);
        if goes_on { level } else { level + 1 }
    };
    let children = egg::Language::children(&dag[id]);
    children.iter().map(of).max().unwrap_or(1)
}

/// What is wrong with a node of a formula whatever it is a part of: an exact constant that has
/// no double, or an exponent that came to be too large by products of powers.
pub(super) fn node_problem(dag: &Dag, id: Id) -> Option<Problem> {
    match &dag[id] {
        Math::Constant(value) => {
            let double = double(value);
            let is_lost = !double.is_finite() || (double == 0.0 && !value.is_zero());
            let message =
                "a constant of this formula is beyond the range of floating-point numbers";
            is_lost.then(|| (codes::OUT_OF_RANGE, message.into()))
        }
        Math::Pow([base, exponent]) => {
            let varies = dag.as_constant(*base).is_none();
            (varies && is_large_exponent(dag, *exponent)).then(large_exponent)
        }
        _ => None,
    }
}
