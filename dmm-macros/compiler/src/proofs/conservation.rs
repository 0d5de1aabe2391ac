//! Conservation: ∂ₜψ + ∇ψ·f = 0 for one ψ of a region.

use super::conditions::conditions;
use super::message::{coordinates, in_region, refutation, rounded, shortened};
use super::points::points;
use super::{Quantity, Variables, rate};
use crate::algebra::normal_form::decide_zero_on;
use crate::algebra::{
    Dag, Id, Name, Verdict, differentiate, evaluate_bounded, gradient, is_proved_zero, to_text,
};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::proofs as codes;
use crate::model::{Claim, Conservation, Conserved, Model, Region};

/// `assume` wants this many points in the domain …
const FEWEST_POINTS: usize = 64;
/// … is content with this many …
const ENOUGH_POINTS: usize = 128;
/// … and gives up after this many.
const MOST_TRIALS: usize = 2048;
/// The largest residual that `assume` accepts, relative to the size of the terms that cancel:
/// far above what rounding leaves, far below a wrong coefficient.
const SMALL: f64 = 1e-9;

/// Examines one ψ: what is known of it, or nothing if an error was reported.
pub(super) fn examine(
    dag: &mut Dag,
    variables: &Variables,
    region: &Region,
    psi: &Conserved,
    diagnostics: &mut Diagnostics,
) -> Option<(Conservation, Quantity)> {
    let gradient = gradient(dag, psi.psi, &variables.states);
    let by_time = differentiate(dag, psi.psi, &Model::time());
    let autonomous = is_proved_zero(dag, by_time);
    let name = &psi.ident;
    let is_zero = |id: &Id| is_proved_zero(dag, *id);
    if autonomous && gradient.iter().all(is_zero) {
        let message = format!(
            "`{name}` depends neither on the states nor on `t`: a constant needs no conservation; remove it"
        );
        diagnostics.report(codes::CONSTANT_QUANTITY, psi.span, message);
        return None;
    }
    let quantity = Quantity {
        gradient,
        by_time,
        autonomous,
        psi: psi.psi,
    };
    if psi.claim == Claim::Hamiltonian && is_by_construction(dag, variables, region, &quantity) {
        return Some((Conservation::ByConstruction, quantity));
    }
    let residual = rate(dag, by_time, &quantity.gradient, &region.field);
    let formulas = formulas(dag, region, &quantity);
    match decide_zero_on(dag, residual, &formulas) {
        Verdict::Proved => {
            let roots: Vec<Id> = formulas.into_iter().chain([residual]).collect();
            let conditions = conditions(dag, &roots);
            Some((Conservation::Proved(conditions), quantity))
        }
        Verdict::Refuted(counterexample) => {
            let message = format!(
                "`{name}` is not conserved{}: d/dt {name} = {}",
                in_region(region),
                refutation(dag, &counterexample)
            );
            diagnostics.report(codes::NOT_CONSERVED, psi.span, message);
            None
        }
        Verdict::Undecided if psi.claim == Claim::Assumed => {
            let evidence = assumed(dag, variables, region, &quantity, psi, diagnostics)?;
            Some((evidence, quantity))
        }
        Verdict::Undecided => {
            let message = format!(
                "`{name}` could not be proved to be conserved{}: d/dt {name} = {} was found neither to be zero nor clearly not to be; write it in another way, or accept it with `assume conserved {name} = …;`, which checks it at many points",
                in_region(region),
                shortened(&to_text(dag, residual))
            );
            diagnostics.report(codes::NOT_PROVED, psi.span, message);
            None
        }
    }
}

/// On whose domain the proof holds: ψ, its derivatives, and the components of f that ψ depends
/// on.
fn formulas(dag: &Dag, region: &Region, quantity: &Quantity) -> Vec<Id> {
    let mut roots = vec![quantity.psi, quantity.by_time];
    for (&slope, &component) in quantity.gradient.iter().zip(&region.field) {
        roots.push(slope);
        if !dag.is_zero(slope) {
            roots.push(component);
        }
    }
    roots.retain(|&root| dag.as_constant(root).is_none());
    roots
}

