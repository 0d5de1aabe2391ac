//! Formulas → nodes of the DAG.
//!
//! Nodes are made by the DAG's constructors alone, which fold exact constants; beside each node
//! without variables its floating-point value is carried, so that ln(−1), 1/0 or exp(1000) is
//! found where it stands, and not by a trajectory that ends in NaN.

use proc_macro2::Ident;

use super::names::{Kind, Progress};
use super::{Resolver, Scope, Value, functions, number};
use crate::algebra::{Function, Rational, Verdict, decide_zero};
use crate::model::Model;
use crate::syntax::{Expression, ExpressionKind, Operator};

/// The node of `formula`. All that is wrong is reported; nothing is returned if something was.
pub(super) fn resolve(
    resolver: &mut Resolver<'_>,
    formula: &Expression,
    scope: Scope,
) -> Option<Value> {
    let value = expression(resolver, formula, scope)?;
    if number::has_unrepresentable_constant(&resolver.dag, value.id) {
        let message = "a constant of this formula is beyond the range of floating-point numbers";
        resolver.error(formula.extent, message);
        return None;
    }
    Some(value)
}

fn expression(resolver: &mut Resolver<'_>, formula: &Expression, scope: Scope) -> Option<Value> {
    match &formula.kind {
        ExpressionKind::Number { value, .. } => Some(constant(resolver, value)),
        ExpressionKind::Name(ident) => name(resolver, ident, scope),
        ExpressionKind::Parenthesised(inner) => expression(resolver, inner, scope),
        ExpressionKind::Negative(operand) => {
            let operand = expression(resolver, operand, scope)?;
            Some(Value {
                id: resolver.dag.neg(operand.id),
                number: operand.number.map(|number| -number),
            })
        }
        ExpressionKind::Call {
            function,
            arguments,
        } => call(resolver, formula, function, arguments, scope),
        ExpressionKind::Binary {
            operator,
            left,
            right,
        } => {
            // both, so that errors on both sides are found
            let left = expression(resolver, left, scope);
            let right_value = expression(resolver, right, scope);
            binary(resolver, formula, *operator, left?, (right_value?, right))
        }
    }
}

fn constant(resolver: &mut Resolver<'_>, value: &Rational) -> Value {
    Value {
        id: resolver.dag.constant(value.clone()),
        number: Some(number::double(value)),
    }
}

fn binary(
    resolver: &mut Resolver<'_>,
    formula: &Expression,
    operator: Operator,
    left: Value,
    (right, divisor): (Value, &Expression),
) -> Option<Value> {
    if operator == Operator::Divide && is_zero(resolver, right) {
        let message = match &divisor.kind {
            ExpressionKind::Number { .. } => "division by zero".to_string(),
            _ => format!(
                "division by `{}`, which is zero",
                divisor.inside_parentheses()
            ),
        };
        resolver.error(formula.extent, message);
        return None;
    }
    if operator == Operator::Power
        && let Some(problem) = number::power_problem(&resolver.dag, left, right)
    {
        resolver.error(formula.extent, problem);
        return None;
    }
    let both = left.number.zip(right.number);
    let number = both.map(|(left, right)| number::operation(operator, left, right));
    if let (Some(number), Some((left, right))) = (number, both)
        && !number.is_finite()
    {
        let problem = number::operation_problem(operator, left, right);
        resolver.error(formula.extent, problem);
        return None;
    }
    let dag = &mut resolver.dag;
    let id = match operator {
        Operator::Add => dag.add(left.id, right.id),
        Operator::Subtract => dag.sub(left.id, right.id),
        Operator::Multiply => dag.mul(left.id, right.id),
        Operator::Divide => dag.div(left.id, right.id),
        Operator::Power => dag.pow(left.id, right.id),
    };
    // 0·x and x^0 are numbers; an exact value is better than what was carried along
    let number = match dag.as_constant(id) {
        Some(value) => Some(number::double(value)),
        None => number,
    };
    Some(Value { id, number })
}

/// Whether a divisor is zero whatever the variables are.
fn is_zero(resolver: &mut Resolver<'_>, divisor: Value) -> bool {
    resolver.dag.is_zero(divisor.id)
        || (resolver.dag.as_constant(divisor.id).is_none()
            && matches!(decide_zero(&mut resolver.dag, divisor.id), Verdict::Proved))
}

