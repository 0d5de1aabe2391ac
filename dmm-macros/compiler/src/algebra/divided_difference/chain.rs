//! The chain of local rules: backwards from the root, as in reverse accumulation of a gradient,
//! to which the coefficients reduce where the ends coincide. The argument Δu of `sinc` and its
//! like is chained forwards, Δu = Σ wᵢ Δuᵢ down to differences of variables, because u₁ − u₀
//! itself would cancel.

use std::collections::HashMap;

use super::super::{Dag, Id, Math, Name};
use super::ends::Ends;

/// A local weight wᵢ = `factor`/`divisor` in Δu = Σ wᵢ Δuᵢ.
pub(super) struct Weight {
    pub(super) factor: Id,
    pub(super) divisor: Option<Id>,
}

impl Weight {
    pub(super) fn factor(factor: Id) -> Self {
        Self {
            factor,
            divisor: None,
        }
    }

    pub(super) fn quotient(factor: Id, divisor: Id) -> Self {
        Self {
            factor,
            divisor: Some(divisor),
        }
    }

    pub(super) fn negated(self, dag: &mut Dag) -> Self {
        Self {
            factor: dag.neg(self.factor),
            ..self
        }
    }

    pub(super) fn times(&self, dag: &mut Dag, coefficient: Id) -> Id {
        let product = dag.mul(coefficient, self.factor);
        match self.divisor {
            Some(divisor) => dag.div(product, divisor),
            None => product,
        }
    }
}

/// What is formed over the two ends of a step.
pub(super) struct Step<'a> {
    pub(super) dag: &'a mut Dag,
    pub(super) ends: Ends,
    differences: HashMap<Id, Id>,
    means: HashMap<Id, Id>,
}

impl<'a> Step<'a> {
    /// The step over which `root` changes with `variables`.
    pub(super) fn new(dag: &'a mut Dag, root: Id, variables: &[Name]) -> Self {
        let ends = Ends::new(dag, root, variables);
        Self {
            dag,
            ends,
            differences: HashMap::new(),
            means: HashMap::new(),
        }
    }

    /// Reverse accumulation: the contributions to the coefficient of every variable.
    pub(super) fn accumulate(&mut self, root: Id) -> HashMap<Name, Vec<Id>> {
        let mut contributions: HashMap<Id, Vec<Id>> = HashMap::new();
        let mut coefficients: HashMap<Name, Vec<Id>> = HashMap::new();
        contributions.insert(root, vec![self.dag.integer(1)]);
        for id in self.ends.order.clone().into_iter().rev() {
            let Some(terms) = contributions.remove(&id) else {
                continue;
            };
            if let Math::Variable(name) = &self.dag[id] {
                coefficients.insert(name.clone(), terms);
                continue;
            }
            // parents come last first: reversed, a sum reads in the order of the formula
            let coefficient = self.dag.sum(terms.into_iter().rev());
            for (child, weight) in self.weights(id).into_iter().rev() {
                let term = weight.times(self.dag, coefficient);
                contributions.entry(child).or_default().push(term);
            }
        }
        coefficients
    }

    /// Δu, chained to differences of variables.
    pub(super) fn difference(&mut self, u: Id) -> Id {
        if let Some(&known) = self.differences.get(&u) {
            return known;
        }
        let difference = match &self.dag[u] {
            _ if !self.ends.vary(u) => self.dag.integer(0),
            Math::Variable(_) => {
                let [start, end] = self.ends.of(u);
                self.dag.sub(end, start)
            }
            _ => {
                let mut terms = Vec::new();
                for (child, weight) in self.weights(u) {
                    let difference = self.difference(child);
                    terms.push(weight.times(self.dag, difference));
                }
                self.dag.sum(terms)
            }
        };
        self.differences.insert(u, difference);
        difference
    }

    /// Δu/2
    pub(super) fn half_difference(&mut self, u: Id) -> Id {
        let half = self.dag.fraction(1, 2);
        let difference = self.difference(u);
        self.dag.mul(half, difference)
    }

    /// ū; the mean of an affine expression is the expression of the means.
    pub(super) fn mean(&mut self, u: Id) -> Id {
        if !self.ends.vary(u) {
            return u;
        }
        if let Some(&known) = self.means.get(&u) {
            return known;
        }
        let mean = match self.dag[u].clone() {
            Math::Add([v, w]) => {
                let [v, w] = [self.mean(v), self.mean(w)];
                self.dag.add(v, w)
            }
            Math::Sub([v, w]) => {
                let [v, w] = [self.mean(v), self.mean(w)];
                self.dag.sub(v, w)
            }
            Math::Neg(v) => {
                let v = self.mean(v);
                self.dag.neg(v)
            }
            Math::Mul([v, w]) if !self.ends.vary(v) || !self.ends.vary(w) => {
                let [v, w] = [self.mean(v), self.mean(w)];
                self.dag.mul(v, w)
            }
            Math::Div([v, w]) if !self.ends.vary(w) => {
                let v = self.mean(v);
                self.dag.div(v, w)
            }
            _ => {
                let [start, end] = self.ends.of(u);
                self.dag.mean(end, start)
            }
        };
        self.means.insert(u, mean);
        mean
    }
}
