//! What is said where a function is called that the language does not have.

use crate::algebra::Function;
use crate::diagnostics::closest;

/// Advice about the unknown function `name`.
pub(super) fn advice(name: &str) -> String {
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
        "der" => "give the derivative's formula a name with `let` and use that",
        _ if is_not_smooth(name) => {
            return format!(
                "`{name}` is not smooth: declare an `interface` where it switches and a `region` on each side"
            );
        }
        _ => {
            let known = Function::ALL.iter().filter(|f| f.is_declarable());
            return match closest(name, known.clone().map(|f| f.name())) {
                Some(function) => {
                    format!("there is no function `{name}`; did you mean `{function}`?")
                }
                None => {
                    let known: Vec<&str> = known.map(|f| f.name()).collect();
                    format!(
                        "there is no function `{name}`; there are {}",
                        known.join(", ")
                    )
                }
            };
        }
    };
    format!("there is no function `{name}`: {instead}")
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
