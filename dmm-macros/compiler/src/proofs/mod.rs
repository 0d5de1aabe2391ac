//! Model → proof that what it declares holds.
//!
//! The stage is [`check`]. In every region, each declared ψ has to satisfy
//!
//! ```text
//! ∂ₜψ + ∇ψ·f = 0
//! ```
//!
//! identically (Hirani, Wan & Wojtalewicz, eq. 2.3), which the normal form decides: it is
//! *proved*, on the domain of the formulas within the region; or *refuted*, with the residual
//! and a point of the region; or
//! *undecided*, which `assume conserved` accepts if it is small at many points. The H of a
//! `hamiltonian` is conserved by construction. What a scheme needs beyond that is checked as
//! well: ψ's gradients are independent, so that ΛΛᵀ has an inverse at generic points, they
//! leave something to move, and an interface can be crossed.
//!
//! What was found is written into the model: [`Conserved::evidence`](crate::model::Conserved)
//! and [`Region::independence`](crate::model::Region).

pub(crate) mod conditions;
mod conservation;
mod independence;
mod interfaces;
mod message;
mod place;
mod points;
mod signs;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use crate::algebra::{Dag, Id, Name, differentiate, gradient, is_proved_zero};
use crate::diagnostics::Diagnostics;
use crate::model::{
    Conservation, DomainCondition, Independence, Model, Region, Sign, sides as sides_of,
};

/// Proves what `model` declares; what is false or cannot be proved is reported.
pub fn check(model: &mut Model, diagnostics: &mut Diagnostics) {
    let variables = Variables::of(model);
    for index in 0..model.regions.len() {
        let (evidence, independence) = examine(model, &variables, index, diagnostics);
        let Some(region) = model.regions.get_mut(index) else {
            continue;
        };
        region.independence = independence;
        for (conserved, evidence) in region.conserved.iter_mut().zip(evidence) {
            conserved.evidence = evidence;
        }
    }
    interfaces::check(model, &variables, diagnostics);
}

/// Where ψ is conserved in these regions, if it was proved to be: on the domain of ψ, of its
/// derivatives, and of the components of f that it depends on.
pub fn domain(model: &mut Model, regions: &[usize], psi: Id) -> Vec<DomainCondition> {
    let states = model.state_names();
    let quantity = Quantity::new(&mut model.dag, &states, psi);
    let mut formulas = Vec::new();
    let mut sides = Vec::new();
    for region in regions
        .iter()
        .filter_map(|&region| model.regions.get(region))
    {
        formulas.extend(conservation::formulas(&model.dag, &region.field, &quantity));
        if regions.len() == 1 {
            sides = sides_of(&model.interfaces, region);
        }
    }
    conditions::domain(&mut model.dag, &formulas, &sides, &BTreeSet::new()).conditions
}

/// What is known of the conserved quantities of region number `index`, and of their
/// independence.
fn examine(
    model: &mut Model,
    variables: &Variables,
    index: usize,
    diagnostics: &mut Diagnostics,
) -> (Vec<Conservation>, Independence) {
    let dag = &mut model.dag;
    let Some(region) = model.regions.get(index) else {
        return (Vec::new(), Independence::Nothing);
    };
    let place = Place {
        region,
        sides: sides_of(&model.interfaces, region),
    };
    let mut evidence = Vec::new();
    let mut quantities = Vec::new();
    for psi in &region.conserved {
        match conservation::examine(dag, variables, &place, psi, diagnostics) {
            Some((known, quantity)) => {
                evidence.push(known);
                quantities.push(quantity);
            }
            None => evidence.push(Conservation::Unknown),
        }
    }
    if quantities.len() < region.conserved.len() {
        return (evidence, Independence::Nothing);
    }
    let independence = independence::examine(dag, variables, region, &quantities, diagnostics);
    (evidence, independence)
}

/// The variables of a model.
struct Variables {
    states: Vec<Name>,
    /// With their defaults.
    parameters: Vec<(Name, Id)>,
    all: Vec<Name>,
}

impl Variables {
    fn of(model: &Model) -> Self {
        let states = model.state_names();
        let parameters: Vec<(Name, Id)> = model
            .parameters
            .iter()
            .map(|parameter| (parameter.name.clone(), parameter.default))
            .collect();
        let all = states
            .iter()
            .cloned()
            .chain(parameters.iter().map(|(name, _)| name.clone()))
            .chain([Model::time()])
            .collect();
        Self {
            states,
            parameters,
            all,
        }
    }
}

/// A region with its sides.
struct Place<'a> {
    region: &'a Region,
    /// g of each side, with its sign in the region.
    sides: Vec<(Id, Sign)>,
}

/// A conserved quantity with its derivatives.
struct Quantity {
    psi: Id,
    /// ∇ψ
    gradient: Vec<Id>,
    /// ∂ₜψ
    by_time: Id,
    /// Whether ∂ₜψ is zero.
    autonomous: bool,
}

impl Quantity {
    fn new(dag: &mut Dag, states: &[Name], psi: Id) -> Self {
        let gradient = gradient(dag, psi, states);
        let by_time = differentiate(dag, psi, &Model::time());
        Self {
            psi,
            gradient,
            by_time,
            autonomous: is_proved_zero(dag, by_time),
        }
    }
}

/// ∂ₜu + ∇u·f
fn rate(dag: &mut Dag, by_time: Id, gradient: &[Id], field: &[Id]) -> Id {
    let terms: Vec<Id> = gradient
        .iter()
        .zip(field)
        .map(|(&a, &b)| dag.mul(a, b))
        .collect();
    dag.sum([by_time].into_iter().chain(terms))
}
