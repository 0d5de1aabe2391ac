//! Formulas: what they may contain, and whether they can be evaluated.

use super::{model, one};

/// One message on `der(x) = formula;` with a state x, a parameter k, a constant c and a let r.
#[track_caller]
pub(super) fn one_in_formula(formula: &str, message: &str) {
    one(
        &format!(
            "state x; param k = 1; const c = 2; let r = x + k + c; \
             der(x) = {formula}; conserved keep = x + k + c + r;"
        ),
        message,
    );
}

#[test]
fn every_function_is_there() {
    model(
        "system S { state x; der(x) = sqrt(x) + exp(x) + ln(x) + sin(x) + cos(x) + tan(x)
         + sinh(x) + cosh(x) + tanh(x) + asin(x) + acos(x) + atan(x) + x^(1/3) + x^0.37 + 2^x + pi + t; }",
    );
}

#[test]
fn functions_are_known_and_called_with_one_argument() {
    for (formula, message) in [
        ("log(x)", "the natural logarithm is `ln(x)`"),
        ("fabs(x)", "write `abs(x)`"),
        ("relu(x)", "write `max(x, 0)`"),
        ("pow(x, 2)", "power is written `^`"),
        ("sine(x)", "did you mean `sin`?"),
        ("sqr(x)", "power is written `^`"),
        ("sqrrt(x)", "did you mean `sqrt`?"),
        ("gamma(x)", "there is no function `gamma`"),
        ("sinc(x)", "there is no function `sinc`"),
        ("sin(x, x)", "`sin` takes one argument, not 2"),
        ("sin()", "`sin` takes one argument, not none"),
        ("x(t)", "a state is written without its argument: `x`"),
        ("k(x + 1)", "`k` is a parameter, not a function"),
        ("der(x)", "with `let`"),
    ] {
        one_in_formula(formula, message);
    }
}

#[test]
fn formulas_can_be_evaluated() {
    for (formula, message) in [
        ("x / 0", "division by zero"),
        (
            "1 / (0.1 + 0.2 - 0.3)",
            "division by `0.1 + 0.2 - 0.3`, which is zero",
        ),
        ("1 / (x - x)", "which is zero"),
        ("x + ln(-1)", "`ln` of -1 cannot be evaluated"),
        ("ln(0)", "its argument must be positive"),
        ("sqrt(-2)", "its argument must not be negative"),
        ("sqrt(1 - c)", "`sqrt` of -1"),
        ("asin(2)", "in [-1, 1]"),
        ("exp(1000)", "beyond the range"),
        ("10^400", "beyond the range"),
        ("10^100000", "beyond the range"),
        ("1e300 * 1e300", "beyond the range"),
        ("1e300 * x * 1e300", "beyond the range"),
        ("x * 1e-400", "beyond the range"),
        ("0^-1", "divides by zero"),
        ("(-8)^(1/3)", "no real power with a fractional exponent"),
        ("(-2)^x", "the base must be positive"),
        ("x^1000", "up to the exponent 100"),
    ] {
        one_in_formula(formula, message);
    }
}