/// Whether q̇ = ∂H/∂p and ṗ = −∂H/∂q hold node by node for canonical pairs (q, p), and H depends
/// on nothing else that moves: then dH/dt = Σ H_q H_p − H_p H_q cancels pair by pair.
fn is_by_construction(
    dag: &mut Dag,
    variables: &Variables,
    region: &Region,
    quantity: &Quantity,
) -> bool {
    if !dag.is_zero(quantity.by_time) {
        return false;
    }
    let mut paired = vec![false; variables.states.len()];
    for &(q, p) in &region.canonical {
        let slopes = (quantity.gradient.get(q), quantity.gradient.get(p));
        let field = (region.field.get(q), region.field.get(p));
        let (Some(&by_q), Some(&by_p), (Some(&of_q), Some(&of_p))) = (slopes.0, slopes.1, field)
        else {
            return false;
        };
        let opposite = dag.neg(by_q);
        if q == p || of_q != by_p || of_p != opposite {
            return false;
        }
        for state in [q, p] {
            match paired.get_mut(state) {
                Some(flag) if !*flag => *flag = true,
                _ => return false,
            }
        }
    }
    let unpaired = paired.iter().zip(&quantity.gradient);
    unpaired
        .filter(|(paired, _)| !**paired)
        .all(|(_, &slope)| dag.is_zero(slope))
}

/// Evaluates ∂ₜψ + ∇ψ·f against the size of its terms, for a ψ that is accepted on the user's
/// word.
fn assumed(
    dag: &mut Dag,
    variables: &Variables,
    region: &Region,
    quantity: &Quantity,
    psi: &Conserved,
    diagnostics: &mut Diagnostics,
) -> Option<Conservation> {
    let mut roots: Vec<Id> = quantity
        .gradient
        .iter()
        .zip(&region.field)
        .map(|(&slope, &component)| dag.mul(slope, component))
        .collect();
    roots.push(quantity.by_time);
    let terms = roots.len();
    roots.push(rate(
        dag,
        quantity.by_time,
        &quantity.gradient,
        &region.field,
    ));
    roots.extend(region.field.iter().copied().chain([quantity.psi]));
    let name = &psi.ident;
    let place = in_region(region);
    let (mut count, mut largest) = (0, 0.0_f64);
    for point in points(dag, variables).take(MOST_TRIALS) {
        let values = evaluate_bounded(dag, &roots, &point);
        if values.iter().any(|(value, _)| !value.is_finite()) {
            continue;
        }
        let size: f64 = values
            .iter()
            .take(terms)
            .map(|(value, _)| value.abs())
            .sum();
        let Some(&(residual, error)) = values.get(terms) else {
            continue;
        };
        // a value without digits says nothing
        if size == 0.0 || error.is_nan() || error > SMALL * size {
            continue;
        }
        let relative = residual.abs() / size;
        if relative > SMALL {
            let depends = dag.variables(roots.iter().copied());
            let point: Vec<(Name, f64)> = point
                .into_iter()
                .filter(|(name, _)| depends.contains(name))
                .collect();
            let message = format!(
                "`{name}` is assumed to be conserved{place}, but d/dt {name} is {} at {}, where its terms are of size {}",
                rounded(residual),
                coordinates(&point),
                rounded(size)
            );
            diagnostics.report(codes::ASSUMED_NOT_SMALL, psi.span, message);
            return None;
        }
        count += 1;
        largest = largest.max(relative);
        if count == ENOUGH_POINTS {
            break;
        }
    }
    if count < FEWEST_POINTS {
        let message = format!(
            "`{name}` is assumed to be conserved{place}, but its formulas have a value at {count} of {MOST_TRIALS} points only, and {FEWEST_POINTS} are needed to check it"
        );
        diagnostics.report(codes::ASSUMED_UNCHECKED, psi.span, message);
        return None;
    }
    Some(Conservation::Assumed {
        points: count,
        largest,
    })
}
