//! What is said where a function is called that the declaration does not have.

use super::number::Problem;
use crate::algebra::Function;
use crate::diagnostics::catalogue::check as codes;
use crate::diagnostics::closest;
use crate::syntax::Expression;

/// Advice about the unknown function `name` of `arguments`, beside which the functions `declared`
/// are there.
pub(super) fn advice<'a>(
    name: &str,
    arguments: &[Expression],
    declared: impl Iterator<Item = &'a str>,
) -> Problem {
    if let Some(problem) = switches(name, arguments).or_else(|| is_no_formula(name)) {
        return problem;
    }
    if let Some(instead) = written(name, arguments) {
        let message = format!("there is no function `{name}`: {instead}");
        return (codes::UNKNOWN_FUNCTION, message);
    }
    let declared: Vec<&str> = declared.collect();
    if let Some(function) = derivative_of(name, &declared) {
        let message = format!(
            "there is no function `{name}`: declare the derivative of `{function}`, `fn {name}(…) = …;`"
        );
        return (codes::UNKNOWN_FUNCTION, message);
    }
    let built_in = Function::ALL.iter().filter(|f| f.is_declarable());
    let known: Vec<&str> = (declared.into_iter())
        .chain(built_in.map(|f| f.name()))
        .collect();
    let message = match closest(name, known.iter().copied()) {
        Some(function) => format!("there is no function `{name}`; did you mean `{function}`?"),
        None => format!(
            "there is no function `{name}`; there are {}, and what `fn` declares",
            known.join(", ")
        ),
    };
    (codes::UNKNOWN_FUNCTION, message)
}

/// What is written instead of a function that other languages have.
fn written(name: &str, arguments: &[Expression]) -> Option<String> {
    let instead = match name {
        "log" if arguments.len() == 2 => "write `ln(x)/ln(b)` for the logarithm to the base b",
        "log" => "the natural logarithm is `ln(x)`",
        "log10" => "write `ln(x)/ln(10)`",
        "log2" => "write `ln(x)/ln(2)`",
        "log1p" => "write `ln(1 + x)`",
        "expm1" => "write `exp(x) - 1`",
        "exp2" => "write `2^x`",
        "exp10" => "write `10^x`",
        "pow" | "powi" | "powf" | "power" | "square" | "sqr" => "power is written `^`, as in `x^2`",
        "cbrt" => "write `x^(1/3)`",
        "root" | "nthroot" => "write `x^(1/n)`",
        "hypot" => "write `sqrt(x^2 + y^2)`",
        "norm" | "norm2" | "magnitude" => {
            "write it out, `sqrt(x^2 + y^2)`, or `sqrt(sum(i in 0..n, q[i]^2))` of a group"
        }
        "dot" | "inner" => "write it out, `x*u + y*v`, or `sum(i in 0..n, q[i]*p[i])` of groups",
        "cross" => "write it out by components, as in `x*v - y*u`",
        "product" | "prod" => "write the factors out",
        "arcsin" => "write `asin(x)`",
        "arccos" => "write `acos(x)`",
        "arctan" => "write `atan(x)`",
        "sec" => "write `1/cos(x)`",
        "csc" => "write `1/sin(x)`",
        "cot" => "write `1/tan(x)`",
        "coth" => "write `1/tanh(x)`",
        "sech" => "write `1/cosh(x)`",
        "asinh" | "arcsinh" => "write `ln(x + sqrt(x^2 + 1))`",
        "acosh" | "arccosh" => "write `ln(x + sqrt(x^2 - 1))`",
        "atanh" | "arctanh" => "write `ln((1 + x)/(1 - x))/2`",
        "sigmoid" | "logistic" => "write `1/(1 + exp(-x))`",
        "deg2rad" | "radians" => "angles are in radians: write `x*pi/180`",
        "sind" | "cosd" | "tand" => "angles are in radians: write `sin(x*pi/180)`",
        "pi" | "t" => "leave out its parentheses",
        "der" => "give the derivative's formula a name with `let` and use that",
        "len" | "length" | "size" | "numel" => {
            "declare the number of elements as a `const` and use that"
        }
        "atan2" | "arctan2" | "angle" => {
            let (y, x) = match arguments {
                [y, x] => (y.to_string(), x.to_string()),
                _ => ("y".to_owned(), "x".to_owned()),
            };
            let (y_factor, x_squared, y_squared) = (
                factor(&y),
                format!("{}^2", factor(&x)),
                format!("{}^2", factor(&y)),
            );
            return Some(format!(
                "it jumps; write `2*atan({y_factor}/({x} + sqrt({x_squared} + {y_squared})))`, which is the same angle where it does not jump"
            ));
        }
        _ => return None,
    };
    Some(instead.to_owned())
}

