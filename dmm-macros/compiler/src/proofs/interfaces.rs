//! Interfaces that cannot be crossed: the rate ∂ₜg + ∇g·f of the switching function is zero, or
//! its sign is the same everywhere in a way that leads nothing across.

use std::collections::BTreeMap;

use super::{Variables, rate};
use crate::algebra::evaluate::{Interval, enclose};
use crate::algebra::{Dag, Id, differentiate, gradient, is_proved_zero, normalise};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::proofs as codes;
use crate::model::{Interface, Model, Sign};

/// Reports the interfaces of `model` that are constant, or that no trajectory crosses.
pub(super) fn check(model: &mut Model, variables: &Variables, diagnostics: &mut Diagnostics) {
    let dag = &mut model.dag;
    for (index, interface) in model.interfaces.iter().enumerate() {
        let g = interface.switching_function;
        let name = &interface.ident;
        let gradient = gradient(dag, g, &variables.states);
        let by_time = differentiate(dag, g, &Model::time());
        let derivatives = gradient.iter().copied().chain([by_time]);
        let is_constant = derivatives.into_iter().all(|one| is_proved_zero(dag, one));
        if is_constant {
            let message = format!(
                "the interface `{name}` is constant: all of its derivatives are zero, so nothing can cross it"
            );
            diagnostics.report(codes::CONSTANT_INTERFACE, interface.span, message);
            continue;
        }
        let mut rates: Vec<(Option<Sign>, Motion)> = Vec::new();
        for region in &model.regions {
            let side = region.sides.iter().find(|side| side.interface == index);
            let rate = rate(dag, by_time, &gradient, &region.field);
            rates.push((side.map(|side| side.sign), motion(dag, rate)));
        }
        report(interface, &rates, diagnostics);
    }
}

/// What is known of the sign of a rate, everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Motion {
    /// It is zero.
    None,
    /// It is nowhere negative.
    Up,
    /// It is nowhere positive.
    Down,
    /// Nothing.
    Unknown,
}

fn motion(dag: &mut Dag, rate: Id) -> Motion {
    if is_proved_zero(dag, rate) {
        return Motion::None;
    }
    let normal = normalise(dag, rate);
    let ranges = [Some(rate), normal].map(|id| match id {
        Some(id) => enclose(dag, &[id], &BTreeMap::new()).first().copied(),
        None => None,
    });
    let any = |holds: fn(Interval) -> bool| ranges.iter().flatten().any(|&range| holds(range));
    if any(Interval::is_not_negative) {
        Motion::Up
    } else if any(Interval::is_not_positive) {
        Motion::Down
    } else {
        Motion::Unknown
    }
}

fn report(interface: &Interface, rates: &[(Option<Sign>, Motion)], diagnostics: &mut Diagnostics) {
    let name = &interface.ident;
    if rates.iter().all(|(_, motion)| *motion == Motion::None) {
        let message = format!(
            "the interface `{name}` is never crossed: d/dt {name} = 0 in every region, so that each region is a system of its own"
        );
        diagnostics.report(codes::NEVER_CROSSED, interface.span, message);
        return;
    }
    let sides: Vec<(Sign, Motion)> = rates
        .iter()
        .filter_map(|&(side, motion)| Some((side?, motion)))
        .collect();
    if sides.len() < rates.len() {
        return;
    }
    let all = |above: Motion, below: Motion| {
        sides.iter().all(|&(sign, motion)| {
            let wanted = match sign {
                Sign::Positive => above,
                Sign::Negative => below,
            };
            motion == wanted
        })
    };
    if all(Motion::Down, Motion::Up) {
        let message = format!(
            "the interface `{name}` cannot be crossed: d/dt {name} ≤ 0 where {name} > 0, and d/dt {name} ≥ 0 where {name} < 0, so that both sides push towards it"
        );
        diagnostics.report(codes::ALWAYS_SLIDING, interface.span, message);
    } else if all(Motion::Up, Motion::Down) {
        let message = format!(
            "the interface `{name}` is never reached: d/dt {name} ≥ 0 where {name} > 0, and d/dt {name} ≤ 0 where {name} < 0, so that both sides lead away from it"
        );
        diagnostics.report(codes::ALWAYS_LEAVING, interface.span, message);
    }
}
