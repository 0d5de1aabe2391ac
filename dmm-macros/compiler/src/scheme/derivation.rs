//! Model → scheme: the multipliers and their divided differences of every region, f^τ from the
//! first strategy that fits, and the proofs of what was derived.

use super::checked::checked;
use super::degree::is_affine;
use super::strategy::{Context, choose, midpoint};
use super::{Proofs, RegionScheme, Scheme, SwitchingScheme, proofs, solvability};
use crate::algebra::{Dag, Id, Name, differentiate, divided_difference, is_proved_zero, jacobian};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::scheme as codes;
use crate::model::{Model, Region, sides};

/// Derives the scheme of `model`. What cannot be derived, and an identity that fails, is
/// reported, and then there is no scheme.
pub fn derive(mut model: Model, diagnostics: &mut Diagnostics) -> Option<Scheme> {
    let states = model.state_names();
    let interfaces: Vec<SwitchingScheme> = model
        .interfaces
        .iter()
        .map(|interface| SwitchingScheme::of(&mut model.dag, interface.switching_function, &states))
        .collect();
    let before = diagnostics.len();
    let regions = (0..model.regions.len())
        .map(|region| derive_region(&mut model, region, &states, &interfaces, diagnostics))
        .collect();
    (diagnostics.len() == before).then_some(Scheme {
        model,
        interfaces,
        regions,
    })
}

fn derive_region(
    model: &mut Model,
    region: usize,
    states: &[Name],
    interfaces: &[SwitchingScheme],
    diagnostics: &mut Diagnostics,
) -> RegionScheme {
    let dag = &mut model.dag;
    let index = region;
    let region = &model.regions[index];
    let time = Model::time();
    let psi: Vec<Id> = region.conserved.iter().map(|one| one.psi).collect();
    let autonomous = !dag
        .variables(region.field.iter().chain(&psi).copied())
        .contains(&time);

    let multiplier = jacobian(dag, &psi, states);
    let time_derivative: Vec<Id> = psi
        .iter()
        .map(|&psi| differentiate(dag, psi, &time))
        .collect();
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
        multiplier: &multiplier,
        time_derivative: &time_derivative,
        discrete_multiplier: &discrete_multiplier,
        discrete_time_derivative: &discrete_time_derivative,
        canonical: &region.canonical,
    };
    let (strategy, refusals) = choose(dag, &context);
    let sides = sides(&model.interfaces, region);
    let proofs =
        proofs::prove(
            dag,
            &context,
            (&psi, &sides),
            &strategy,
            &mut |identity, at| {
                diagnostics.report(
            codes::IDENTITY,
            region.ident.span(),
            format!("internal error of the compiler: the derived scheme violates {identity} {at}"),
        );
            },
        );
    let proofs = Proofs {
        levels: levels(dag, region, interfaces),
        ..proofs
    };
    let field = region.field.iter().copied();
    let affine = !dag.variables(field.clone()).contains(&time) && is_affine(dag, field, states);
    let arguments = [states, &[time]].concat();
    let affine_quantities = psi.iter().map(|&psi| is_affine(dag, [psi], &arguments));
    let affine_quantities = affine_quantities.collect();
    let jacobian = jacobian(dag, &region.field, states);
    let solvability = solvability::classify(dag, &strategy, states, autonomous);
    let variables = (states, model.parameters.as_slice());
    let checked = checked(dag, variables, (index, region), &sides, &strategy);
    RegionScheme {
        multiplier,
        time_derivative,
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

/// The interfaces of the region that its flow never crosses: ∂ₜg + ∇g·f = 0 is proved.
fn levels(dag: &mut Dag, region: &Region, interfaces: &[SwitchingScheme]) -> Vec<usize> {
    let mut levels = Vec::new();
    for side in &region.sides {
        let Some(switching) = interfaces.get(side.interface) else {
            continue;
        };
        let mut terms = vec![switching.time_derivative];
        for (&slope, &component) in switching.gradient.iter().zip(&region.field) {
            terms.push(dag.mul(slope, component));
        }
        let rate = dag.sum(terms);
        if is_proved_zero(dag, rate) {
            levels.push(side.interface);
        }
    }
    levels
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
