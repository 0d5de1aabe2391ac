//! Conservation: ∂ₜψ + ∇ψ·f = 0 for one ψ of a region.

use std::collections::BTreeSet;

use super::conditions::{Domain, domain};
use super::message::{coordinates, in_region, refutation, rounded, shortened};
use super::place::decide;
use super::points::points;
use super::signs::on_both_sides;
use super::{Place, Quantity, Variables, rate};
use crate::algebra::normal_form::decide_zero_on;
use crate::algebra::{Dag, Id, Name, Verdict, evaluate_bounded, is_proved_zero, to_text};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::proofs as codes;
use crate::model::{Claim, Conservation, Conserved, Region, positive};

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
    place: &Place<'_>,
    psi: &Conserved,
    diagnostics: &mut Diagnostics,
) -> Option<(Conservation, Quantity)> {
    let region = place.region;
    let quantity = Quantity::new(dag, &variables.states, psi.psi);
    let name = &psi.ident;
    let is_zero = |id: &Id| is_proved_zero(dag, *id);
    if quantity.autonomous && quantity.gradient.iter().all(is_zero) {
        let message = format!(
            "`{name}` depends neither on the states nor on `t`: a constant needs no conservation; remove it"
        );
        diagnostics.report(codes::CONSTANT_QUANTITY, psi.span, message);
        return None;
    }
    let formulas = formulas(dag, &region.field, &quantity);
    if psi.claim == Claim::Hamiltonian && is_by_construction(dag, variables, region, &quantity) {
        let domain = domain(&mut dag.clone(), &formulas, &place.sides, &BTreeSet::new());
        return report_empty(place, psi, &domain, diagnostics)
            .then_some((Conservation::ByConstruction, quantity));
    }
    let residual = rate(dag, quantity.by_time, &quantity.gradient, &region.field);
    let (verdict, formulas) = decide_in(dag, variables, place, residual, formulas);
    let roots: Vec<Id> = formulas.iter().copied().chain([residual]).collect();
    let refused = match verdict {
        Verdict::Proved => {
            let both = on_both_sides(&mut dag.clone(), variables, place, residual, &roots);
            let domain = domain(dag, &roots, &place.sides, &both);
            return report_empty(place, psi, &domain, diagnostics)
                .then_some((Conservation::Proved(domain.conditions), quantity));
        }
        Verdict::Refuted(counterexample) => {
            let message = format!(
                "`{name}` is not conserved{}: d/dt {name} = {}",
                in_region(region),
                refutation(dag, &counterexample)
            );
            (codes::NOT_CONSERVED, message)
        }
        verdict @ (Verdict::Undecided | Verdict::Exhausted) => {
            let domain = domain(&mut dag.clone(), &roots, &place.sides, &BTreeSet::new());
            if !report_empty(place, psi, &domain, diagnostics) {
                return None;
            }
            if psi.claim == Claim::Assumed {
                let evidence = assumed(dag, variables, region, &quantity, psi, diagnostics)?;
                return Some((evidence, quantity));
            }
            let found = match verdict {
                Verdict::Exhausted => {
                    "was not found to be zero before the work that proofs may take ran out; write it with fewer or shorter terms"
                }
                _ => "was found neither to be zero nor clearly not to be; write it in another way",
            };
            let message = format!(
                "`{name}` could not be proved to be conserved{}: d/dt {name} = {} {found}, or accept it with `assume conserved {name} = …;`, which checks it at many points",
                in_region(region),
                shortened(&to_text(dag, residual))
            );
            (codes::NOT_PROVED, message)
        }
    };
    let (code, message) = refused;
    diagnostics.report(code, psi.span, message);
    None
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

/// Reports a domain that is empty; whether it is not.
fn report_empty(
    place: &Place<'_>,
    psi: &Conserved,
    domain: &Domain,
    diagnostics: &mut Diagnostics,
) -> bool {
    let Some(contradiction) = &domain.contradiction else {
        return true;
    };
    let message = format!(
        "`{}` and its rate have no value anywhere{}: they need {contradiction}",
        psi.ident,
        in_region(place.region)
    );
    diagnostics.report(codes::EMPTY_DOMAIN, psi.span, message);
    false
}

/// On whose domain the proof holds: ψ, its derivatives, and the components of f that ψ depends
/// on.
pub(super) fn formulas(dag: &Dag, field: &[Id], quantity: &Quantity) -> Vec<Id> {
    let mut roots = vec![quantity.psi, quantity.by_time];
    for (&slope, &component) in quantity.gradient.iter().zip(field) {
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
            let message = format!(
                "`{name}` is assumed to be conserved{place}, but d/dt {name} is {} at {}, where its terms are of size {}",
                rounded(residual),
                coordinates(&point),
                rounded(size)
            );
            diagnostics.report(codes::ASSUMED_NOT_SMALL, psi.span, message);
            return None;
        }
        largest = largest.max(relative);
        if trials.usable == ENOUGH_POINTS {
            break;
        }
    }
    if trials.usable < FEWEST_POINTS {
        let message = format!(
            "`{name}` is assumed to be conserved{place}, but that can be checked at {} of {MOST_TRIALS} points only, and {FEWEST_POINTS} are needed: {}",
            trials.usable,
            trials.why_not(&name.to_string())
        );
        diagnostics.report(codes::ASSUMED_UNCHECKED, psi.span, message);
        return None;
    }
    Some(Conservation::Assumed {
        points: trials.usable,
        largest,
    })
}

/// The points at which ∂ₜψ + ∇ψ·f was evaluated.
#[derive(Default)]
struct Trials {
    /// Where the residual says something.
    usable: usize,
    /// Where ψ, f or a derivative has no value.
    undefined: usize,
    /// Where every term is zero, or is as small as its rounding error.
    without_terms: usize,
}

impl Trials {
    /// The residual and the size of its terms at a point where it says something; `values` are
    /// the `terms` terms, their sum, and everything else that has to be defined.
    fn judge(&mut self, values: &[(f64, f64)], terms: usize) -> Option<(f64, f64)> {
        if values.iter().any(|(value, _)| !value.is_finite()) {
            self.undefined += 1;
            return None;
        }
        let size: f64 = values
            .iter()
            .take(terms)
            .map(|(value, _)| value.abs())
            .sum();
        let &(residual, error) = values.get(terms)?;
        // a value without digits says nothing
        if size == 0.0 || error.is_nan() || error > SMALL * size {
            self.without_terms += 1;
            return None;
        }
        self.usable += 1;
        Some((residual, size))
    }

    /// Why the other points say nothing.
    fn why_not(&self, name: &str) -> String {
        let no_value = |count: usize| format!("its formulas have no value at {count}");
        let no_terms = |count: usize| {
            format!("the terms of d/dt {name} are zero up to rounding errors at {count}")
        };
        match (self.undefined, self.without_terms) {
            (undefined, 0) => no_value(undefined),
            (0, without_terms) => no_terms(without_terms),
            (undefined, without_terms) => {
                format!("{}, and {}", no_value(undefined), no_terms(without_terms))
            }
        }
    }
}
