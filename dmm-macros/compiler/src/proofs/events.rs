//! What an event conserves: ψ is the same before and after it.

use std::collections::HashMap;

use proc_macro2::Ident;

use super::Variables;
use super::message::refutation;
use super::on_interface::is_equal;
use crate::algebra::{Dag, Id, Name, Verdict};
use crate::diagnostics::catalogue::proofs as codes;
use crate::diagnostics::{Diagnostics, closest};
use crate::model::{Event, Model};

/// Proves ψ(t, x) = ψ(t, x') of every event x → x' that claims to conserve ψ, at the points of its
/// interface. What is false or cannot be proved is reported.
pub(super) fn prove(model: &mut Model, variables: &Variables, diagnostics: &mut Diagnostics) {
    let Model {
        dag,
        states,
        discrete,
        interfaces,
        events,
        regions,
        ..
    } = model;
    let states: Vec<Name> = states.iter().map(|state| state.name.clone()).collect();
    let discrete: Vec<Name> = discrete.iter().map(|one| one.name.clone()).collect();
    for event in events.iter().filter(|event| !event.conserved.is_empty()) {
        let Some(interface) = interfaces.get(event.interface) else {
            continue;
        };
        let after = after(event, &states, &discrete);
        let g = interface.switching_function;
        for ident in &event.conserved {
            let here = |region: &Ident| event.region.as_ref().is_none_or(|one| one == region);
            let regions = regions.iter().filter(|region| here(&region.ident));
            let all = regions.flat_map(|region| &region.conserved);
            let quantities: Vec<Id> = all
                .clone()
                .filter(|psi| psi.ident == *ident)
                .map(|psi| psi.psi)
                .collect();
            if quantities.is_empty() {
                let names: Vec<String> = all.map(|psi| psi.ident.to_string()).collect();
                unknown(ident, &names, diagnostics);
            }
            for psi in quantities {
                let changed = dag.substitute(psi, &after);
                let verdict = is_equal(dag, variables, g, [psi, changed], &event.conditions);
                report(dag, ident, verdict, diagnostics);
            }
        }
    }
}

/// The values of variables after an event, of those that change.
fn after(event: &Event, states: &[Name], discrete: &[Name]) -> HashMap<Name, Id> {
    let named = |names: &[Name], given: &[(usize, Id)]| -> Vec<(Name, Id)> {
        let given = given.iter();
        given
            .filter_map(|&(index, value)| Some((names.get(index)?.clone(), value)))
            .collect()
    };
    let states = named(states, &event.states);
    states
        .into_iter()
        .chain(named(discrete, &event.discrete))
        .collect()
}

fn unknown(ident: &Ident, names: &[String], diagnostics: &mut Diagnostics) {
    let message = match closest(&ident.to_string(), names.iter().map(String::as_str)) {
        Some(name) => format!("there is no conserved quantity `{ident}`; did you mean `{name}`?"),
        None => format!(
            "there is no conserved quantity `{ident}`: declare `conserved {ident} = …;` beside the `der`s"
        ),
    };
    diagnostics.report(codes::NOT_CONSERVED_BY_EVENT, ident, message);
}

fn report(dag: &Dag, ident: &Ident, verdict: Verdict, diagnostics: &mut Diagnostics) {
    let message = match verdict {
        Verdict::Proved => return,
        Verdict::Refuted(found) => format!(
            "this event does not conserve `{ident}`, which changes by {}",
            refutation(dag, &found)
        ),
        Verdict::Undecided | Verdict::Exhausted => format!(
            "it could not be proved that this event conserves `{ident}`: leave it out of `conserves`, and its level is taken anew behind the event"
        ),
    };
    diagnostics.report(codes::NOT_CONSERVED_BY_EVENT, ident, message);
}
