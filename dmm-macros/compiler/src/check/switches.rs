//! Switches: what formulas have two values of, on either side of an interface of its own.
//!
//! `if a > b { u } else { v }` is s u + (1 − s) v, where s is 1 on the side a − b > 0 and 0 on the
//! other one, a constant of the mode. So there is one field, whatever the number of switches.

use std::collections::HashMap;

use quote::format_ident;

use super::{Allowed, Resolver, Value};
use crate::algebra::{Function, Id, Math, to_text};
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Interface, Model};
use crate::syntax::{Comparison, Expression, Relation};

/// The most switches of a system.
const MOST_SWITCHES: usize = 64;
/// The longest name of an interface that is a formula.
const LONGEST_NAME: usize = 60;

/// The functions that switch, with the numbers of their arguments.
const FUNCTIONS: [(&str, usize); 5] = [
    ("abs", 1),
    ("sign", 1),
    ("min", 2),
    ("max", 2),
    ("clamp", 3),
];

impl<'d> Resolver<'d> {
    /// `if a > b { then } else { otherwise }`
    pub(super) fn branch(
        &mut self,
        formula: &'d Expression,
        (condition, slides): (&'d Comparison, bool),
        [then, otherwise]: [&'d Expression; 2],
        allowed: Allowed,
    ) -> Option<Value> {
        // all of them, so that errors in each are found
        let [left, right, then_value, otherwise_value] =
            [&condition.left, &condition.right, then, otherwise]
                .map(|part| self.expression(part, allowed));
        let (left, right) = (left?, right?);
        let (then_value, otherwise_value) = (then_value?, otherwise_value?);
        let g = match condition.relation {
            Relation::Greater => self.difference(left, right),
            Relation::Less => self.difference(right, left),
        };
        let value = self.switch(formula, g, then_value, otherwise_value, true)?;
        let known = self.regions.interfaces.iter_mut().flatten();
        for interface in known.filter(|one| slides && one.switching_function == g.id) {
            interface.slides = true;
        }
        Some(value)
    }

    /// `abs(u)` and the like, if `name` is such a function and nothing else.
    pub(super) fn switching_function(
        &mut self,
        formula: &'d Expression,
        name: &str,
        arguments: &'d [Expression],
        allowed: Allowed,
    ) -> Option<Option<Value>> {
        if self.scope.names.get(name).is_some() {
            return None;
        }
        let (_, count) = FUNCTIONS.iter().find(|(known, _)| *known == name)?;
        if arguments.len() != *count {
            let message = format!(
                "`{name}` takes {}, not {}",
                super::groups::counted(*count, "argument"),
                arguments.len()
            );
            self.report(codes::NUMBER_OF_ARGUMENTS, formula.extent, message);
            return Some(None);
        }
        let values = arguments
            .iter()
            .map(|argument| self.expression(argument, allowed));
        let values: Vec<Option<Value>> = values.collect();
        let values: Option<Vec<Value>> = values.into_iter().collect();
        Some(values.and_then(|values| match (name, &values[..]) {
            ("abs", &[u]) => {
                let opposite = self.opposite(u);
                self.switch(formula, u, u, opposite, false)
            }
            ("sign", &[u]) => {
                let one = self.integer_value(1);
                let minus_one = self.integer_value(-1);
                self.switch(formula, u, one, minus_one, false)
            }
            ("min", &[u, v]) => self.greatest(formula, u, v, false),
            ("max", &[u, v]) => self.greatest(formula, u, v, true),
            ("clamp", &[u, low, high]) => {
                let above = self.greatest(formula, u, low, true)?;
                self.greatest(formula, above, high, false)
            }
            _ => None,
        }))
    }

    /// max(u, v) or min(u, v)
    fn greatest(
        &mut self,
        formula: &'d Expression,
        u: Value,
        v: Value,
        is_max: bool,
    ) -> Option<Value> {
        let g = self.difference(u, v);
        let (above, below) = if is_max { (u, v) } else { (v, u) };
        self.switch(formula, g, above, below, false)
    }

    /// u where g > 0, v where g < 0, of which each may have no value on the other side if they are
    /// `branches`.
    fn switch(
        &mut self,
        formula: &'d Expression,
        g: Value,
        u: Value,
        v: Value,
        are_branches: bool,
    ) -> Option<Value> {
        if let Some(number) = g.number {
            return Some(if number > 0.0 { u } else { v });
        }
        if let Some(unknown) = self.evaluator.unknown_among(&[g.id, u.id, v.id]) {
            return Some(unknown);
        }
        let depends_on = self.evaluator.dag.variables([g.id]);
        let states = &self.regions.states;
        let moves = depends_on.contains(&Model::time())
            || states.iter().any(|state| depends_on.contains(&state.name))
            || self.is_side(g.id);
        if !moves {
            let discrete = self.regions.discrete.iter();
            let mut discrete = discrete.filter(|one| depends_on.contains(&one.name));
            let message = match discrete.next() {
                Some(one) => format!(
                    "a discrete state decides here, which changes by events alone: write it as a factor, as in `{0}*u + (1 - {0})*v` where it is 1 or 0",
                    one.ident
                ),
                None => "what decides here depends neither on a state nor on `t`: declare two systems, or a parameter for each value".to_owned(),
            };
            self.report(codes::INTERFACE_CONSTANT, formula.extent, message);
            return None;
        }
        let side = self.side_of(formula, g.id)?;
        let (mut u, mut v) = (u.id, v.id);
        if are_branches {
            let dag = &mut self.evaluator.dag;
            let one = dag.integer(1);
            let other = dag.sub(one, side);
            (u, v) = (self.anywhere(u, side), self.anywhere(v, other));
        }
        Some(Value {
            id: self.evaluator.dag.blend(side, u, v),
            number: None,
        })
    }

    /// The variable that is 1 where g > 0 and 0 where g < 0.
    fn side_of(&mut self, formula: &'d Expression, g: Id) -> Option<Id> {
        let known = self.regions.interfaces.iter_mut().flatten();
        let mut known = known.filter(|one| one.switching_function == g);
        if let Some(interface) = known.next() {
            interface.is_switch = true;
            let name = interface.side.clone();
            return Some(self.evaluator.dag.variable(&name));
        }
        let switches = self.regions.interfaces.iter().flatten();
        let switches = switches.filter(|one| one.label.is_some()).count();
        if switches == MOST_SWITCHES {
            let message = format!("up to {MOST_SWITCHES} switches are supported");
            self.report(codes::INTERFACE_CONSTANT, formula.extent, message);
            return None;
        }
        let text = to_text(&self.evaluator.dag, g);
        let label = if text.chars().count() <= LONGEST_NAME {
            text
        } else {
            format!("switch {}", switches + 1)
        };
        let ident = format_ident!("switch_{}", switches + 1);
        let side = Model::side_of(&ident);
        let id = self.evaluator.dag.variable(&side);
        self.regions.interfaces.push(Some(Interface {
            attributes: Vec::new(),
            ident,
            label: Some(label),
            side,
            is_switch: true,
            slides: false,
            end: None,
            switching_function: g,
            span: formula.extent,
        }));
        Some(id)
    }

    /// Whether a formula depends on a switch.
    fn is_side(&self, id: Id) -> bool {
        let depends_on = self.evaluator.dag.variables([id]);
        let mut interfaces = self.regions.interfaces.iter().flatten();
        interfaces.any(|interface| depends_on.contains(&interface.side))
    }

    /// A branch that has a value on the other side too, where it is computed and counts nothing: with
    /// s = `side`, which is 1 where it counts and 0 elsewhere, what a root, a logarithm or a quotient
    /// has no value for is s u + (1 − s)/2 instead of u.
    fn anywhere(&mut self, branch: Id, side: Id) -> Id {
        let limited: HashMap<Id, Id> = (self.evaluator.dag.reachable([branch]).into_iter())
            .filter_map(|id| Some((id, self.limited(id)?)))
            .collect();
        let dag = &mut self.evaluator.dag;
        let half = dag.fraction(1, 2);
        dag.with_parts(branch, &limited, |dag, part| dag.blend(side, part, half))
    }

    /// The part of an operation that it may have no value for, if that part moves.
    fn limited(&self, id: Id) -> Option<Id> {
        let dag = &self.evaluator.dag;
        let varies = |id: Id| {
            let depends_on = dag.variables([id]);
            let states = &self.regions.states;
            depends_on.contains(&Model::time())
                || states.iter().any(|state| depends_on.contains(&state.name))
        };
        match dag[id] {
            Math::Call(
                Function::Sqrt | Function::Ln | Function::Asin | Function::Acos | Function::Tan,
                a,
            ) => varies(a).then_some(a),
            Math::Div([_, b]) => varies(b).then_some(b),
            Math::Pow([a, b]) => {
                let is_limited = dag.as_integer(b).is_none_or(|n| n < 0);
                (is_limited && (varies(a) || varies(b))).then_some(a)
            }
            _ => None,
        }
    }

    fn difference(&mut self, u: Value, v: Value) -> Value {
        let both = u.number.zip(v.number);
        Value {
            id: self.evaluator.dag.sub(u.id, v.id),
            number: both.map(|(u, v)| u - v),
        }
    }

    fn opposite(&mut self, u: Value) -> Value {
        Value {
            id: self.evaluator.dag.neg(u.id),
            number: u.number.map(|number| -number),
        }
    }

    fn integer_value(&mut self, value: i64) -> Value {
        Value {
            id: self.evaluator.dag.integer(value),
            number: Some(value as f64),
        }
    }
}
