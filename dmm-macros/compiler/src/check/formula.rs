//! Formulas → nodes of the DAG.
//!
//! Nodes are made by the DAG's constructors alone, which fold exact constants; beside each node
//! without variables its floating-point value is carried, so that ln(−1), 1/0 or exp(1000) is
//! found where it stands, and not by a trajectory that ends in NaN.

use std::collections::BTreeSet;

use super::number::{self, Problem};
use super::{Resolver, Scope, Value};
use crate::algebra::{Id, Math, Rational, is_proved_zero};
use crate::diagnostics::catalogue::check as codes;
use crate::syntax::{Expression, ExpressionKind, Operator};

/// Formulas within functions within functions may be nested this deep in all.
const DEEPEST: usize = 600;
/// Divisors of more nodes are not examined for being zero.
const LARGEST_DIVISOR: usize = 1_000;
/// The work of the proof that a divisor is zero, in nodes.
const PROOF: usize = 200;

/// What is wrong with a node of a formula.
enum NodeProblem {
    /// Whatever it is a part of.
    Wrong(Problem),
    /// It is nested too deeply to be derived from.
    TooNested,
}

impl<'d> Resolver<'d> {
    /// The node of `formula`. All that is wrong is reported; nothing is returned if something
    /// was.
    pub(super) fn formula(&mut self, formula: &'d Expression, scope: Scope) -> Option<Value> {
        let value = self.expression(formula, scope)?;
        match self.node_problem(value.id) {
            None => Some(value),
            Some(NodeProblem::Wrong((code, message))) => {
                self.report(code, formula.extent, message);
                None
            }
            Some(NodeProblem::TooNested) => {
                let levels = number::MOST_LEVELS;
                let reason = format!(
                    "with what its names stand for, a formula is nested more than {levels} deep"
                );
                self.too_long(formula, &reason);
                None
            }
        }
    }

    /// What is wrong with a node below `root`; those that were examined before are in order.
    fn node_problem(&mut self, root: Id) -> Option<NodeProblem> {
        self.levels.resize(self.dag.len(), 0);
        let is_new = |levels: &[usize], id: Id| levels.get(usize::from(id)) == Some(&0);
        let mut stack = vec![root];
        let mut reached = BTreeSet::new();
        while let Some(id) = stack.pop() {
            if is_new(&self.levels, id) && reached.insert(id) {
                stack.extend_from_slice(egg::Language::children(&self.dag[id]));
            }
        }
        // operands come before what is made of them
        for id in reached {
            let level = number::level(&self.dag, id, &self.levels);
            if let Some(problem) = number::node_problem(&self.dag, id) {
                return Some(NodeProblem::Wrong(problem));
            }
            if level > number::MOST_LEVELS {
                return Some(NodeProblem::TooNested);
            }
            if let Some(known) = self.levels.get_mut(usize::from(id)) {
                *known = level;
            }
        }
        None
    }

    /// The node of a part of a formula.
    pub(super) fn expression(&mut self, formula: &'d Expression, scope: Scope) -> Option<Value> {
        self.spend(1, formula)?;
        if self.depth >= DEEPEST {
            self.too_long(formula, "its functions and sums are nested too deeply");
            return None;
        }
        self.depth += 1;
        let value = self.kind(formula, scope);
        self.depth -= 1;
        value
    }

