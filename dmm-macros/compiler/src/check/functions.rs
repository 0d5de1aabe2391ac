//! Functions: `fn V(q) = formula` is checked where it is declared, with arguments of which
//! nothing is known, and written out where it is called.
//!
//! The formula sees its arguments, and of the names declared in front of it those that are not
//! the name of an argument: in `fn V(q) = k*q^2/2` q is the argument, also where a state is called
//! q. What is around the call it does not see. A call with the same arguments is written out once:
//! a function that calls another one twice, and so on sixty times, is an exponentially long formula
//! but a short DAG.

use proc_macro2::Ident;

use super::advice::advice;
use super::names::{Kind, Meaning, is_meant_to_be_unused};
use super::number::{self, Problem};
use super::{Allowed, Resolver, Value};
use crate::algebra::{Function, Id};
use crate::diagnostics::catalogue::check as codes;
use crate::syntax::{Expression, ExpressionKind, FunctionItem, Operator};

impl<'d> Resolver<'d> {
    /// `fn name(arguments) = formula`
    pub(super) fn function(&mut self, item: &'d FunctionItem) {
        let ident = &item.definition.ident;
        let before = self.reporter.diagnostics.len();
        self.scope.names.enter_function();
        for argument in &item.arguments {
            if let Some((code, message)) = self.scope.names.argument_problem(argument) {
                self.report(code, argument, message);
            }
            let value = self.evaluator.unknown();
            self.scope.names.push_local(argument, Kind::Argument, value);
        }
        self.scope.defining = Some(ident.to_string());
        let is_right = self
            .formula(&item.definition.formula, Allowed::All)
            .is_some();
        self.scope.defining = None;
        let is_right = is_right && self.reporter.diagnostics.len() == before;
        for argument in item.arguments.iter().rev() {
            let is_used = self.scope.names.pop_local();
            if is_right && !is_used && !is_meant_to_be_unused(argument) {
                let message = format!(
                    "the argument `{argument}` of `{ident}` is never used: remove it, or call it `_{argument}`"
                );
                self.warn(codes::UNUSED, argument, message);
            }
        }
        self.scope.names.leave_function();
        if self.scope.names.is_first(ident, Kind::Function) {
            self.scope.functions.insert(ident.to_string(), item);
            let meaning = if is_right {
                Meaning::Function
            } else {
                Meaning::Wrong
            };
            self.scope.names.set(ident, meaning);
        }
    }

    /// `function(arguments)`
    pub(super) fn call(
        &mut self,
        formula: &'d Expression,
        function: &'d Ident,
        arguments: &'d [Expression],
        allowed: Allowed,
    ) -> Option<Value> {
        let text = function.to_string();
        if let Some(value) = self.switching_function(formula, &text, arguments, allowed) {
            return value;
        }
        let built_in = text.parse::<Function>().ok().filter(|f| f.is_declarable());
        let is_known = built_in.is_some() || self.scope.names.get(&text).is_some();
        let read = |resolver: &mut Self| -> Vec<Option<Value>> {
            let arguments = arguments.iter();
            arguments
                .map(|argument| resolver.expression(argument, allowed))
                .collect()
        };
        // nothing is said of what an unknown function is given: it may be meant for another one
        let values = if is_known {
            read(self)
        } else {
            self.quietly(read)
        };
        if let Some(known) = built_in {
            return self.built_in(formula, known, &values);
        }
        if self.callable(function, &text, arguments)? {
            self.declared(formula, &text, &values, allowed)
        } else {
            None
        }
    }

    /// `sin(u)` and the like.
    fn built_in(
        &mut self,
        formula: &Expression,
        function: Function,
        arguments: &[Option<Value>],
    ) -> Option<Value> {
        let [argument] = arguments else {
            let count = match arguments.len() {
                0 => "none".to_string(),
                many => many.to_string(),
            };
            let message = format!("`{function}` takes one argument, not {count}");
            self.report(codes::NUMBER_OF_ARGUMENTS, formula.extent, message);
            return None;
        };
        let argument = (*argument)?;
        let number = argument.number.map(|value| number::call(function, value));
        if let (Some(number), Some(value)) = (number, argument.number)
            && !number.is_finite()
        {
            let (code, message) = number::call_problem(function, value);
            self.report_turn(code, formula.extent, message);
            return None;
        }
        Some(Value {
            id: self.evaluator.dag.call(function, argument.id),
            number,
        })
    }

