//! The identifiers that all emitted parts of a system refer to: its type parameters, the
//! enumeration of its regions, the structs of dynamics and guards.

use proc_macro2::Ident;
use quote::format_ident;

use super::names::Names;
use crate::model::camel_case;
use crate::program::Program;

/// What every emitted part of a system refers to.
pub(super) struct Emission<'a> {
    /// What is emitted.
    pub program: &'a Program<'a>,
    /// The generic type of the scalars.
    pub scalar: Ident,
    /// That of other scalars.
    pub other: Ident,
    /// The generic order of a coefficient, and the constant number of coefficients.
    pub order: Ident,
    pub coefficients: Ident,
    /// The enumeration of the regions.
    pub region: Ident,
    /// Its variants, by region.
    pub variants: Vec<Ident>,
    /// The structs of the dynamics, by region.
    pub dynamics_of: Vec<Ident>,
    /// The struct of the guards, if there are any.
    pub guards: Option<Ident>,
    /// The struct of the events, if there are any.
    pub events: Option<Ident>,
}

impl<'a> Emission<'a> {
    /// The identifiers for `program`.
    pub(super) fn new(program: &'a Program<'a>) -> Self {
        let model = &program.scheme.model;
        let system = model.name.to_string();
        let region = format_ident!("{}Region", model.name, span = model.name.span());
        let mut types = Names::reserving([system.as_str(), &region.to_string(), "dmm"]);
        let mut variants = Names::default();
        let camel: Vec<String> = model
            .regions
            .iter()
            .map(|region| camel_case(&region.ident.to_string()))
            .collect();
        Self {
            program,
            scalar: types.take("S"),
            other: types.take("Other"),
            order: types.take("K"),
            coefficients: types.take("P"),
            region,
            variants: camel.iter().map(|name| variants.take(name)).collect(),
            dynamics_of: camel
                .iter()
                .map(|name| types.take(&format!("{name}Dynamics")))
                .collect(),
            guards: program.guards.as_ref().map(|_| types.take("Guards")),
            events: program.events.as_ref().map(|_| types.take("Events")),
        }
    }
}