/// A formula as a factor: in parentheses unless it is a name or a number.
fn factor(formula: &str) -> String {
    let is_simple = formula
        .chars()
        .all(|c| c.is_alphanumeric() || "_.[]".contains(c));
    if is_simple {
        formula.to_owned()
    } else {
        format!("({formula})")
    }
}

/// What is said of functions that are no formulas of states, parameters and the time.
fn is_no_formula(name: &str) -> Option<Problem> {
    let reason = match name {
        "delay" | "lag" | "history" | "pre" => {
            "there are no delays: a rate depends on the states at the same time"
        }
        "rand" | "randn" | "random" | "noise" | "normal" => {
            "nothing is random: a rate is a formula of the states, the parameters and `t`"
        }
        "diff" | "grad" | "gradient" | "derivative" | "deriv" | "D" | "ddt" | "jacobian" => {
            "a formula is not differentiated here: write its derivative, or a `hamiltonian`, which derives the field from H"
        }
        "integral" | "integrate" | "int" => {
            "a formula is not integrated here: declare a state whose rate is the integrand"
        }
        "interp" | "interp1" | "lookup" | "table" | "spline" | "interpolate" => {
            "there are no tables: write a formula"
        }
        _ => return None,
    };
    Some((
        codes::UNKNOWN_FUNCTION,
        format!("there is no function `{name}`: {reason}"),
    ))
}

/// The declared function of which `name` is probably meant to be the derivative.
fn derivative_of<'a>(name: &str, declared: &[&'a str]) -> Option<&'a str> {
    let of = (name.strip_suffix("_prime"))
        .or_else(|| name.strip_prefix("d_"))
        .or_else(|| name.strip_prefix('d'))?;
    declared.iter().find(|function| **function == of).copied()
}

/// What is said of functions that are made of several smooth ones under another name.
fn switches(name: &str, arguments: &[Expression]) -> Option<Problem> {
    let u = arguments
        .first()
        .map_or_else(|| "u".to_owned(), ToString::to_string);
    let instead = match name {
        "fabs" => format!("abs({u})"),
        "sgn" | "signum" => format!("sign({u})"),
        "step" | "heaviside" | "Heaviside" => format!("if {u} > 0 {{ 1 }} else {{ 0 }}"),
        "relu" | "ramp" => format!("max({u}, 0)"),
        "fmax" => "max(u, v)".to_owned(),
        "fmin" => "min(u, v)".to_owned(),
        "sat" | "saturate" => format!("clamp({u}, -1, 1)"),
        "ifelse" | "piecewise" | "select" | "cond" => "if a > b { u } else { v }".to_owned(),
        "floor" | "ceil" | "round" | "trunc" | "mod" | "fmod" | "rem" | "frac" => {
            let message = format!(
                "`{name}` jumps without end: count with `discrete n = 0;` and an event at each jump, `on name rising {{ n = n + 1; }}`"
            );
            return Some((codes::NOT_SMOOTH, message));
        }
        _ => return None,
    };
    Some((
        codes::UNKNOWN_FUNCTION,
        format!("there is no function `{name}`: write `{instead}`"),
    ))
}
