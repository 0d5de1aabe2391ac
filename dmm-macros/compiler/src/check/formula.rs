//! Formulas → nodes of the DAG.
//!
//! Nodes are made by the DAG's constructors alone, which fold exact constants; beside each node
//! without variables its floating-point value is carried, so that ln(−1), 1/0 or exp(1000) is
//! found where it stands, and not by a trajectory that ends in NaN.

use super::evaluator::NodeProblem;
use super::number;
use super::{Allowed, Resolver, Value};
use crate::algebra::is_proved_zero;
use crate::diagnostics::catalogue::check as codes;
use crate::syntax::{Expression, ExpressionKind, Operator};

/// Divisors of more nodes are not examined for being zero.
const LARGEST_DIVISOR: usize = 1_000;
/// The work of the proof that a divisor is zero, in nodes.
const PROOF: usize = 200;

impl<'d> Resolver<'d> {
    /// The node of `formula`. All that is wrong is reported; nothing is returned if something
    /// was.
    pub(super) fn formula(&mut self, formula: &'d Expression, allowed: Allowed) -> Option<Value> {
        let value = self.expression(formula, allowed)?;
        match self.evaluator.node_problem(value.id) {
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

    /// The node of a part of a formula.
    pub(super) fn expression(
        &mut self,
        formula: &'d Expression,
        allowed: Allowed,
    ) -> Option<Value> {
        self.spend(1, formula)?;
        if self.budget.enter().is_none() {
            self.too_long(formula, "its functions and sums are nested too deeply");
            return None;
        }
        let value = self.kind(formula, allowed);
        self.budget.leave();
        value
    }

    fn kind(&mut self, formula: &'d Expression, allowed: Allowed) -> Option<Value> {
        match &formula.kind {
            ExpressionKind::Number { value, .. } => Some(self.evaluator.constant(value)),
            ExpressionKind::Name(ident) => self.name(ident, allowed),
            ExpressionKind::Parenthesised(inner) => self.expression(inner, allowed),
            ExpressionKind::Element { group, index } => {
                self.element(formula, group, index, allowed)
            }
            ExpressionKind::If {
                condition,
                slides,
                then,
                otherwise,
            } => {
                let parts = [then.as_ref(), otherwise.as_ref()];
                self.branch(formula, (condition, *slides), parts, allowed)
            }
            ExpressionKind::Sum {
                variable,
                range,
                term,
            } => self.sum(formula, variable, range, term, allowed),
            ExpressionKind::Negative(operand) => {
                let operand = self.expression(operand, allowed)?;
                Some(Value {
                    id: self.evaluator.dag.neg(operand.id),
                    number: operand.number.map(|number| -number),
                })
            }
            ExpressionKind::Call {
                function,
                arguments,
            } => self.call(formula, function, arguments, allowed),
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } => {
                // both, so that errors on both sides are found
                let of_left = self.expression(left, allowed);
                let of_right = self.expression(right, allowed);
                let (left, value) = (of_left?, of_right?);
                if *operator == Operator::Divide && self.is_zero(value, right)? {
                    self.division_by_zero(formula, right);
                    return None;
                }
                self.operation(formula, *operator, left, value)
            }
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
        if let Some((code, message)) = self.evaluator.operation_problem(operator, left, right)
            // an argument that is not known yet may turn out to be a number
            && !self.evaluator.is_unknown(left.id)
            && !self.evaluator.is_unknown(right.id)
        {
            self.report_turn(code, formula.extent, message);
            return None;
        }
        self.spend(number::work(&self.evaluator.dag, left, right), formula)?;
        Some(self.evaluator.operation(operator, left, right))
    }

    /// `left % right`, of integers.
    fn remainder(&mut self, formula: &'d Expression, left: Value, right: Value) -> Option<Value> {
        let (a, b) = (
            self.evaluator.dag.as_integer(left.id),
            self.evaluator.dag.as_integer(right.id),
        );
        if let (Some(a), Some(b)) = (a, b) {
            let Some(remainder) = a.checked_rem_euclid(b) else {
                let message = format!("`{formula}` divides by zero");
                self.report_turn(codes::DIVISION_BY_ZERO, formula.extent, message);
                return None;
            };
            return Some(Value {
                id: self.evaluator.dag.integer(remainder),
                number: Some(remainder as f64),
            });
        }
        if let Some(unknown) = self.evaluator.unknown_among(&[left.id, right.id]) {
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
        if let Some(known) = self.evaluator.is_known_zero(divisor.id) {
            return Some(known);
        }
        let size = self.evaluator.dag.reachable([divisor.id]).len();
        let mut is_zero = false;
        if size <= LARGEST_DIVISOR {
            self.spend(PROOF + 10 * size, place)?;
            is_zero = is_proved_zero(&self.evaluator.dag, divisor.id);
        }
        self.evaluator.divisors.insert(divisor.id, is_zero);
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
