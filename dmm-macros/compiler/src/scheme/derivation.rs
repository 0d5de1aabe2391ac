//! Model → scheme: the multipliers and their divided differences of every region, f^τ from the
//! first strategy that fits, and the proofs of what was derived.

use super::checked::checked;
use super::degree::is_affine;
use super::proofs::Identity;
use super::strategy::{Context, choose, midpoint};
use super::{RegionScheme, Scheme, SwitchingScheme, proofs, solvability};
use crate::algebra::{Counterexample, Dag, Id, Name, divided_difference, jacobian};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::scheme as codes;
use crate::model::{Model, sides};
use crate::proofs::{Proved, ProvedRegion};

/// Derives the scheme of a proved model. What cannot be derived, and an identity that fails, is
/// reported, and then there is no scheme.
pub fn derive(proved: Proved, diagnostics: &mut Diagnostics) -> Option<Scheme> {
    let levels: Vec<Vec<usize>> = (0..proved.regions.len())
        .map(|region| proved.levels(region))
        .collect();
    let Proved {
        mut model,
        interfaces,
        regions,
    } = proved;
    let states = model.state_names();
    let interfaces: Vec<SwitchingScheme> = (model.interfaces.iter())
        .zip(interfaces)
        .map(|(interface, proved)| {
            let g = interface.switching_function;
            SwitchingScheme::of(&model.dag, g, proved.derivatives, &states)
        })
        .collect();
    let before = diagnostics.len();
    let regions = (regions.into_iter().zip(levels).enumerate())
        .map(|(index, proved)| derive_region(&mut model, index, proved, &states, diagnostics))
        .collect();
    (diagnostics.len() == before).then_some(Scheme {
        model,
        interfaces,
        regions,
    })
}

fn derive_region(
    model: &mut Model,
    index: usize,
    (proved, levels): (ProvedRegion, Vec<usize>),
    states: &[Name],
    diagnostics: &mut Diagnostics,
) -> RegionScheme {
    let dag = &mut model.dag;
    let region = &model.regions[index];
    let time = Model::time();
    let psi: Vec<Id> = region.conserved.iter().map(|one| one.psi).collect();
    let autonomous = !dag
        .variables(region.field.iter().chain(&psi).copied())
        .contains(&time);
    let (discrete_multiplier, discrete_time_derivative) = discretise(dag, &psi, states);
    let mean: Vec<Id> = region
        .field
        .iter()
        .map(|&component| midpoint(dag, component, states))
        .collect();
    let context = Context {
        states,
        field: &region.field,
        mean: &mean,
        multiplier: &proved.multiplier,
        time_derivative: &proved.time_derivative,
        discrete_multiplier: &discrete_multiplier,
        discrete_time_derivative: &discrete_time_derivative,
        canonical: &region.canonical,
        may_vanish: (region.slide.as_ref()).is_some_and(|slide| !slide.switches.is_empty()),
    };
    let (strategy, refusals) = choose(dag, &context);
    let sides = sides(&model.interfaces, region);
    let (proofs, violations) = proofs::prove(dag, &context, (&psi, &sides), &strategy);
    for (identity, counterexample) in violations {
        let message = violation(identity, &counterexample);
        diagnostics.report(codes::IDENTITY, region.ident.span(), message);
    }
    let field = region.field.iter().copied();
    let affine = !dag.variables(field.clone()).contains(&time) && is_affine(dag, field, states);
    let arguments = [states, &[time]].concat();
    let affine_quantities = psi.iter().map(|&psi| is_affine(dag, [psi], &arguments));
    let affine_quantities = affine_quantities.collect();
    let jacobian = jacobian(dag, &region.field, states);
    let solvability = solvability::classify(dag, &strategy, states, autonomous);
    let variables = (states, model.parameters.as_slice());
    let place = (index, region, sides.as_slice());
    let checked = checked(dag, variables, place, &proved.evidence, &strategy);
    RegionScheme {
        proved,
        levels,
        discrete_multiplier,
        discrete_time_derivative,
        strategy,
        refusals,
        solvability,
        autonomous,
        jacobian,
        affine_quantities,
        affine,
        proofs,
        checked,
    }
}

/// Λ^τ and ∂ₜ^τψ: the symmetric divided differences of ψ by every state and by the time.
fn discretise(dag: &mut Dag, psi: &[Id], states: &[Name]) -> (Vec<Vec<Id>>, Vec<Id>) {
    let time = Model::time();
    let mut arguments = states.to_vec();
    arguments.push(time.clone());
    psi.iter()
        .map(|&psi| {
            if dag.depends_on(psi, &time) {
                let mut row = divided_difference(dag, psi, &arguments);
                let by_time = row.split_off(states.len());
                (row, dag.sum(by_time))
            } else {
                (divided_difference(dag, psi, states), dag.integer(0))
            }
        })
        .unzip()
}

/// How an identity that is false is told.
fn violation(identity: Identity, counterexample: &Counterexample) -> String {
    let identity = match identity {
        Identity::Telescopes => "Λ^τ Δx + ∂ₜ^τψ Δt = Δψ",
        Identity::Conserves => "Λ^τ f^τ + ∂ₜ^τψ = 0",
        Identity::Consistent => "f^τ(t, x, t, x) = f(t, x)",
    };
    let point: Vec<String> = (counterexample.point.iter())
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    format!(
        "internal error of the compiler: the derived scheme violates {identity} by {} at {}",
        counterexample.value,
        point.join(", ")
    )
}
