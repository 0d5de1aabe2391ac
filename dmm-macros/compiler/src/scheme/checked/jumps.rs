//! Whether ψ jumps where something that it divides by is zero: its limits from both sides, at
//! points of that set.
//!
//! Formulas are analytic but for their zeros and roots, so that limits which differ somewhere on
//! a piece of the set differ at almost every point of it. A pole is no jump: no trajectory on a
//! level of ψ comes to it.

use std::collections::{BTreeMap, HashMap};

use egg::Language;

use crate::algebra::evaluate::Interval;
use crate::algebra::{Dag, Domain, Function, Id, Math, Name, evaluate};
use crate::model::{Model, Parameter};

/// Points of the set.
const POINTS: usize = 24;
/// Variables have values between these ends.
const RANGE: (f64, f64) = (-2.5, 2.5);
/// Places between which a zero is looked for.
const PLACES: usize = 33;
/// Halvings of the distance between two places, which leave rounding errors.
const HALVINGS: usize = 60;
/// Distances from the zero, from which the limits are read.
const DISTANCES: [f64; 3] = [1e-3, 1e-4, 1e-5];
/// The change of a value from one distance to the next is this part of a jump at most.
const SETTLED: f64 = 0.25;
/// A jump is this part of the values on both sides at least.
const CLEAR: f64 = 1e-2;

/// Whether ψ jumps where `zero` is zero.
pub(super) fn jumps(
    dag: &Dag,
    (states, parameters): (&[Name], &[Parameter]),
    psi: Id,
    zero: Id,
) -> bool {
    let range = Interval::of(dag, zero);
    let keeps_sign = range.is_not_negative() || range.is_not_positive();
    if keeps_sign || !may_jump(dag, psi) {
        return false;
    }
    let defaults: Vec<Id> = parameters.iter().map(|one| one.default).collect();
    let defaults = evaluate(dag, &defaults, &BTreeMap::new());
    let (dag, [psi, zero]) = &alone(dag, [psi, zero]);
    let (psi, zero) = (*psi, *zero);
    let moving: Vec<Name> = states.iter().cloned().chain([Model::time()]).collect();
    (0..POINTS).any(|number| {
        let mut point = BTreeMap::new();
        for (index, name) in moving.iter().enumerate() {
            point.insert(
                name.clone(),
                RANGE.0 + (RANGE.1 - RANGE.0) * unit(number, index),
            );
        }
        for (index, (parameter, &default)) in parameters.iter().zip(&defaults).enumerate() {
            // integers as well, at which powers of both signs have values
            let other = (4.0 * unit(number, moving.len() + index)).floor() - 1.5;
            let value = match number % 3 {
                0 => default,
                1 => other + 0.5,
                _ => 1.0 + unit(number, moving.len() + index),
            };
            point.insert(parameter.name.clone(), value);
        }
        moving
            .iter()
            .any(|name| jumps_along(dag, name, &point, psi, zero))
    })
}

/// Whether ψ may jump at all: it has a root, or a function of something that is divided. What is
/// made by sums, products and quotients of analytic functions has poles and no jumps.
fn may_jump(dag: &Dag, psi: Id) -> bool {
    let mut divides: HashMap<Id, bool> = HashMap::new();
    for id in dag.reachable([psi]) {
        let node = &dag[id];
        let below = node.any(|child| divides.get(&child).copied().unwrap_or(true));
        let jumps = match *node {
            Math::Call(function, _) => below || matches!(function, Function::Sqrt | Function::Abs),
            Math::Pow([_, v]) if dag.as_integer(v).is_none() => true,
            _ => false,
        };
        if jumps {
            return true;
        }
        let divides_here = match *node {
            Math::Div(_) => true,
            Math::Call(function, _) => {
                matches!(function.properties().domain, Domain::NonZero(_))
            }
            Math::Pow([_, v]) => dag.as_integer(v).is_none_or(|n| n < 0),
            _ => false,
        };
        divides.insert(id, below || divides_here);
    }
    false
}

/// A DAG of some roots alone, which is evaluated faster.
fn alone(dag: &Dag, roots: [Id; 2]) -> (Dag, [Id; 2]) {
    let mut copy = Dag::new();
    let mut image: HashMap<Id, Id> = HashMap::new();
    for id in dag.reachable(roots) {
        let node = dag[id].clone();
        let node = node.map_children(|child| image.get(&child).copied().unwrap_or(child));
        image.insert(id, copy.insert(node));
    }
    let roots = roots.map(|root| image.get(&root).copied().unwrap_or(root));
    (copy, roots)
}

/// Whether ψ jumps at a zero on the line along a variable.
fn jumps_along(dag: &Dag, name: &Name, point: &BTreeMap<Name, f64>, psi: Id, zero: Id) -> bool {
    if !dag.depends_on(zero, name) {
        return false;
    }
    let at = |root: Id, place: f64| {
        let mut point = point.clone();
        point.insert(name.clone(), place);
        evaluate(dag, &[root], &point)
            .first()
            .copied()
            .unwrap_or(f64::NAN)
    };
    let width = (RANGE.1 - RANGE.0) / PLACES as f64;
    (0..PLACES).any(|place| {
        // a zero in the middle of the range is between two places
        let mut low = RANGE.0 + width * place as f64;
        let mut high = low + width;
        let (start, end) = (at(zero, low), at(zero, high));
        let changes_sign = start * end < 0.0;
        if !changes_sign {
            return false;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if at(zero, middle) * start > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let values =
            DISTANCES.map(|distance| [low - distance, high + distance].map(|x| at(psi, x)));
        is_jump(&values)
    })
}

/// Whether values at smaller and smaller distances on both sides have limits that differ.
fn is_jump(values: &[[f64; 2]; 3]) -> bool {
    let [_, [below_before, above_before], [below, above]] = *values;
    let jump = (above - below).abs();
    let change = (above - above_before)
        .abs()
        .max((below - below_before).abs());
    let size = above.abs().max(below.abs());
    jump.is_finite()
        && change <= SETTLED * jump
        && jump >= CLEAR * size.min(1.0)
        && jump > 1e-3 * size
}

/// A number in \[0, 1): the golden ratio's multiples modulo 1 are spread evenly.
fn unit(number: usize, index: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    ((number + 1) as f64 * GOLDEN * (index as f64 + 1.0).sqrt() + index as f64 * GOLDEN).fract()
}
