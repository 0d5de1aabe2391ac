//! Declaration → model: every name resolved, every loop and function written out, every region
//! complete, every formula such that it can be evaluated.
//!
//! The stage is [`resolve`]. It checks that
//!
//! - names are declared once, in front of their use, and are used;
//! - constants, defaults, numbers of elements and indices depend on constants only;
//! - elements of groups exist, and groups are used by their elements;
//! - ẋ = fᵣ(t, x) is complete: in every region r each state has one `der` or is in one canonical
//!   pair (q, p) of a Hamiltonian, q̇ = ∂H/∂p and ṗ = −∂H/∂q;
//! - the regions are sign patterns of the switching functions that cover the space, without an
//!   overlap: with one interface g = 0 the two regions g > 0 and g < 0, without one the whole space;
//! - no formula divides by zero, leaves the real numbers, or overflows whatever the state is.
//!
//! A formula of which an error was reported yields nothing, and nothing that follows from its
//! absence is reported (see the module `report`).

mod advice;
mod body;
mod budget;
mod evaluator;
mod events;
mod formula;
mod functions;
mod groups;
mod hamiltonian;
mod kind;
mod lookup;
mod loops;
mod names;
mod number;
mod regions;
mod report;
mod samples;
mod scope;
mod sides;
mod switches;
mod targets;

#[cfg(test)]
mod tests;

use crate::algebra::Id;
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Interface, Model};
use crate::syntax::{Declaration, Definition, InterfaceItem, Item};
use budget::Budget;
use evaluator::{Evaluator, Value};
use groups::MOST_STATES;
use names::{Kind, Meaning};
use regions::Regions;
use report::Reporter;
use scope::Scope;

/// Resolves `declaration`. The model is there if nothing was added to `diagnostics`.
pub fn resolve(declaration: Declaration, diagnostics: &mut Diagnostics) -> Option<Model> {
    let before = diagnostics.len();
    let source = declaration.to_string();
    let mut resolver = Resolver::new(&declaration, diagnostics);
    resolver.top_level(&declaration);
    resolver.events(&declaration);
    let regions = resolver.regions(&declaration);
    resolver.unused();
    let Resolver {
        evaluator,
        regions:
            Regions {
                states,
                parameters,
                interfaces,
                discrete,
                events,
                sliding,
                ..
            },
        reporter: Reporter { diagnostics, .. },
        ..
    } = resolver;
    let is_right = diagnostics.len() == before;
    is_right.then(|| Model {
        attributes: declaration.attributes,
        visibility: declaration.visibility,
        name: declaration.name,
        dag: evaluator.dag,
        states,
        parameters,
        interfaces: interfaces.into_iter().flatten().collect(),
        discrete,
        events,
        regions,
        sliding,
        source,
    })
}

/// What has been resolved so far.
struct Resolver<'d> {
    scope: Scope<'d>,
    evaluator: Evaluator,
    budget: Budget,
    regions: Regions,
    reporter: Reporter<'d>,
}

/// What a formula may depend on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Allowed {
    /// Constants alone, in the definition of the thing that is named.
    Constant(&'static str),
    /// Everything.
    All,
}

impl<'d> Resolver<'d> {
    fn new(declaration: &Declaration, diagnostics: &'d mut Diagnostics) -> Self {
        Self {
            scope: Scope::of(declaration, diagnostics),
            evaluator: Evaluator::default(),
            budget: Budget::default(),
            regions: Regions::default(),
            reporter: Reporter::new(diagnostics),
        }
    }

    /// Everything outside of the regions, in the order of the source.
    fn top_level(&mut self, declaration: &'d Declaration) {
        for item in &declaration.items {
            match item {
                Item::State(groups) => groups.iter().for_each(|group| self.state(group)),
                Item::Parameter(parameter) => self.parameter(parameter),
                Item::Constant(constant) => {
                    self.define(constant, Kind::Constant, Allowed::Constant("a constant"));
                }
                Item::Let(definition) => self.define(definition, Kind::Let, Allowed::All),
                Item::Function(function) => self.function(function),
                Item::Interface(interface) => self.interface(interface),
                Item::Discrete(item) => self.discrete(item),
                Item::Event(_)
                | Item::Region(_)
                | Item::Sliding(_)
                | Item::Derivative(_)
                | Item::Conserved(_)
                | Item::Hamiltonian(_)
                | Item::For(_) => {}
            }
        }
        if self.regions.states.is_empty() && !self.scope.names.any_refused() {
            self.report(
                codes::NO_STATE,
                &declaration.name,
                "a system has at least one state: declare `state x;`",
            );
        } else if self.regions.states.len() > MOST_STATES {
            let message = format!(
                "{} states are too many: up to {MOST_STATES} are supported",
                self.regions.states.len()
            );
            self.report(codes::TOO_MANY_STATES, &declaration.name, message);
        }
    }

    /// `const` and `let`: from here on, the name stands for the formula.
    fn define(&mut self, definition: &'d Definition, kind: Kind, allowed: Allowed) {
        let value = self.formula(&definition.formula, allowed);
        if self.scope.names.is_first(&definition.ident, kind) {
            let meaning = value.map_or(Meaning::Wrong, Meaning::Value);
            self.scope.names.set(&definition.ident, meaning);
        }
    }

    fn interface(&mut self, item: &'d InterfaceItem) {
        let interface = &item.definition;
        let value = self.formula(&interface.formula, Allowed::All);
        if !self.scope.names.is_first(&interface.ident, Kind::Interface) {
            return;
        }
        let mut resolved = value.and_then(|value| self.switching(interface, value.id));
        if let Some(interface) = &mut resolved {
            interface.slides = item.slides;
        }
        self.regions.interfaces.push(resolved);
    }

    fn switching(&mut self, interface: &Definition, g: Id) -> Option<Interface> {
        let depends_on = self.evaluator.dag.variables([g]);
        let varies = depends_on.contains(&Model::time())
            || (self.regions.states.iter()).any(|state| depends_on.contains(&state.name))
            // an undeclared state has been reported where it is used
            || self.regions.states.is_empty();
        if !varies {
            let message = format!(
                "the interface `{}` depends neither on a state nor on `t`, so nothing can cross it",
                interface.ident
            );
            self.report(codes::INTERFACE_CONSTANT, interface.formula.extent, message);
            return None;
        }
        Some(Interface {
            attributes: interface.attributes.clone(),
            ident: interface.ident.clone(),
            label: None,
            side: Model::side_of(&interface.ident),
            is_switch: false,
            slides: false,
            end: None,
            switching_function: g,
            span: interface.formula.extent,
        })
    }
}
