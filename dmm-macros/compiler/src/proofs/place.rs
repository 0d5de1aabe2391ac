//! Whether an expression is zero where a region is and its vector field has values.
//!
//! What a region says of signs goes into the proof: of a side u > 0, ln u is among the formulas
//! that have a value. Variables that are negative in the region are replaced by their opposites
//! for the proof, because the normal form knows what is positive. A point at which the
//! expression is not zero counts if it lies in the region and f has a value there.

use std::collections::{BTreeMap, HashMap};

use super::Variables;
use super::conditions::negative_variables;
use super::points::points;
use crate::algebra::normal_form::decide_zero_on;
use crate::algebra::{
    Counterexample, Dag, Function, Id, Name, Verdict, evaluate, evaluate_bounded, gradient,
    normalise,
};

/// Points tried where those of the normal form have not told.
const TRIALS: usize = 512;
/// Steps towards a region from a point outside.
const STEPS: usize = 8;
/// A value is clearly not zero where it exceeds the bound of its rounding error by this factor.
const CLEARLY: f64 = 1e4;

/// Whether `root` is zero where `formulas` have values and every one of `sides` is positive.
pub(super) fn decide(
    dag: &mut Dag,
    variables: &Variables,
    root: Id,
    formulas: &[Id],
    sides: &[Id],
) -> Verdict {
    let mut domain = formulas.to_vec();
    for &side in sides {
        domain.push(dag.call(Function::Ln, side));
    }
    let opposites = opposites(dag, &domain);
    let turned: Vec<Id> = domain
        .iter()
        .map(|&formula| dag.substitute(formula, &opposites))
        .collect();
    let turned_root = dag.substitute(root, &opposites);
    match decide_zero_on(dag, turned_root, &turned) {
        Verdict::Proved => Verdict::Proved,
        Verdict::Refuted(found) => Verdict::Refuted(turned_back(dag, found, &opposites)),
        open @ (Verdict::Undecided | Verdict::Exhausted) => {
            match refute(dag, variables, root, &domain, sides) {
                Some(found) => Verdict::Refuted(found),
                None => open,
            }
        }
    }
}

/// The variables that are not positive wherever `domain` has values, with their opposites.
fn opposites(dag: &mut Dag, domain: &[Id]) -> HashMap<Name, Id> {
    let mut opposites = HashMap::new();
    for name in negative_variables(dag, domain) {
        let variable = dag.variable(&name);
        opposites.insert(name, dag.neg(variable));
    }
    opposites
}

/// A counterexample in the variables themselves.
fn turned_back(
    dag: &mut Dag,
    found: Counterexample,
    opposites: &HashMap<Name, Id>,
) -> Counterexample {
    let turn = |(name, value): (Name, f64)| {
        if opposites.contains_key(&name) {
            (name, -value)
        } else {
            (name, value)
        }
    };
    Counterexample {
        residual: dag.substitute(found.residual, opposites),
        point: found.point.into_iter().map(turn).collect(),
        value: found.value,
    }
}

/// A point in the region at which `root` is clearly not zero and `domain` has values.
fn refute(
    dag: &mut Dag,
    variables: &Variables,
    root: Id,
    domain: &[Id],
    sides: &[Id],
) -> Option<Counterexample> {
    let slopes: Vec<Vec<Id>> = (sides.iter())
        .map(|&side| gradient(dag, side, &variables.all))
        .collect();
    let roots: Vec<Id> = [root].into_iter().chain(domain.iter().copied()).collect();
    let inside = points(dag, variables)
        .take(TRIALS)
        .map(|point| moved_inside(dag, variables, point, sides, &slopes));
    let (point, value) = inside.into_iter().find_map(|point| {
        let values = evaluate_bounded(dag, &roots, &point);
        let &(value, error) = values.first()?;
        let defined = values.iter().all(|(value, _)| value.is_finite());
        (defined && value.abs() > CLEARLY * error).then_some((point, value))
    })?;
    let residual = normalise(dag, root)
        .filter(|&normal| dag.tree_size(normal) <= dag.tree_size(root))
        .unwrap_or(root);
    Some(Counterexample {
        residual,
        point: point.into_iter().collect(),
        value,
    })
}

/// `point`, or a point that Newton's method leads to from there, where `sides` are positive.
fn moved_inside(
    dag: &Dag,
    variables: &Variables,
    mut point: BTreeMap<Name, f64>,
    sides: &[Id],
    slopes: &[Vec<Id>],
) -> BTreeMap<Name, f64> {
    for _ in 0..STEPS {
        let values = evaluate(dag, sides, &point);
        let outside = values.iter().zip(slopes).find(|(value, _)| **value <= 0.0);
        let Some((&value, slopes)) = outside else {
            break;
        };
        let slopes = evaluate(dag, slopes, &point);
        let square: f64 = slopes.iter().map(|slope| slope * slope).sum();
        if !(square > 0.0 && square.is_finite()) {
            break;
        }
        // beyond the zero, by about as far as a coordinate is large
        let length = (square.sqrt() - value) / square;
        for (name, slope) in variables.all.iter().zip(slopes) {
            if let Some(coordinate) = point.get_mut(name) {
                *coordinate += length * slope;
            }
        }
    }
    point
}