    /// Whether `function` is a declared function that can be called; nothing is returned where
    /// something was reported.
    fn callable(&mut self, function: &Ident, text: &str, arguments: &[Expression]) -> Option<bool> {
        let symbol = self.scope.names.get(text);
        let (code, message): Problem = match symbol.map(|symbol| (symbol.kind, &symbol.meaning)) {
            Some((Kind::Function, Meaning::Function)) => {
                self.scope.names.mark_used(text);
                return Some(true);
            }
            Some((Kind::Function, Meaning::Ahead))
                if self.scope.defining.as_deref() == Some(text) =>
            {
                let message = format!(
                    "`{text}` is used before it is declared: a function cannot call itself"
                );
                (codes::USED_TOO_EARLY, message)
            }
            Some((Kind::Function, Meaning::Ahead)) => {
                let message =
                    format!("`{text}` is used before it is declared; move its declaration up");
                (codes::USED_TOO_EARLY, message)
            }
            Some((Kind::Function, _)) => {
                self.scope.names.mark_used(text);
                return Some(false);
            }
            Some((Kind::State, _)) if matches!(arguments, [argument] if is_time(argument)) => {
                let message = format!("a state is written without its argument: `{text}`");
                (codes::NOT_A_FUNCTION, message)
            }
            Some((Kind::State, _)) if matches!(arguments, [argument] if is_earlier(argument)) => {
                let message = format!(
                    "there are no delays: a rate depends on the states at the same time, `{text}`"
                );
                (codes::NOT_A_FUNCTION, message)
            }
            Some((kind, Meaning::Elements(_))) => {
                let message = format!("`{text}` is a group of {kind}s: an element is `{text}[0]`");
                (codes::NOT_A_FUNCTION, message)
            }
            Some((kind, _)) => {
                let message = format!(
                    "`{text}` is {}, not a function; a product is written `{text}*(…)`",
                    kind.article()
                );
                (codes::NOT_A_FUNCTION, message)
            }
            None if self.scope.names.is_refused(text) => return None,
            None => {
                if let Some(meant) = self.scope.names.closest(text, &[Kind::Function]) {
                    self.scope.names.mark_used(&meant);
                }
                advice(text, arguments, self.scope.names.functions())
            }
        };
        self.scope.names.mark_used(text);
        self.report(code, function, message);
        None
    }

    /// A call of a function that was declared.
    fn declared(
        &mut self,
        formula: &'d Expression,
        text: &str,
        arguments: &[Option<Value>],
        allowed: Allowed,
    ) -> Option<Value> {
        let item = *self.scope.functions.get(text)?;
        if arguments.len() != item.arguments.len() {
            let message = format!(
                "`{text}` takes {}, as in `{}`, not {}",
                super::groups::counted(item.arguments.len(), "argument"),
                self.scope.signature(text),
                arguments.len()
            );
            self.report(codes::NUMBER_OF_ARGUMENTS, formula.extent, message);
            return None;
        }
        let arguments: Vec<Value> = arguments.iter().copied().collect::<Option<_>>()?;
        let value = self.written_out(formula, item, &arguments)?;
        if let Allowed::Constant(what) = allowed
            && value.number.is_none()
            && !self.evaluator.is_unknown(value.id)
        {
            let message = format!("{what} cannot depend on `{formula}`, which varies");
            self.report(codes::NOT_CONSTANT, formula.extent, message);
            return None;
        }
        Some(value)
    }

    /// The formula of a function with the values of its arguments.
    fn written_out(
        &mut self,
        call: &'d Expression,
        item: &'d FunctionItem,
        arguments: &[Value],
    ) -> Option<Value> {
        let ids: Vec<Id> = arguments.iter().map(|argument| argument.id).collect();
        let key = (item.definition.ident.to_string(), ids);
        if let Some(&known) = self.scope.calls_known.get(&key) {
            return known;
        }
        self.scope.names.enter_function();
        for (ident, &value) in item.arguments.iter().zip(arguments) {
            self.scope.names.push_local(ident, Kind::Argument, value);
        }
        self.scope.calls.push(call);
        let value = self.expression(&item.definition.formula, Allowed::All);
        self.scope.calls.pop();
        self.scope.names.leave_function();
        self.scope.calls_known.insert(key, value);
        value
    }
}

/// `t - 1`
fn is_earlier(expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Binary {
            operator: Operator::Subtract,
            left,
            ..
        } => is_time(left),
        _ => false,
    }
}

fn is_time(expression: &Expression) -> bool {
    expression.as_name().is_some_and(|ident| ident == "t")
}
