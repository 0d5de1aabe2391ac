//! Nodes and numbers: the value of a formula as a node of the DAG, and what is known of it.

use std::collections::{BTreeMap, BTreeSet};

use super::number::{self, Problem};
use super::samples::Samples;
use crate::algebra::{Dag, Id, Math, Name, Rational};
use crate::syntax::Operator;

/// A resolved formula.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value {
    /// Its node.
    pub(super) id: Id,
    /// Its floating-point value if it is free of variables.
    pub(super) number: Option<f64>,
}

/// What is wrong with a node of a formula.
pub(super) enum NodeProblem {
    /// Whatever it is a part of.
    Wrong(Problem),
    /// It is nested too deeply to be derived from.
    TooNested,
}

/// The nodes of all formulas.
#[derive(Debug, Default)]
pub(super) struct Evaluator {
    pub(super) dag: Dag,
    /// Variables that stand for what is not known so far.
    unknowns: BTreeSet<Id>,
    samples: Samples,
    /// By divisor that is not clear from the samples: whether it is zero.
    pub(super) divisors: BTreeMap<Id, bool>,
    /// By node: how deep it is nested, if it and all below it was found to be in order; else 0.
    levels: Vec<usize>,
}

impl Evaluator {
    /// An exact constant.
    pub(super) fn constant(&mut self, value: &Rational) -> Value {
        Value {
            id: self.dag.constant(value.clone()),
            number: Some(number::double(value)),
        }
    }

    /// Why `left operator right` cannot be evaluated or derived from.
    pub(super) fn operation_problem(
        &self,
        operator: Operator,
        left: Value,
        right: Value,
    ) -> Option<Problem> {
        if let Some((left, right)) = left.number.zip(right.number)
            && !number::operation(operator, left, right).is_finite()
        {
            return Some(number::operation_problem(operator, left, right));
        }
        match operator {
            Operator::Power => number::power_problem(&self.dag, left, right),
            _ => number::size_problem(&self.dag, left, right),
        }
    }

    /// `left operator right`, of which nothing is wrong.
    pub(super) fn operation(&mut self, operator: Operator, left: Value, right: Value) -> Value {
        let both = left.number.zip(right.number);
        let number = both.map(|(left, right)| number::operation(operator, left, right));
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
        Value { id, number }
    }

    /// Whether a divisor is zero, if that is clear or was found out before.
    pub(super) fn is_known_zero(&mut self, divisor: Id) -> Option<bool> {
        if self.dag.as_constant(divisor).is_some() {
            return Some(self.dag.is_zero(divisor));
        }
        if self.samples.is_not_zero(&self.dag, divisor) {
            return Some(false);
        }
        self.divisors.get(&divisor).copied()
    }

    /// What is wrong with a node below `root`; those that were examined before are in order.
    pub(super) fn node_problem(&mut self, root: Id) -> Option<NodeProblem> {
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

    /// A value of which nothing is known so far: that of an argument in the formula of a
    /// function, or what depends on it.
    pub(super) fn unknown(&mut self) -> Value {
        // no identifier of a declaration has a space
        let name = Name::new(&format!("unknown {}", self.unknowns.len()));
        let id = self.dag.variable(&name);
        self.unknowns.insert(id);
        Value { id, number: None }
    }

    /// Whether `id` depends on anything unknown.
    pub(super) fn is_unknown(&self, id: Id) -> bool {
        !self.unknowns.is_empty()
            && (self.unknowns.contains(&id)
                || (self.dag.reachable([id]).iter()).any(|node| self.unknowns.contains(node)))
    }

    /// An unknown value if one of `ids` is unknown.
    pub(super) fn unknown_among(&mut self, ids: &[Id]) -> Option<Value> {
        let is_unknown = ids.iter().any(|&id| self.is_unknown(id));
        is_unknown.then(|| self.unknown())
    }
}
