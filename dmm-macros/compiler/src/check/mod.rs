//! Declaration → model: every name resolved, every region complete, every formula such that it
//! can be evaluated.
//!
//! The stage is [`resolve`]. It checks that
//!
//! - names are declared once, in front of their use, and are used;
//! - constants and defaults depend on constants only;
//! - ẋ = fᵣ(t, x) is complete: one `der` a state in every region r;
//! - the regions are the sign patterns of the switching functions, each of them once: with one
//!   interface g = 0 the two regions g > 0 and g < 0, without one the whole space;
//! - no formula divides by zero, leaves the real numbers, or overflows whatever the state is.
//!
//! A formula of which an error was reported yields nothing, and nothing that follows from its
//! absence is reported.

mod body;
mod formula;
mod functions;
mod names;
mod number;
mod regions;

#[cfg(test)]
mod tests;

use proc_macro2::Ident;

use crate::algebra::{Dag, Id, Name};
use crate::diagnostics::{Diagnostics, Extent};
use crate::model::{Interface, Model, Parameter, State};
use crate::syntax::{Declaration, Definition, Documented, Expression, Item};
use names::{Kind, Names};

/// More states than this make derived formulas too long to be of use.
const MOST_STATES: usize = 32;

/// Resolves `declaration`. The model is there if nothing was added to `diagnostics`.
pub fn resolve(declaration: Declaration, diagnostics: &mut Diagnostics) -> Option<Model> {
    let before = diagnostics.len();
    let source = declaration.to_string();
    let names = Names::collect(&declaration, diagnostics);
    let mut resolver = Resolver {
        dag: Dag::new(),
        names,
        diagnostics,
        states: Vec::new(),
        parameters: Vec::new(),
        interfaces: Vec::new(),
        lacks_region: false,
    };
    resolver.top_level(&declaration);
    let regions = resolver.regions(&declaration);
    resolver.unused();
    if resolver.diagnostics.len() > before {
        return None;
    }
    Some(Model {
        attributes: declaration.attributes,
        visibility: declaration.visibility,
        name: declaration.name,
        dag: resolver.dag,
        states: resolver.states,
        parameters: resolver.parameters,
        interfaces: resolver.interfaces.into_iter().flatten().collect(),
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
    parameters: Vec<Parameter>,
    /// By interface; nothing where its formula is wrong.
    interfaces: Vec<Option<Interface>>,
    /// Whether a region is missing, and with it whatever it would use.
    lacks_region: bool,
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

impl Resolver<'_> {
    fn error(&mut self, place: impl Into<Extent>, message: impl std::fmt::Display) {
        self.diagnostics.error(place, message);
    }

    /// Everything outside of the regions, in the order of the source.
    fn top_level(&mut self, declaration: &Declaration) {
        for item in &declaration.items {
            match item {
                Item::State(states) => states.iter().for_each(|state| self.state(state)),
                Item::Parameter(parameter) => self.parameter(parameter),
                Item::Constant(constant) => {
                    self.define(constant, Kind::Constant, Scope::Constant("a constant"));
                }
                Item::Let(definition) => self.define(definition, Kind::Let, Scope::All),
                Item::Interface(interface) => self.interface(interface),
                Item::Region(_) | Item::Derivative(_) | Item::Conserved(_) => {}
            }
        }
        if self.states.is_empty() && !self.names.any_refused() {
            self.error(
                &declaration.name,
                "a system has at least one state: declare `state x;`",
            );
        } else if self.states.len() > MOST_STATES {
            self.error(
                &declaration.name,
                format!(
                    "{} states are too many: up to {MOST_STATES} are supported",
                    self.states.len()
                ),
            );
        }
    }

    fn state(&mut self, state: &Documented) {
        if self.names.is_first(&state.ident, Kind::State) {
            let name = Name::new(&state.ident.to_string());
            let id = self.dag.variable(&name);
            self.names.set(&state.ident, Value { id, number: None });
            self.states.push(State {
                attributes: state.attributes.clone(),
                ident: state.ident.clone(),
                name,
            });
        }
    }

    fn parameter(&mut self, parameter: &Definition) {
        let scope = Scope::Constant("the default of a parameter");
        let default = self.formula(&parameter.formula, scope);
        if !self.names.is_first(&parameter.ident, Kind::Parameter) {
            return;
        }
        let name = Name::new(&parameter.ident.to_string());
        let id = self.dag.variable(&name);
        self.names.set(&parameter.ident, Value { id, number: None });
        if let Some(default) = default {
            self.parameters.push(Parameter {
                attributes: parameter.attributes.clone(),
                ident: parameter.ident.clone(),
                name,
                default: default.id,
            });
        }
    }

    /// `const` and `let`: from here on, the name stands for the formula.
    fn define(&mut self, definition: &Definition, kind: Kind, scope: Scope) {
        let value = self.formula(&definition.formula, scope);
        if self.names.is_first(&definition.ident, kind) {
            match value {
                Some(value) => self.names.set(&definition.ident, value),
                None => self.names.set_wrong(&definition.ident),
            }
        }
    }

    fn interface(&mut self, interface: &Definition) {
        let value = self.formula(&interface.formula, Scope::All);
        if !self.names.is_first(&interface.ident, Kind::Interface) {
            return;
        }
        if self.interfaces.len() == 1 {
            let message = format!(
                "several interfaces are not supported yet: `{}` is the second of this system",
                interface.ident
            );
            self.error(&interface.ident, message);
        }
        let resolved = value.and_then(|value| self.switching(interface, value.id));
        self.interfaces.push(resolved);
    }

    fn switching(&mut self, interface: &Definition, g: Id) -> Option<Interface> {
        let varies = self.dag.depends_on(g, &Model::time())
            || (self.states.iter()).any(|state| self.dag.depends_on(g, &state.name))
            // an undeclared state has been reported where it is used
            || self.states.is_empty();
        if !varies {
            let message = format!(
                "the interface `{}` depends neither on a state nor on `t`, so nothing can cross it",
                interface.ident
            );
            self.error(interface.formula.extent, message);
            return None;
        }
        Some(Interface {
            attributes: interface.attributes.clone(),
            ident: interface.ident.clone(),
            switching_function: g,
            span: interface.formula.extent,
        })
    }

    /// What was declared and never used, as far as everything that could use it is there.
    fn unused(&mut self) {
        if self.lacks_region {
            return;
        }
        for (kind, ident) in self.names.unused() {
            let message = format!("the {kind} `{ident}` is never used; remove it");
            self.error(&ident, message);
        }
    }

    fn formula(&mut self, formula: &Expression, scope: Scope) -> Option<Value> {
        formula::resolve(self, formula, scope)
    }

    /// The index of the state called `ident`.
    fn state_index(&self, ident: &Ident) -> Option<usize> {
        self.states.iter().position(|state| state.ident == *ident)
    }
}
