//! The contents of a region, or what all regions share: a vector field and conserved quantities.

use std::collections::BTreeMap;

use proc_macro2::Ident;
use quote::format_ident;

use super::names::Kind;
use super::{Allowed, Resolver};
use crate::algebra::Id;
use crate::diagnostics::Extent;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Claim, Conserved};
use crate::syntax::{ConservedItem, Definition, Derivative, Item};

/// A vector field and its conserved quantities while they are read.
#[derive(Clone)]
pub(super) struct Body {
    /// The name of the region; nothing of what stands outside of regions.
    pub(super) region: Option<Ident>,
    /// By state: its rate.
    pub(super) field: Vec<Option<Component>>,
    pub(super) conserved: Vec<Conserved>,
    /// Indices of states, (q, p).
    pub(super) canonical: Vec<(usize, usize)>,
    /// The names of the conserved quantities, and whether all regions share them.
    seen: BTreeMap<String, bool>,
    /// Whether a rate was given to an unknown state: then the state without one was meant.
    pub(super) has_unknown_state: bool,
}

/// The rate of a state.
#[derive(Clone)]
pub(super) struct Component {
    /// Its formula, if that is in order.
    pub(super) rate: Option<(Id, Extent)>,
    /// The Hamiltonian that it comes from.
    pub(super) hamiltonian: Option<String>,
    /// Whether all regions share it.
    is_shared: bool,
    /// Whether it was only meant to be given, probably.
    is_guess: bool,
}

impl Body {
    /// Without items, of a system with this many states.
    pub(super) fn new(states: usize) -> Self {
        Self {
            region: None,
            field: vec![None; states],
            conserved: Vec::new(),
            canonical: Vec::new(),
            seen: BTreeMap::new(),
            has_unknown_state: false,
        }
    }

    /// What all regions share, as the beginning of the region `ident`.
    pub(super) fn in_region(&self, ident: &Ident) -> Self {
        Self {
            region: Some(ident.clone()),
            ..self.clone()
        }
    }

    fn within(&self) -> String {
        match &self.region {
            Some(region) => format!(" in the region `{region}`"),
            None => String::new(),
        }
    }
}

