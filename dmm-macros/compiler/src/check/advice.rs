//! What is said where a function is called that the declaration does not have.

use super::number::Problem;
use crate::algebra::Function;
use crate::diagnostics::catalogue::check as codes;
use crate::diagnostics::closest;

/// Advice about the unknown function `name`, beside which the functions `declared` are there.
pub(super) fn advice<'a>(name: &str, declared: impl Iterator<Item = &'a str>) -> Problem {
    let instead = match name {
        "log" => "the natural logarithm is `ln(x)`",
        "log10" => "write `ln(x)/ln(10)`",
        "log2" => "write `ln(x)/ln(2)`",
        "exp2" => "write `2^x`",
        "pow" | "powi" | "powf" | "power" => "power is written `^`, as in `x^2`",
        "square" | "sqr" => "power is written `^`, as in `x^2`",
        "cbrt" => "write `x^(1/3)`",
        "hypot" => "write `sqrt(x^2 + y^2)`",
        "arcsin" => "write `asin(x)`",
        "arccos" => "write `acos(x)`",
        "arctan" => "write `atan(x)`",
        "sec" => "write `1/cos(x)`",
        "csc" => "write `1/sin(x)`",
        "cot" => "write `1/tan(x)`",
        "asinh" => "write `ln(x + sqrt(x^2 + 1))`",
        "acosh" => "write `ln(x + sqrt(x^2 - 1))`",
        "atanh" => "write `ln((1 + x)/(1 - x))/2`",
        "pi" | "t" => "leave out its parentheses",
        "der" => "give the derivative's formula a name with `let` and use that",
        _ if is_not_smooth(name) => {
            let message = format!(
                "`{name}` is not smooth: declare an `interface` where it switches and a `region` on each side"
            );
            return (codes::NOT_SMOOTH, message);
        }
        _ => {
            let built_in = Function::ALL.iter().filter(|f| f.is_declarable());
            let known: Vec<&str> = declared.chain(built_in.map(|f| f.name())).collect();
            let message = match closest(name, known.iter().copied()) {
                Some(function) => {
                    format!("there is no function `{name}`; did you mean `{function}`?")
                }
                None => format!(
                    "there is no function `{name}`; there are {}",
                    known.join(", ")
                ),
            };
            return (codes::UNKNOWN_FUNCTION, message);
        }
    };
    let message = format!("there is no function `{name}`: {instead}");
    (codes::UNKNOWN_FUNCTION, message)
}

fn is_not_smooth(name: &str) -> bool {
    matches!(
        name,
        "abs"
            | "min"
            | "max"
            | "sign"
            | "sgn"
            | "signum"
            | "floor"
            | "ceil"
            | "round"
            | "trunc"
            | "clamp"
            | "step"
            | "heaviside"
            | "atan2"
            | "mod"
    )
}
