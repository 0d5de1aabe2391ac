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
//! - the regions are the sign patterns of the switching functions, each of them once: with one
//!   interface g = 0 the two regions g > 0 and g < 0, without one the whole space;
//! - no formula divides by zero, leaves the real numbers, or overflows whatever the state is.
//!
//! A formula of which an error was reported yields nothing, and nothing that follows from its
//! absence is reported (see the module `report`).

mod advice;
mod body;
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
mod sides;
mod targets;

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use crate::algebra::{Dag, Id};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Interface, Model, Parameter, State};
use crate::syntax::{Declaration, Definition, Expression, FunctionItem, Item};
use groups::MOST_STATES;
use names::{Kind, Meaning, Names};
use samples::Samples;

/// Resolves `declaration`. The model is there if nothing was added to `diagnostics`.
pub fn resolve(declaration: Declaration, diagnostics: &mut Diagnostics) -> Option<Model> {
    let before = diagnostics.len();
    let source = declaration.to_string();
    let mut resolver = Resolver::new(&declaration, diagnostics);
    resolver.top_level(&declaration);
    let regions = resolver.regions(&declaration);
    resolver.unused();
    let Resolver {
        dag,
        diagnostics,
        states,
        parameters,
        interfaces,
        ..
    } = resolver;
    let is_right = diagnostics.len() == before;
    is_right.then(|| Model {
        attributes: declaration.attributes,
        visibility: declaration.visibility,
        name: declaration.name,
        dag,
        states,
        parameters,
        interfaces: interfaces.into_iter().flatten().collect(),
        regions,
        source,
    })
}

/// What has been resolved so far.
struct Resolver<'d> {
    dag: Dag,
    names: Names,
    diagnostics: &'d mut Diagnostics,
    states: Vec<State>,
    /// By name: the index of the first element, and the number of elements of a group.
    state_groups: BTreeMap<String, (usize, Option<usize>)>,
    parameters: Vec<Parameter>,
    /// By interface; nothing where its formula is wrong.
    interfaces: Vec<Option<Interface>>,
    functions: BTreeMap<String, &'d FunctionItem>,
    /// Whether a region is missing, and with it whatever it would use.
    lacks_region: bool,

    /// What regions repeat of what they share, as far as it was reported.
    repeated: BTreeSet<String>,
    /// The function whose declaration is read.
    defining: Option<String>,
    /// The calls that are being written out, the outermost first.
    calls: Vec<&'d Expression>,
    /// By function and arguments: what a call was written out to.
    calls_known: BTreeMap<(String, Vec<Id>), Option<Value>>,
    /// Variables that stand for what is not known so far.
    unknowns: BTreeSet<Id>,
    samples: Samples,
    /// By divisor that is not clear from the samples: whether it is zero.
    divisors: BTreeMap<Id, bool>,
    /// By node: how deep it is nested, if it and all below it was found to be in order; else 0.
    levels: Vec<usize>,
    /// How deep the part of a formula that is read is nested.
    depth: usize,
    /// How much was read.
    work: usize,
    /// Whether a loop without turns is read once all the same: what it gives does not count.
    is_rehearsal: bool,
    /// Whether what is reported is to be forgotten, because it was reported before.
    is_quiet: bool,
}

/// What a formula may depend on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Scope {
    /// Constants alone, in the definition of the thing that is named.
    Constant(&'static str),
    /// Everything.
    All,
}

/// A resolved formula.
#[derive(Debug, Clone, Copy)]
struct Value {
    /// Its node.
    id: Id,
    /// Its floating-point value if it is free of variables.
    number: Option<f64>,
}

impl<'d> Resolver<'d> {
    fn new(declaration: &Declaration, diagnostics: &'d mut Diagnostics) -> Self {
        Self {
            dag: Dag::new(),
            names: Names::collect(declaration, diagnostics),
            diagnostics,
            states: Vec::new(),
            state_groups: BTreeMap::new(),
            parameters: Vec::new(),
            interfaces: Vec::new(),
            functions: BTreeMap::new(),
            lacks_region: false,
            repeated: BTreeSet::new(),
            defining: None,
            calls: Vec::new(),
            calls_known: BTreeMap::new(),
            unknowns: BTreeSet::new(),
            samples: Samples::default(),
            divisors: BTreeMap::new(),
            levels: Vec::new(),
            depth: 0,
            work: 0,
            is_rehearsal: false,
            is_quiet: false,
        }
    }

    /// Everything outside of the regions, in the order of the source.
    fn top_level(&mut self, declaration: &'d Declaration) {
        for item in &declaration.items {
            match item {
                Item::State(groups) => groups.iter().for_each(|group| self.state(group)),
                Item::Parameter(parameter) => self.parameter(parameter),
                Item::Constant(constant) => {
                    self.define(constant, Kind::Constant, Scope::Constant("a constant"));
                }
                Item::Let(definition) => self.define(definition, Kind::Let, Scope::All),
                Item::Function(function) => self.function(function),
                Item::Interface(interface) => self.interface(interface),
                Item::Region(_)
                | Item::Derivative(_)
                | Item::Conserved(_)
                | Item::Hamiltonian(_)
                | Item::For(_) => {}
            }
        }
        if self.states.is_empty() && !self.names.any_refused() {
            self.report(
                codes::NO_STATE,
                &declaration.name,
                "a system has at least one state: declare `state x;`",
            );
        } else if self.states.len() > MOST_STATES {
            let message = format!(
                "{} states are too many: up to {MOST_STATES} are supported",
                self.states.len()
            );
            self.report(codes::TOO_MANY_STATES, &declaration.name, message);
        }
    }

    /// `const` and `let`: from here on, the name stands for the formula.
    fn define(&mut self, definition: &'d Definition, kind: Kind, scope: Scope) {
        let value = self.formula(&definition.formula, scope);
        if self.names.is_first(&definition.ident, kind) {
            let meaning = value.map_or(Meaning::Wrong, Meaning::Value);
            self.names.set(&definition.ident, meaning);
        }
    }

    fn interface(&mut self, interface: &'d Definition) {
        let value = self.formula(&interface.formula, Scope::All);
        if !self.names.is_first(&interface.ident, Kind::Interface) {
            return;
        }
        if self.interfaces.len() == 1 {
            let message = format!(
                "several interfaces are not supported yet: `{}` is the second of this system",
                interface.ident
            );
            self.report(codes::SEVERAL_INTERFACES, &interface.ident, message);
        }
        let resolved = value.and_then(|value| self.switching(interface, value.id));
        self.interfaces.push(resolved);
    }

    fn switching(&mut self, interface: &Definition, g: Id) -> Option<Interface> {
        let depends_on = self.dag.variables([g]);
        let varies = depends_on.contains(&Model::time())
            || (self.states.iter()).any(|state| depends_on.contains(&state.name))
            // an undeclared state has been reported where it is used
            || self.states.is_empty();
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
            switching_function: g,
            span: interface.formula.extent,
        })
    }
}
