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

/// What is said of functions that are made of several smooth ones: where they switch, and to what.
fn switches(name: &str, arguments: &[Expression]) -> Option<Problem> {
    let text = |argument: Option<&Expression>, otherwise: &str| {
        argument.map_or_else(|| otherwise.to_owned(), ToString::to_string)
    };
    let (u, v) = (text(arguments.first(), "u"), text(arguments.get(1), "v"));
    // where it switches, its value where that is positive, and where it is negative
    let parts = match name {
        "abs" | "fabs" => Some((u.clone(), u.clone(), format!("-{}", factor(&u)))),
        "sign" | "sgn" | "signum" => Some((u, "1".into(), "-1".into())),
        "step" | "heaviside" | "Heaviside" => Some((u, "1".into(), "0".into())),
        "relu" | "ramp" => Some((u.clone(), u, "0".into())),
        "max" | "fmax" if arguments.len() == 2 => Some((difference(&u, &v), u, v)),
        "min" | "fmin" if arguments.len() == 2 => Some((difference(&u, &v), v, u)),
        "max" | "min" | "floor" | "ceil" | "round" | "trunc" | "clamp" | "sat" | "saturate"
        | "mod" | "fmod" | "rem" | "frac" | "ifelse" | "piecewise" | "select" | "cond" => None,
        _ => return None,
    };
    let message = match parts {
        Some((g, above, below)) => format!(
            "`{name}` is not smooth: declare `interface name = {g};` and a `region` on each side, with `{above}` where it is positive and `{below}` where it is negative"
        ),
        None => format!(
            "`{name}` is not smooth: declare an `interface` where it switches and a `region` on each side"
        ),
    };
    Some((codes::NOT_SMOOTH, message))
}

/// u − v as one would write it.
fn difference(u: &str, v: &str) -> String {
    match (u, v) {
        (u, "0") => u.to_owned(),
        ("0", v) => format!("-{}", factor(v)),
        (u, v) if v.contains(" + ") || v.contains(" - ") => format!("{u} - ({v})"),
        (u, v) => format!("{u} - {v}"),
    }
}