    fn kind(&mut self, formula: &'d Expression, scope: Scope) -> Option<Value> {
        match &formula.kind {
            ExpressionKind::Number { value, .. } => Some(self.constant(value)),
            ExpressionKind::Name(ident) => self.name(ident, scope),
            ExpressionKind::Parenthesised(inner) => self.expression(inner, scope),
            ExpressionKind::Element { group, index } => self.element(formula, group, index, scope),
            ExpressionKind::Sum {
                variable,
                range,
                term,
            } => self.sum(formula, variable, range, term, scope),
            ExpressionKind::Negative(operand) => {
                let operand = self.expression(operand, scope)?;
                Some(Value {
                    id: self.dag.neg(operand.id),
                    number: operand.number.map(|number| -number),
                })
            }
            ExpressionKind::Call {
                function,
                arguments,
            } => self.call(formula, function, arguments, scope),
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } => {
                // both, so that errors on both sides are found
                let of_left = self.expression(left, scope);
                let of_right = self.expression(right, scope);
                let (left, value) = (of_left?, of_right?);
                if *operator == Operator::Divide && self.is_zero(value, right)? {
                    self.division_by_zero(formula, right);
                    return None;
                }
                self.operation(formula, *operator, left, value)
            }
        }
    }

    /// An exact constant.
    pub(super) fn constant(&mut self, value: &Rational) -> Value {
        Value {
            id: self.dag.constant(value.clone()),
            number: Some(number::double(value)),
        }
    }

    /// `left operator right`, in `formula`; a divisor is known not to be zero.
    pub(super) fn operation(
        &mut self,
        formula: &'d Expression,
        operator: Operator,
        left: Value,
        right: Value,
    ) -> Option<Value> {
        if operator == Operator::Remainder {
            return self.remainder(formula, left, right);
        }
        let both = left.number.zip(right.number);
        let number = both.map(|(left, right)| number::operation(operator, left, right));
        let problem = match (number, both) {
            (Some(number), Some((left, right))) if !number.is_finite() => {
                Some(number::operation_problem(operator, left, right))
            }
            _ if operator == Operator::Power => number::power_problem(&self.dag, left, right),
            _ => number::size_problem(&self.dag, left, right),
        };
        if let Some((code, message)) = problem
            // an argument that is not known yet may turn out to be a number
            && !self.is_unknown(left.id)
            && !self.is_unknown(right.id)
        {
            self.report_turn(code, formula.extent, message);
            return None;
        }
        self.spend(number::work(&self.dag, left, right), formula)?;
        let dag = &mut self.dag;
        let id = match operator {
            Operator::Add => dag.add(left.id, right.id),
            Operator::Subtract => dag.sub(left.id, right.id),
            Operator::Multiply => dag.mul(left.id, right.id),
            Operator::Divide => dag.div(left.id, right.id),
            // its exact value would be too long
            _ if number::is_long_power(dag, left, right) => {
                dag.insert(Math::Pow([left.id, right.id]))
            }
            _ => dag.pow(left.id, right.id),
        };
        // 0·x and x^0 are numbers; an exact value is better than what was carried along
        let number = match dag.as_constant(id) {
            Some(value) => Some(number::double(value)),
            None => number,
        };
        Some(Value { id, number })
    }

    /// `left % right`, of integers.
    fn remainder(&mut self, formula: &'d Expression, left: Value, right: Value) -> Option<Value> {
        let (a, b) = (self.dag.as_integer(left.id), self.dag.as_integer(right.id));
        if let (Some(a), Some(b)) = (a, b) {
            let Some(remainder) = a.checked_rem_euclid(b) else {
                let message = format!("`{formula}` divides by zero");
                self.report_turn(codes::DIVISION_BY_ZERO, formula.extent, message);
                return None;
            };
            return Some(Value {
                id: self.dag.integer(remainder),
                number: Some(remainder as f64),
            });
        }
        if let Some(unknown) = self.unknown_among(&[left.id, right.id]) {
            return Some(unknown);
        }
        let message = format!(
            "`%` is for integers that are known when the system is compiled, as in `q[(i + 1) % 3]`; in `{formula}` it is not"
        );
        self.report_turn(codes::REMAINDER, formula.extent, message);
        None
    }

    /// Whether a divisor is zero whatever the variables are; nothing is returned if that is
    /// too much to find out.
    fn is_zero(&mut self, divisor: Value, place: &Expression) -> Option<bool> {
        if self.dag.as_constant(divisor.id).is_some() {
            return Some(self.dag.is_zero(divisor.id));
        }
        if self.samples.is_not_zero(&self.dag, divisor.id) {
            return Some(false);
        }
        if let Some(&known) = self.divisors.get(&divisor.id) {
            return Some(known);
        }
        let size = self.dag.reachable([divisor.id]).len();
        let mut is_zero = false;
        if size <= LARGEST_DIVISOR {
            self.spend(PROOF + 10 * size, place)?;
            is_zero = is_proved_zero(&self.dag, divisor.id);
        }
        self.divisors.insert(divisor.id, is_zero);
        Some(is_zero)
    }

    fn division_by_zero(&mut self, formula: &'d Expression, divisor: &Expression) {
        let message = match &divisor.kind {
            ExpressionKind::Number { .. } => "division by zero".to_string(),
            _ => format!(
                "division by `{}`, which is zero",
                divisor.inside_parentheses()
            ),
        };
        self.report_turn(codes::DIVISION_BY_ZERO, formula.extent, message);
    }
}
