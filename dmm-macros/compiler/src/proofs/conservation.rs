//! Conservation: ∂ₜψ + ∇ψ·f = 0 for one ψ of a region.

use std::collections::{BTreeSet, HashMap};

use super::conditions::domain;
use super::message::QuantityProblem;
use super::place::decide;
use super::points::points;
use super::signs::on_both_sides;
use super::trials::{ENOUGH_POINTS, FEWEST_POINTS, MOST_TRIALS, SMALL, Trials};
use super::{Conservation, Derivatives, Place, Quantity, Variables};
use crate::algebra::normal_form::decide_zero_on;
use crate::algebra::{Dag, Id, Name, Verdict, evaluate_bounded, is_proved_zero};
use crate::model::{Claim, Conserved, Region, positive};

/// Examines one ψ: why it is conserved, or what is wrong with it.
pub(super) fn examine(
    dag: &mut Dag,
    variables: &Variables,
    place: &Place<'_>,
    psi: &Conserved,
    quantity: &Quantity,
) -> Result<Conservation, QuantityProblem> {
    let region = place.region;
    let is_zero = |id: &Id| is_proved_zero(dag, *id);
    if quantity.autonomous && quantity.derivatives.gradient.iter().all(is_zero) {
        return Err(QuantityProblem::Constant);
    }
    if psi.claim == Claim::Mean {
        return Ok(Conservation::ByConstruction);
    }
    let formulas = formulas(dag, &region.field, quantity.psi, &quantity.derivatives);
    if psi.claim == Claim::Hamiltonian && is_by_construction(dag, variables, region, quantity) {
        conditions(dag, place, &formulas)?;
        return Ok(Conservation::ByConstruction);
    }
    let residual = quantity.derivatives.rate(dag, &region.field);
    let (verdict, formulas) = decide_by_sides(dag, variables, place, residual, formulas);
    let roots: Vec<Id> = formulas.iter().copied().chain([residual]).collect();
    match verdict {
        Verdict::Proved => {
            let both = on_both_sides(&mut dag.clone(), variables, place, residual, &roots);
            let domain = domain(dag, &roots, &place.sides, &both);
            match domain.contradiction {
                Some(needs) => Err(QuantityProblem::NoValue(needs)),
                None => Ok(Conservation::Proved(domain.conditions)),
            }
        }
        Verdict::Refuted(counterexample) => Err(QuantityProblem::Refuted(counterexample)),
        verdict @ (Verdict::Undecided | Verdict::Exhausted) => {
            conditions(dag, place, &roots)?;
            if psi.claim == Claim::Assumed {
                return assumed(dag, variables, region, quantity, residual);
            }
            Err(QuantityProblem::NotProved {
                residual,
                is_exhausted: matches!(verdict, Verdict::Exhausted),
            })
        }
    }
}

/// Whether there is a place where `roots` have values.
fn conditions(dag: &mut Dag, place: &Place<'_>, roots: &[Id]) -> Result<(), QuantityProblem> {
    let mut scratch = dag.clone();
    match domain(&mut scratch, roots, &place.sides, &BTreeSet::new()).contradiction {
        Some(needs) => {
            *dag = scratch;
            Err(QuantityProblem::NoValue(needs))
        }
        None => Ok(()),
    }
}

/// So many switches are looked at side by side.
const MOST_SWITCHES: usize = 8;

