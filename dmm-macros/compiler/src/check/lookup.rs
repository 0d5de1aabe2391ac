//! Names within formulas: what has a value, and what to say about what has none.

use proc_macro2::Ident;

use super::names::{Kind, Meaning, is_built_in};
use super::number::Problem;
use super::{Allowed, Resolver, Value};
use crate::diagnostics::catalogue::check as codes;
use crate::model::Model;

impl Resolver<'_> {
    /// The value of a name in a formula.
    pub(super) fn name(&mut self, ident: &Ident, allowed: Allowed) -> Option<Value> {
        let text = ident.to_string();
        if text == "pi" {
            return Some(Value {
                id: self.evaluator.dag.pi(),
                number: Some(std::f64::consts::PI),
            });
        }
        if text == "t" {
            if let Allowed::Constant(what) = allowed {
                let message = format!("{what} cannot depend on the time");
                self.report(codes::NOT_CONSTANT, ident, message);
                return None;
            }
            return Some(Value {
                id: self.evaluator.dag.variable(&Model::time()),
                number: None,
            });
        }
        match self.meaning(ident, &text, allowed)? {
            Meaning::Value(value) => self.constant_in(value, ident, &text, allowed),
            Meaning::Elements(elements) => {
                let message = without_index(&text, elements.len());
                self.report(codes::INDEX_MISSING, ident, message);
                None
            }
            _ => None,
        }
    }

    /// What `ident` means, as far as a formula in `allowed` may use it; nothing is returned where
    /// something was reported.
    pub(super) fn meaning(
        &mut self,
        ident: &Ident,
        text: &str,
        allowed: Allowed,
    ) -> Option<Meaning> {
        let Some(symbol) = self.scope.names.get(text) else {
            self.undeclared(ident);
            return None;
        };
        let (kind, meaning) = (symbol.kind, symbol.meaning.clone());
        self.scope.names.mark_used(text);
        let problem = match (kind, allowed, &meaning) {
            _ if self.scope.names.is_refused(text) && matches!(meaning, Meaning::Ahead) => {
                return None;
            }
            (Kind::Interface, ..) => {
                let message = format!(
                    "`{text}` is an interface, not a quantity: name its formula with `let` to use it in both places"
                );
                (codes::NOT_A_QUANTITY, message)
            }
            (Kind::Function, ..) => {
                let message = format!(
                    "`{text}` is a function: write `{}`",
                    self.scope.signature(text)
                );
                (codes::NOT_A_QUANTITY, message)
            }
            (Kind::State | Kind::Discrete | Kind::Parameter, Allowed::Constant(what), _) => {
                if self.scope.names.is_refused(text) {
                    return None;
                }
                let mut message = format!("{what} cannot depend on the {kind} `{text}`");
                if kind == Kind::Parameter {
                    message.push_str(&format!("; a constant is declared by `const {text} = …;`"));
                }
                (codes::NOT_CONSTANT, message)
            }
            (_, _, Meaning::Ahead) => {
                let message =
                    format!("`{text}` is used before it is declared; move its declaration up");
                (codes::USED_TOO_EARLY, message)
            }
            (_, _, Meaning::Wrong) => return None,
            _ => return Some(meaning),
        };
        self.report(problem.0, ident, problem.1);
        None
    }

    /// `value`, if a formula in `allowed` may use what varies as much as it does.
    fn constant_in(
        &mut self,
        value: Value,
        ident: &Ident,
        text: &str,
        allowed: Allowed,
    ) -> Option<Value> {
        let Allowed::Constant(what) = allowed else {
            return Some(value);
        };
        if value.number.is_some() || self.evaluator.is_unknown(value.id) {
            return Some(value);
        }
        let is_argument = self
            .scope
            .names
            .get(text)
            .is_some_and(|symbol| symbol.kind == Kind::Argument);
        let (code, message) = if is_argument {
            let message =
                format!("the argument `{text}` is part of {what}, so that it has to be a constant");
            (codes::INDEX_ARGUMENT, message)
        } else {
            let message = format!("{what} cannot depend on `{text}`, which varies");
            (codes::NOT_CONSTANT, message)
        };
        self.report(code, ident, message);
        None
    }

    /// Reports that a formula uses a name that stands for no quantity.
    pub(super) fn undeclared(&mut self, ident: &Ident) {
        let text = ident.to_string();
        if self.scope.names.is_refused(&text) {
            return;
        }
        let (code, message) = self.undeclared_problem(&text);
        self.report(code, ident, message);
    }

    fn undeclared_problem(&mut self, text: &str) -> Problem {
        let message = match text {
            "time" => "the time is `t`".into(),
            "PI" | "Pi" | "π" => "the number π is `pi`".into(),
            "inf" | "Inf" | "infinity" | "oo" | "nan" | "NaN" | "NAN" => {
                format!("`{text}` is not declared: every quantity is a finite number")
            }
            "e" | "E" => format!("`{text}` is not declared; Euler's number is `exp(1)`"),
            _ if is_built_in(text) => {
                let message = format!("`{text}` is a function: write `{text}(x)`");
                return (codes::NOT_A_QUANTITY, message);
            }
            _ => {
                if let Some(meaning) = self.scope.names.other_meaning(text) {
                    let message = format!(
                        "`{text}` is {meaning}, which a formula here cannot use: declare it with `let` at the top level"
                    );
                    return (codes::NOT_A_QUANTITY, message);
                }
                if let Some(candidate) = self.scope.names.closest(text, Kind::QUANTITIES) {
                    // it was meant, so that nothing is to be said of it being unused
                    self.scope.names.mark_used(&candidate);
                    format!("`{text}` is not declared; did you mean `{candidate}`?")
                } else {
                    // once is enough
                    self.scope.names.refuse(text);
                    format!(
                        "`{text}` is not declared: declare it as a `state`, a `param`, a `const` or a `let`"
                    )
                }
            }
        };
        (codes::UNDECLARED, message)
    }
}

/// What to write instead of the name of a group.
fn without_index(text: &str, length: usize) -> String {
    if length == 1 {
        return format!("`{text}` is a group of one element: write `{text}[0]`");
    }
    format!(
        "`{text}` is a group of {length} elements: write one of them, as in `{text}[0]`, or `sum(i in 0..{length}, {text}[i])`"
    )
}
