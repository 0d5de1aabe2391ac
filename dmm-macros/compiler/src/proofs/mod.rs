//! Model → proved model: the proof that what it declares holds.
//!
//! The stage is [`prove`]. In every region, each declared ψ has to satisfy
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
//! What was found stays beside the model, in [`Proved`]: the gradients ∇ψ and ∇g, which no later
//! stage takes again, and why each ψ is conserved.

pub(crate) mod conditions;
mod conservation;
mod events;
mod independence;
mod interfaces;
mod message;
mod on_interface;
mod place;
mod points;
mod proved;
mod signs;
mod trials;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use crate::algebra::{Dag, Id, Name, is_proved_zero};
use crate::diagnostics::Diagnostics;
use crate::model::{Claim, Model, Region, Sign, sides as sides_of};
pub use interfaces::Rate;
use message::RegionProblem;
pub use proved::{
    Conservation, Derivatives, DomainCondition, Independence, Proved, ProvedInterface, ProvedRegion,
};

/// Proves what `model` declares. What is false or cannot be proved is reported, and then there is
/// no proved model.
pub fn prove(mut model: Model, diagnostics: &mut Diagnostics) -> Option<Proved> {
    let before = diagnostics.len();
    let variables = Variables::of(&mut model);
    let Model {
        dag,
        interfaces,
        regions,
        ..
    } = &mut model;
    let proved: Vec<Option<ProvedRegion>> = (regions.iter_mut())
        .map(|region| {
            leave_out_dependent(dag, &variables, region);
            let sides = sides_of(interfaces, region);
            let place = Place { region, sides };
            region_proofs(dag, &variables, &place, diagnostics)
        })
        .collect();
    let mut proved_interfaces = Vec::new();
    for (index, interface) in interfaces.iter().enumerate() {
        let derivatives = Derivatives::of(dag, interface.switching_function, &variables.states);
        match interfaces::examine(dag, (index, interface), &derivatives, regions) {
            Ok(rates) => proved_interfaces.push(ProvedInterface { derivatives, rates }),
            Err(problem) => problem.report(interface, diagnostics),
        }
    }
    events::prove(&mut model, &variables, diagnostics);
    let regions: Vec<ProvedRegion> = proved.into_iter().collect::<Option<_>>()?;
    (diagnostics.len() == before).then_some(Proved {
        model,
        interfaces: proved_interfaces,
        regions,
    })
}

/// Where ψ is conserved in these regions, if it was proved to be: on the domain of ψ, of its
/// derivatives, and of the components of f that it depends on.
pub fn domain(
    model: &mut Model,
    regions: &[usize],
    psi: Id,
    derivatives: &Derivatives,
) -> Vec<DomainCondition> {
    let mut formulas = Vec::new();
    let mut sides = Vec::new();
    for region in regions
        .iter()
        .filter_map(|&region| model.regions.get(region))
    {
        formulas.extend(conservation::formulas(
            &model.dag,
            &region.field,
            psi,
            derivatives,
        ));
        if regions.len() == 1 {
            sides = sides_of(&model.interfaces, region);
        }
    }
    conditions::domain(&mut model.dag, &formulas, &sides, &BTreeSet::new()).conditions
}

/// Leaves out what a sliding motion conserves because its functions g are zero: what depends on them.
fn leave_out_dependent(dag: &mut Dag, variables: &Variables, region: &mut Region) {
    while region.slide.is_some() {
        let quantities = region.conserved.iter();
        let quantities = quantities.map(|psi| Quantity::new(dag, &variables.states, psi.psi));
        let quantities: Vec<Quantity> = quantities.collect();
        let row = match independence::examine(dag, variables, &quantities, true) {
            Err(RegionProblem::Dependent { row }) => row,
            Err(_) => region.conserved.len().saturating_sub(1),
            Ok(_) => return,
        };
        if region.conserved.get(row).map(|psi| psi.claim) != Some(Claim::Mean) {
            return;
        }
        region.conserved.remove(row);
    }
}

/// What is known of the conserved quantities of a region and of their independence; nothing if
/// something is wrong, which is reported.
fn region_proofs(
    dag: &mut Dag,
    variables: &Variables,
    place: &Place<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<ProvedRegion> {
    let region = place.region;
    let mut quantities = Vec::new();
    let mut evidence = Vec::new();
    for psi in &region.conserved {
        let quantity = Quantity::new(dag, &variables.states, psi.psi);
        match conservation::examine(dag, variables, place, psi, &quantity) {
            Ok(known) => evidence.push(known),
            Err(problem) => problem.report(dag, region, psi, diagnostics),
        }
        quantities.push(quantity);
    }
    if evidence.len() < quantities.len() {
        return None;
    }
    // a motion rests where as many surfaces meet as there are states
    let may_rest = region.slide.is_some();
    let independence = match independence::examine(dag, variables, &quantities, may_rest) {
        Ok(independence) => independence,
        Err(problem) => {
            problem.report(region, diagnostics);
            return None;
        }
    };
    let (multiplier, time_derivative) = (quantities.into_iter())
        .map(|quantity| {
            let Derivatives {
                gradient,
                time_derivative,
            } = quantity.derivatives;
            (gradient, time_derivative)
        })
        .unzip();
    Some(ProvedRegion {
        multiplier,
        time_derivative,
        evidence,
        independence,
    })
}

/// The variables of a model.
struct Variables {
    states: Vec<Name>,
    /// With their defaults.
    parameters: Vec<(Name, Id)>,
    /// Those of the parameters that are 1 or 0: the sides of what formulas switch at.
    switches: Vec<Name>,
    all: Vec<Name>,
}

impl Variables {
    fn of(model: &mut Model) -> Self {
        let states = model.state_names();
        let parameters = model.parameters.iter();
        let parameters = parameters.map(|one| (one.name.clone(), one.default));
        let discrete = model.discrete.iter();
        let discrete = discrete.map(|one| (one.name.clone(), one.initial));
        let one = model.dag.integer(1);
        let switches: Vec<(Name, Id)> = model.switches().map(|name| (name.clone(), one)).collect();
        let parameters = parameters.chain(discrete).chain(switches.iter().cloned());
        let parameters: Vec<(Name, Id)> = parameters.collect();
        let slides = model.interfaces.iter().map(Model::slide_of);
        let slides: Vec<Name> = slides.filter(|_| model.switches_slide()).collect();
        let parameters = (parameters.into_iter())
            .chain(slides.into_iter().map(|name| (name, one)))
            .collect::<Vec<(Name, Id)>>();
        let switches = switches.into_iter().map(|(name, _)| name).collect();
        let all = states
            .iter()
            .cloned()
            .chain(parameters.iter().map(|(name, _)| name.clone()))
            .chain([Model::time()])
            .collect();
        Self {
            states,
            parameters,
            switches,
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
    derivatives: Derivatives,
    /// Whether ∂ₜψ is zero.
    autonomous: bool,
}

impl Quantity {
    fn new(dag: &mut Dag, states: &[Name], psi: Id) -> Self {
        let derivatives = Derivatives::of(dag, psi, states);
        let autonomous = is_proved_zero(dag, derivatives.time_derivative);
        Self {
            psi,
            derivatives,
            autonomous,
        }
    }
}