impl<'d> Resolver<'d> {
    /// The items of a block; its `let`s are declared before.
    pub(super) fn items(&mut self, items: &[&'d Item], body: &mut Body) {
        for item in items {
            if let Item::Let(definition) = item {
                self.scope
                    .names
                    .declare_in_region(&definition.ident, self.reporter.diagnostics);
            }
        }
        items.iter().for_each(|item| self.item(item, body));
    }

    /// An item of a region, or of a loop in it.
    pub(super) fn item(&mut self, item: &'d Item, body: &mut Body) {
        match item {
            Item::Let(definition) => self.define(definition, Kind::Let, Allowed::All),
            Item::Derivative(item) => self.derivative(item, body),
            Item::Conserved(item) => self.conserved(item, body),
            Item::Hamiltonian(item) => self.hamiltonian(item, body),
            Item::For(item) => self.for_item(item, body),
            Item::Event(event) => {
                let region = body.region.clone();
                self.event(event, region.as_ref());
            }
            // these stand at the top level only
            Item::State(_)
            | Item::Parameter(_)
            | Item::Constant(_)
            | Item::Function(_)
            | Item::Discrete(_)
            | Item::Interface(_)
            | Item::Sliding(_)
            | Item::Region(_) => {}
        }
    }

    fn derivative(&mut self, item: &'d Derivative, body: &mut Body) {
        let formula = self.formula(&item.formula, Allowed::All);
        let rate = formula.map(|formula| (formula.id, item.formula.extent));
        let found = self.target(&item.target, false, body);
        if self.scope.names.is_rehearsal() && found.is_right && !self.reporter.is_quiet {
            return;
        }
        for state in found.states {
            if found.is_right {
                self.give(body, state, rate, None, item.target.extent);
            } else {
                guess(body, state);
            }
        }
        if self.reporter.is_quiet {
            // a loop that is wrong was probably meant to give all of them
            self.guess_group(&item.target.ident.to_string(), body);
        }
    }

    fn guess_group(&self, group: &str, body: &mut Body) {
        if let Some(&(first, count)) = self.regions.state_groups.get(group) {
            (first..first + count.unwrap_or(1)).for_each(|state| guess(body, state));
        }
    }

    /// Takes note of the rate of a state.
    pub(super) fn give(
        &mut self,
        body: &mut Body,
        state: usize,
        rate: Option<(Id, Extent)>,
        hamiltonian: Option<&str>,
        place: Extent,
    ) {
        let is_shared = body.region.is_none();
        let Some(slot) = body.field.get_mut(state) else {
            return;
        };
        match slot {
            Some(earlier) if !earlier.is_guess => {
                let earlier = earlier.clone();
                self.given_twice(body, state, &earlier, hamiltonian, place);
                // another element was meant, probably
                if let Some(ident) = self.regions.states.get(state).map(|state| &state.ident) {
                    self.guess_group(&ident.to_string(), body);
                }
            }
            _ => {
                *slot = Some(Component {
                    rate,
                    hamiltonian: hamiltonian.map(str::to_owned),
                    is_shared,
                    is_guess: false,
                });
            }
        }
    }

    fn given_twice(
        &mut self,
        body: &Body,
        state: usize,
        earlier: &Component,
        hamiltonian: Option<&str>,
        place: Extent,
    ) {
        if self.reporter.is_quiet {
            return;
        }
        let Some(name) = self
            .regions
            .states
            .get(state)
            .map(|state| state.name.clone())
        else {
            return;
        };
        let shared = if earlier.is_shared && body.region.is_some() {
            " of all regions"
        } else {
            ""
        };
        if !shared.is_empty() && !self.reporter.repeated.insert(format!("der({name})")) {
            return;
        }
        let within = format!("{}{}", body.within(), self.scope.turn(", with"));
        let (code, message) = match (earlier.hamiltonian.as_deref(), hamiltonian) {
            (None, None) if shared.is_empty() => (
                codes::DERIVATIVE_TWICE,
                format!(
                    "`der({name})` is given twice{}: write one formula with all its terms",
                    within
                ),
            ),
            (None, None) => (
                codes::ALREADY_SHARED,
                format!(
                    "`der({name})` stands at the top level already, for all regions: it cannot be given again{}",
                    within
                ),
            ),
            (Some(one), Some(other)) if one == other => (
                codes::PAIRED_TWICE,
                format!("`{name}` stands twice in the pairs of `{one}`"),
            ),
            (Some(one), Some(other)) => (
                codes::PAIRED_TWICE,
                format!("`{name}` is in a pair of `{other}` and in one of `{one}`{shared}"),
            ),
            (Some(h), None) => (
                codes::PAIRED_AND_DERIVATIVE,
                format!(
                    "`{name}` is in a pair of the hamiltonian `{h}`{shared}, which gives `der({name})`: remove one of them"
                ),
            ),
            (None, Some(h)) => (
                codes::PAIRED_AND_DERIVATIVE,
                format!(
                    "`{name}` is in a pair of the hamiltonian `{h}` and has a `der`{shared}: remove one of them"
                ),
            ),
        };
        self.report(code, place, message);
    }

    fn conserved(&mut self, item: &'d ConservedItem, body: &mut Body) {
        let formula = self.formula(&item.definition.formula, Allowed::All);
        if self.scope.names.is_rehearsal() {
            return;
        }
        let Some(ident) = self.new_quantity(&item.definition, body) else {
            return;
        };
        if let Some(formula) = formula {
            let claim = if item.assumed {
                Claim::Assumed
            } else {
                Claim::Conserved
            };
            add_quantity(body, &item.definition, ident, formula.id, claim);
        }
    }

    /// The name of a conserved quantity, with the values of the loop variables around it
    /// (`energy_2`), if there is none of that name in `body`.
    pub(super) fn new_quantity(&mut self, item: &Definition, body: &mut Body) -> Option<Ident> {
        let mut ident = item.ident.clone();
        for (_, value) in self.scope.names.counters() {
            let sign = if value < 0.0 { "minus" } else { "" };
            ident = format_ident!("{ident}_{sign}{}", value.abs().to_string());
        }
        let is_shared = body.region.is_none();
        let (code, message) = match body.seen.insert(ident.to_string(), is_shared) {
            None => return Some(ident),
            Some(true) if !is_shared && !self.reporter.repeated.insert(ident.to_string()) => {
                return None;
            }
            Some(true) if !is_shared => (
                codes::ALREADY_SHARED,
                format!(
                    "`{ident}` is declared at the top level already, for all regions: it cannot be declared again{}",
                    body.within()
                ),
            ),
            Some(_) => (
                codes::CONSERVED_TWICE,
                format!(
                    "the conserved quantity `{ident}` is declared twice{}",
                    body.within()
                ),
            ),
        };
        self.report_turn(code, &item.ident, message);
        None
    }
}

/// Adds ψ to `body`.
pub(super) fn add_quantity(
    body: &mut Body,
    item: &Definition,
    ident: Ident,
    psi: Id,
    claim: Claim,
) {
    body.conserved.push(Conserved {
        attributes: item.attributes.clone(),
        ident,
        psi,
        span: item.formula.extent,
        claim,
    });
}

/// Takes note that the rate of a state was probably meant to be given.
pub(super) fn guess(body: &mut Body, state: usize) {
    let is_shared = body.region.is_none();
    if let Some(slot @ None) = body.field.get_mut(state) {
        *slot = Some(Component {
            rate: None,
            hamiltonian: None,
            is_shared,
            is_guess: true,
        });
    }
}