/// Whether `residual` is zero on all sides of the switches that it depends on; see [`decide_in`].
fn decide_by_sides(
    dag: &mut Dag,
    variables: &Variables,
    place: &Place<'_>,
    residual: Id,
    formulas: Vec<Id>,
) -> (Verdict, Vec<Id>) {
    let roots = formulas.iter().copied().chain([residual]);
    let depends_on = dag.variables(roots);
    let switches = variables.switches.iter();
    let switches: Vec<&Name> = switches.filter(|one| depends_on.contains(one)).collect();
    if switches.is_empty() || switches.len() > MOST_SWITCHES {
        return decide_in(dag, variables, place, residual, formulas);
    }
    let mut all = Vec::new();
    for choice in 0..1_i64 << switches.len() {
        let side = |(number, name): (usize, &&Name)| {
            let value = dag.integer(choice >> number & 1);
            ((*name).clone(), value)
        };
        let sides: HashMap<Name, Id> = switches.iter().enumerate().map(side).collect();
        let residual = dag.substitute(residual, &sides);
        let formulas = formulas.iter();
        let formulas = formulas.map(|&formula| dag.substitute(formula, &sides));
        let formulas = formulas.collect();
        let (verdict, formulas) = decide_in(dag, variables, place, residual, formulas);
        if verdict != Verdict::Proved {
            return (verdict, formulas);
        }
        all.extend(formulas);
    }
    all.retain(|&root| dag.as_constant(root).is_none());
    (Verdict::Proved, all)
}

/// Whether `residual` is zero, with the formulas on whose domain: those that are given if they
/// are enough, else with every component of f, in the region alone.
fn decide_in(
    dag: &mut Dag,
    variables: &Variables,
    place: &Place<'_>,
    residual: Id,
    formulas: Vec<Id>,
) -> (Verdict, Vec<Id>) {
    let verdict = decide_zero_on(dag, residual, &formulas);
    let mut all = formulas.clone();
    for &component in &place.region.field {
        if !all.contains(&component) && dag.as_constant(component).is_none() {
            all.push(component);
        }
    }
    if verdict == Verdict::Proved || place.sides.is_empty() && all.len() == formulas.len() {
        return (verdict, formulas);
    }
    let mut scratch = dag.clone();
    let sides = positive(&mut scratch, &place.sides);
    let verdict = decide(&mut scratch, variables, residual, &all, &sides);
    if let Verdict::Refuted(_) = verdict {
        *dag = scratch;
    }
    (verdict, all)
}

/// On whose domain the proof holds: ψ, its derivatives, and the components of f that ψ depends
/// on.
pub(super) fn formulas(dag: &Dag, field: &[Id], psi: Id, derivatives: &Derivatives) -> Vec<Id> {
    let mut roots = vec![psi, derivatives.time_derivative];
    for (&slope, &component) in derivatives.gradient.iter().zip(field) {
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
    if !dag.is_zero(quantity.derivatives.time_derivative) {
        return false;
    }
    let mut paired = vec![false; variables.states.len()];
    for &(q, p) in &region.canonical {
        let slopes = (
            quantity.derivatives.gradient.get(q),
            quantity.derivatives.gradient.get(p),
        );
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
    let unpaired = paired.iter().zip(&quantity.derivatives.gradient);
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
    rate: Id,
) -> Result<Conservation, QuantityProblem> {
    let mut roots: Vec<Id> = (quantity.derivatives.gradient.iter())
        .zip(&region.field)
        .map(|(&slope, &component)| dag.mul(slope, component))
        .collect();
    roots.push(quantity.derivatives.time_derivative);
    let terms = roots.len();
    roots.push(rate);
    roots.extend(region.field.iter().copied().chain([quantity.psi]));
    let mut largest = 0.0_f64;
    let mut trials = Trials::default();
    for point in points(dag, variables).take(MOST_TRIALS) {
        let values = evaluate_bounded(dag, &roots, &point);
        let Some((residual, size)) = trials.judge(&values, terms) else {
            continue;
        };
        let relative = residual.abs() / size;
        if relative > SMALL {
            let depends = dag.variables(roots.iter().copied());
            let point: Vec<(Name, f64)> = point
                .into_iter()
                .filter(|(name, _)| depends.contains(name))
                .collect();
            return Err(QuantityProblem::NotSmall {
                residual,
                size,
                point,
            });
        }
        largest = largest.max(relative);
        if trials.usable == ENOUGH_POINTS {
            break;
        }
    }
    if trials.usable < FEWEST_POINTS {
        return Err(QuantityProblem::Unchecked(trials));
    }
    Ok(Conservation::Assumed {
        points: trials.usable,
        largest,
    })
}
