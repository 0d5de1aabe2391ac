//! Constant parts of formulas: a part without variables must have a finite real value.

use num_traits::{ToPrimitive, Zero};

use super::Value;
use crate::algebra::{Dag, Function, Id, Rational};
use crate::syntax::Operator;

/// The largest exponent of a varying base that the derived formulas are written out for.
pub(super) const LARGEST_EXPONENT: i64 = 100;

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
    }
}

/// The value of `function(argument)`.
pub(super) fn call(function: Function, argument: f64) -> f64 {
    match function {
        Function::Sqrt => argument.sqrt(),
        Function::Exp => argument.exp(),
        // ln 0 = −∞ is refused as not finite
        Function::Ln => argument.ln(),
        Function::Sin => argument.sin(),
        Function::Cos => argument.cos(),
        Function::Tan => argument.tan(),
        Function::Sinh => argument.sinh(),
        Function::Cosh => argument.cosh(),
        Function::Tanh => argument.tanh(),
        Function::Asin => argument.asin(),
        Function::Acos => argument.acos(),
        Function::Atan => argument.atan(),
        Function::Abs => argument.abs(),
        // the compiler's own functions cannot be called by a declaration
        Function::Sinc | Function::SincPrime | Function::Sinhc | Function::SinhcPrime => f64::NAN,
    }
}

/// Why `function` has no value at `argument`.
pub(super) fn call_problem(function: Function, argument: f64) -> String {
    let domain = match function {
        Function::Sqrt => "its argument must not be negative",
        Function::Ln => "its argument must be positive",
        Function::Asin | Function::Acos => "its argument must be in [-1, 1]",
        _ => "its value is beyond the range of floating-point numbers",
    };
    format!("`{function}` of {argument} cannot be evaluated: {domain}")
}

/// Why `left operator right` has no value, of which both are numbers.
pub(super) fn operation_problem(operator: Operator, left: f64, right: f64) -> String {
    let reason = match operator {
        Operator::Divide if right == 0.0 => return "division by zero".into(),
        Operator::Power if left == 0.0 => return "zero to a negative power divides by zero".into(),
        Operator::Power if left < 0.0 && right.fract() != 0.0 => {
            "a negative number has no real power with a fractional exponent"
        }
        _ => "it is beyond the range of floating-point numbers",
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
    format!("{formula} cannot be evaluated: {reason}")
}

/// Why the power with this varying base or exponent cannot be evaluated or derived from.
pub(super) fn power_problem(dag: &Dag, base: Value, exponent: Value) -> Option<String> {
    match (base.number, exponent.number) {
        (Some(number), None) if number <= 0.0 => Some(format!(
            "a varying power of {number} cannot be evaluated: the base must be positive"
        )),
        (None, Some(_)) => {
            let exact = dag.as_constant(exponent.id)?;
            let is_large = exact.is_integer()
                && dag
                    .as_integer(exponent.id)
                    .is_none_or(|n| n.abs() > LARGEST_EXPONENT);
            is_large.then(|| {
                format!("integer powers are supported up to the exponent {LARGEST_EXPONENT}")
            })
        }
        _ => None,
    }
}

/// An exact constant below `root` that has no double.
pub(super) fn has_unrepresentable_constant(dag: &Dag, root: Id) -> bool {
    dag.reachable([root]).into_iter().any(|id| {
        dag.as_constant(id).is_some_and(|value| {
            let double = double(value);
            !double.is_finite() || (double == 0.0 && !value.is_zero())
        })
    })
}