fn call(
    resolver: &mut Resolver<'_>,
    formula: &Expression,
    function: &Ident,
    arguments: &[Expression],
    scope: Scope,
) -> Option<Value> {
    let values: Vec<Option<Value>> = arguments
        .iter()
        .map(|argument| expression(resolver, argument, scope))
        .collect();
    let text = function.to_string();
    let known = text.parse::<Function>().ok().filter(|f| f.is_declarable());
    let Some(known) = known else {
        let message = match resolver.names.get(&text).map(|symbol| symbol.kind) {
            Some(Kind::State) if arguments.len() == 1 && arguments.iter().all(is_time) => {
                format!("a state is written without its argument: `{text}`")
            }
            Some(kind) => {
                format!("`{text}` is a {kind}, not a function; a product is written `{text}*(…)`")
            }
            None => functions::advice(&text),
        };
        resolver.names.mark_used(&text);
        resolver.error(function, message);
        return None;
    };
    let [argument] = values.as_slice() else {
        let count = match values.len() {
            0 => "none".to_string(),
            many => many.to_string(),
        };
        resolver.error(
            formula.extent,
            format!("`{known}` takes one argument, not {count}"),
        );
        return None;
    };
    let argument = (*argument)?;
    let number = argument.number.map(|value| number::call(known, value));
    if let (Some(number), Some(value)) = (number, argument.number)
        && !number.is_finite()
    {
        resolver.error(formula.extent, number::call_problem(known, value));
        return None;
    }
    Some(Value {
        id: resolver.dag.call(known, argument.id),
        number,
    })
}

fn is_time(expression: &Expression) -> bool {
    expression.as_name().is_some_and(|ident| ident == "t")
}

fn name(resolver: &mut Resolver<'_>, ident: &Ident, scope: Scope) -> Option<Value> {
    let text = ident.to_string();
    if text == "pi" {
        return Some(Value {
            id: resolver.dag.pi(),
            number: Some(std::f64::consts::PI),
        });
    }
    if text == "t" {
        if let Scope::Constant(what) = scope {
            resolver.error(ident, format!("{what} cannot depend on the time"));
            return None;
        }
        return Some(Value {
            id: resolver.dag.variable(&Model::time()),
            number: None,
        });
    }
    let Some(symbol) = resolver.names.get(&text) else {
        undeclared(resolver, ident);
        return None;
    };
    let (kind, progress) = (symbol.kind, symbol.progress);
    resolver.names.mark_used(&text);
    if let Err(message) = may_use(&text, kind, scope) {
        if resolver.names.is_refused(&text) {
            return None;
        }
        resolver.error(ident, message);
        return None;
    }
    match progress {
        Progress::Resolved(value) if scope == Scope::All || value.number.is_some() => Some(value),
        Progress::Resolved(_) => {
            let Scope::Constant(what) = scope else {
                return None;
            };
            resolver.error(
                ident,
                format!("{what} cannot depend on `{text}`, which varies"),
            );
            None
        }
        Progress::Wrong => None,
        Progress::Ahead => {
            let message =
                format!("`{text}` is used before it is declared; move its declaration up");
            resolver.error(ident, message);
            None
        }
    }
}

/// Whether a formula may use a name of this kind at all.
fn may_use(text: &str, kind: Kind, scope: Scope) -> Result<(), String> {
    match (kind, scope) {
        (Kind::Interface, _) => Err(format!(
            "`{text}` is an interface, not a quantity: name its formula with `let` to use it in both places"
        )),
        (Kind::State | Kind::Parameter, Scope::Constant(what)) => {
            Err(format!("{what} cannot depend on the {kind} `{text}`"))
        }
        _ => Ok(()),
    }
}

fn undeclared(resolver: &mut Resolver<'_>, ident: &Ident) {
    const QUANTITIES: &[Kind] = &[Kind::State, Kind::Parameter, Kind::Constant, Kind::Let];
    let text = ident.to_string();
    if resolver.names.is_refused(&text) {
        return;
    }
    let message = match text.as_str() {
        "time" => "the time is `t`".into(),
        "PI" | "Pi" | "π" => "the number π is `pi`".into(),
        "e" | "E" => format!("`{text}` is not declared; Euler's number is `exp(1)`"),
        _ if text.parse::<Function>().is_ok_and(Function::is_declarable) => {
            format!("`{text}` is a function: write `{text}(x)`")
        }
        _ => {
            if let Some(meaning) = resolver.names.other_meaning(&text) {
                format!(
                    "`{text}` is {meaning}, which a formula here cannot use: declare it with `let` at the top level"
                )
            } else if let Some(candidate) = resolver.names.closest(&text, QUANTITIES) {
                // it was meant, so that nothing is to be said of it being unused
                resolver.names.mark_used(&candidate);
                format!("`{text}` is not declared; did you mean `{candidate}`?")
            } else {
                // once is enough
                resolver.names.refuse(&text);
                format!(
                    "`{text}` is not declared: declare it as a `state`, a `param`, a `const` or a `let`"
                )
            }
        }
    };
    resolver.error(ident, message);
}
