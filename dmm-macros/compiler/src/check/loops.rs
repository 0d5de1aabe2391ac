//! Loops: `sum(i in a..b, term)` and `for i in a..b { … }`, written out turn by turn.
//!
//! What is wrong in every turn is reported in the first one. A range that is empty, or not
//! known yet, gets one turn with an unknown loop variable, so that its formulas are checked.

use std::ops;

use proc_macro2::Ident;

use super::body::Body;
use super::groups::Integer;
use super::names::{Kind, is_meant_to_be_unused};
use super::{Allowed, Resolver, Value};
use crate::diagnostics::catalogue::check as codes;
use crate::syntax::{Expression, ExpressionKind, ForItem, Operator, Range};

/// The most turns of one loop.
const MOST_TURNS: i64 = 4096;

/// The turns of a loop.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Turns {
    /// The loop variable runs through these integers.
    Known(ops::Range<i64>),
    /// A bound depends on an argument of the function that is being declared.
    Unknown,
}

impl<'d> Resolver<'d> {
    /// `sum(variable in range, term)`
    pub(super) fn sum(
        &mut self,
        formula: &'d Expression,
        variable: &'d Ident,
        range: &'d Range,
        term: &'d Expression,
        allowed: Allowed,
    ) -> Option<Value> {
        let zero = Value {
            id: self.evaluator.dag.integer(0),
            number: Some(0.0),
        };
        let mut total = Some(zero);
        let turns = self.turns(variable, range, formula, &mut |resolver| {
            // what was wrong in one turn would be wrong in the next ones
            total = match total {
                Some(total) => resolver
                    .expression(term, allowed)
                    .and_then(|term| resolver.operation(formula, Operator::Add, total, term)),
                None => None,
            };
        });
        match turns? {
            Turns::Unknown => total.map(|_| self.evaluator.unknown()),
            Turns::Known(range) if range.is_empty() => total.map(|_| zero),
            Turns::Known(_) => total,
        }
    }

    /// `for variable in range { … }`
    pub(super) fn for_item(&mut self, item: &'d ForItem, body: &mut Body) {
        let mut is_wrong = vec![false; item.items.len()];
        self.turns(
            &item.variable,
            &item.range,
            &item.range.end,
            &mut |resolver| {
                for (inner, is_wrong) in item.items.iter().zip(&mut is_wrong) {
                    if *is_wrong {
                        resolver.quietly(|resolver| resolver.item(inner, body));
                    } else {
                        let before = resolver.reporter.diagnostics.len();
                        resolver.item(inner, body);
                        *is_wrong = resolver.reporter.diagnostics.len() > before;
                    }
                }
            },
        );
    }

    /// Runs `turn` with each value of the loop variable; nothing is returned if something is
    /// wrong with the loop itself.
    fn turns(
        &mut self,
        variable: &'d Ident,
        range: &'d Range,
        place: &'d Expression,
        turn: &mut dyn FnMut(&mut Self),
    ) -> Option<Turns> {
        let turns = self.range(range);
        if let Some((code, message)) = self.scope.names.counter_problem(variable) {
            self.report(code, variable, message);
            self.quietly(|resolver| resolver.one_turn(variable, None, turn));
            return None;
        }
        let before = self.reporter.diagnostics.len();
        let is_used = match &turns {
            Some(Turns::Known(range)) if !range.is_empty() => {
                let mut is_used = false;
                for value in range.clone() {
                    self.spend(1, place)?;
                    is_used |= self.one_turn(variable, Some(value), turn);
                }
                is_used
            }
            // `turns` is nothing if a bound is wrong: then the index would be, too
            None => {
                self.quietly(|resolver| resolver.one_turn(variable, None, turn));
                return None;
            }
            _ => self.one_turn(variable, None, turn),
        };
        if !is_used && self.reporter.diagnostics.len() == before && !is_meant_to_be_unused(variable)
        {
            let message = format!(
                "the loop variable `{variable}` is never used: every turn is the same; call it `_{variable}` if that is meant"
            );
            // a loop around this one comes here in each of its turns
            if self.reporter.warned.insert(std::ptr::from_ref(variable)) {
                self.warn(codes::UNUSED, variable, message);
            }
        }
        turns
    }

    /// Whether the loop variable was used in this turn.
    fn one_turn(
        &mut self,
        variable: &Ident,
        value: Option<i64>,
        turn: &mut dyn FnMut(&mut Self),
    ) -> bool {
        let value = match value {
            Some(value) => Value {
                id: self.evaluator.dag.integer(value),
                number: Some(value as f64),
            },
            None => self.evaluator.unknown(),
        };
        self.scope.names.push_local(variable, Kind::Counter, value);
        turn(self);
        self.scope.names.pop_local()
    }

    fn range(&mut self, range: &'d Range) -> Option<Turns> {
        let start = self.integer(&range.start, "the bound of a loop");
        let end = self.integer(&range.end, "the bound of a loop");
        let (Integer::Known(first), Integer::Known(last)) = (start?, end?) else {
            return Some(Turns::Unknown);
        };
        let place = range.start.extent.to(range.end.extent);
        if last < first && is_literal(&range.start) && is_literal(&range.end) {
            let message = format!("the range `{range}` runs backwards, so that it is empty");
            self.report(codes::LOOP_BACKWARDS, place, message);
            return None;
        }
        if last.saturating_sub(first) > MOST_TURNS {
            let message = format!(
                "the range `{range}` has {} turns: up to {MOST_TURNS} are supported",
                last.saturating_sub(first)
            );
            self.report_turn(codes::TOO_LONG, place, message);
            return None;
        }
        Some(Turns::Known(first..last))
    }
}

fn is_literal(bound: &Expression) -> bool {
    match &bound.kind {
        ExpressionKind::Number { .. } => true,
        ExpressionKind::Negative(operand) => is_literal(operand),
        _ => false,
    }
}
