//! Hamiltonians: `hamiltonian H = … in (q, p), …` gives the canonical equations
//!
//! ```text
//! q̇ = ∂H/∂p,      ṗ = −∂H/∂q
//! ```
//!
//! of each pair, and the conserved quantity H unless it depends on the time explicitly:
//! dH/dt = ∂ₜH + Σ(∂H/∂q·∂H/∂p − ∂H/∂p·∂H/∂q) = ∂ₜH. A state outside of the pairs of which H
//! depends adds a term that is not zero by construction, so that then H has to be proved.

use std::collections::BTreeSet;

use super::body::{Body, add_quantity, guess};
use super::groups::counted;
use super::{Allowed, Resolver};
use crate::algebra::{Id, Name, gradient};
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Claim, Model};
use crate::syntax::{HamiltonianItem, Target};

impl<'d> Resolver<'d> {
    /// `hamiltonian H = formula in (q, p), …`
    pub(super) fn hamiltonian(&mut self, item: &'d HamiltonianItem, body: &mut Body) {
        let definition = &item.definition;
        let energy = self.formula(&definition.formula, Allowed::All);
        let energy = energy.map(|energy| energy.id);
        let Some(ident) = self.new_quantity(definition, body) else {
            // the pairs were given before under the same name
            return self.quietly(|resolver| {
                resolver.pairs(item, None, body);
            });
        };
        let before = self.reporter.diagnostics.len();
        let pairs = self.pairs(item, energy, body);
        let is_right = self.reporter.diagnostics.len() == before;
        if let Some(energy) = energy.filter(|_| is_right)
            && let Some(claim) = self.claim(energy, &pairs)
        {
            add_quantity(body, definition, ident, energy, claim);
        }
    }

    /// Gives the rates of all pairs, which are returned.
    fn pairs(
        &mut self,
        item: &'d HamiltonianItem,
        energy: Option<Id>,
        body: &mut Body,
    ) -> Vec<(usize, usize)> {
        let mut pairs = Vec::new();
        for (q, p) in &item.pairs {
            pairs.extend(self.pair(q, p, body).into_iter().map(|pair| (pair, q, p)));
        }
        let states: Vec<usize> = (pairs.iter()).flat_map(|&((q, p), ..)| [q, p]).collect();
        let rates = self.canonical_rates(energy, &states);
        let extent = item.definition.formula.extent;
        let name = item.definition.ident.to_string();
        let rates = rates.chunks_exact(2);
        for (&((q, p), at_q, at_p), rates) in pairs.iter().zip(rates) {
            let [by_q, by_p] = [rates.first(), rates.last()].map(|rate| rate.copied().flatten());
            let of_q = by_p.map(|rate| (rate, extent));
            let of_p = by_q.map(|rate| (self.evaluator.dag.neg(rate), extent));
            let before = self.reporter.diagnostics.len();
            self.give(body, q, of_q, Some(&name), at_q.extent);
            if self.reporter.diagnostics.len() > before {
                // a pair that stands there twice is one mistake
                self.quietly(|resolver| resolver.give(body, p, of_p, Some(&name), at_p.extent));
            } else {
                self.give(body, p, of_p, Some(&name), at_p.extent);
            }
        }
        let pairs: Vec<(usize, usize)> = pairs.into_iter().map(|(pair, ..)| pair).collect();
        body.canonical.extend(&pairs);
        pairs
    }

    /// ∂H/∂x of these states; nothing if H is wrong.
    fn canonical_rates(&mut self, energy: Option<Id>, states: &[usize]) -> Vec<Option<Id>> {
        let Some(energy) = energy else {
            return vec![None; states.len()];
        };
        let names: Vec<Name> = states
            .iter()
            .filter_map(|&state| self.regions.states.get(state))
            .map(|state| state.name.clone())
            .collect();
        let gradient = gradient(&mut self.evaluator.dag, energy, &names);
        gradient.into_iter().map(Some).collect()
    }

    /// The states of a pair of targets, of groups element by element.
    fn pair(&mut self, q: &'d Target, p: &'d Target, body: &mut Body) -> Vec<(usize, usize)> {
        let [of_q, of_p] = [q, p].map(|target| self.target(target, true, body));
        let is_right = of_q.is_right && of_p.is_right;
        if is_right && of_q.states == of_p.states {
            let message = format!(
                "`{q}` is in a pair with itself: a coordinate and its momentum make a pair"
            );
            self.report(codes::PAIRED_TWICE, q.extent.to(p.extent), message);
            of_q.states.iter().for_each(|&state| guess(body, state));
            // the other state of this pair is not known
            body.has_unknown_state = true;
            return Vec::new();
        }
        if is_right && of_q.states.len() == of_p.states.len() {
            return of_q.states.into_iter().zip(of_p.states).collect();
        }
        if is_right {
            let message = format!(
                "`{q}` has {} and `{p}` has {}: a coordinate and its momentum make a pair",
                counted(of_q.states.len(), "element"),
                counted(of_p.states.len(), "element")
            );
            self.report(codes::PAIR_LENGTHS, q.extent.to(p.extent), message);
        }
        let all = of_q.states.into_iter().chain(of_p.states);
        all.for_each(|state| guess(body, state));
        Vec::new()
    }

    /// On what grounds H is conserved; nothing if it depends on the time.
    fn claim(&self, energy: Id, pairs: &[(usize, usize)]) -> Option<Claim> {
        let depends_on = self.evaluator.dag.variables([energy]);
        if depends_on.contains(&Model::time()) {
            return None;
        }
        let paired: BTreeSet<usize> = pairs.iter().flat_map(|&(q, p)| [q, p]).collect();
        let mut others = (self.regions.states.iter().enumerate())
            .filter(|(index, _)| !paired.contains(index))
            .map(|(_, state)| &state.name);
        if others.any(|name| depends_on.binary_search(name).is_ok()) {
            return Some(Claim::Conserved);
        }
        Some(Claim::Hamiltonian)
    }
}
