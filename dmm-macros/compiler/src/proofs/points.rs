//! Points at which formulas are evaluated: the same in every run, with generic coordinates of
//! size one.

use std::collections::BTreeMap;

use super::Variables;
use crate::algebra::{Dag, Name, evaluate};

/// The ranges of the coordinates, in turn: positive ones, where roots and logarithms are real,
/// smaller ones, where arc sines are, and both signs.
const RANGES: [(f64, f64); 6] = [
    (0.1, 0.9),
    (-1.6, 2.1),
    (1.1, 3.0),
    (-0.9, 0.9),
    (0.01, 0.3),
    (-5.0, 5.0),
];

/// Point number 0, 1, 2, …: of two points, the parameters of one have their defaults.
pub(super) fn points(
    dag: &Dag,
    variables: &Variables,
) -> impl Iterator<Item = BTreeMap<Name, f64>> {
    let defaults: Vec<_> = variables.parameters.iter().map(|(_, id)| *id).collect();
    let defaults = evaluate(dag, &defaults, &BTreeMap::new());
    let parameters: Vec<(Name, f64)> = variables
        .parameters
        .iter()
        .map(|(name, _)| name.clone())
        .zip(defaults)
        .collect();
    let names = variables.all.clone();
    let ranges = RANGES.iter().flat_map(|range| [range; 2]).cycle();
    ranges.enumerate().map(move |(sample, &(low, high))| {
        let coordinate = |(index, name): (usize, &Name)| {
            let unit = unit(sample * names.len() + index + 1, index);
            (name.clone(), low + (high - low) * unit)
        };
        let mut point: BTreeMap<Name, f64> = names.iter().enumerate().map(coordinate).collect();
        if sample % 2 == 1 {
            point.extend(parameters.iter().cloned());
        }
        point
    })
}

/// A number in \[0, 1): the golden ratio's multiples modulo 1 are spread evenly.
fn unit(number: usize, index: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    (number as f64 * GOLDEN + (index as f64).sqrt() * GOLDEN).fract()
}
