//! Independence of conserved quantities: ΛΛᵀ has to have an inverse at generic points, so that
//! the rows of Λ = ∇ψ are linearly independent there, and M of them in N states leave N − M
//! directions to move in.

use std::collections::BTreeMap;

use super::{Quantity, Variables, in_region};
use crate::algebra::{Dag, Id, Name, evaluate};
use crate::diagnostics::Diagnostics;
use crate::model::Region;

/// Gradients are compared at this many points; fewer than a quarter of them in the domain of
/// the formulas say nothing.
const SAMPLES: usize = 32;
/// A gradient depends on others if what is left of it, after projecting them out, is smaller
/// than this part of it: far above rounding, far below what an independent one leaves at all
/// of the sample points.
const DEPENDENT: f64 = 1e-9;

/// Reports quantities of which there are too many, or that depend on one another.
pub(super) fn check(
    dag: &Dag,
    variables: &Variables,
    region: &Region,
    quantities: &[Quantity<'_>],
    diagnostics: &mut Diagnostics,
) {
    let n = variables.states.len();
    let place = in_region(region);
    if let Some(first_too_many) = quantities.get(n) {
        let message = format!(
            "{} conserved quantities of {n} states depend on one another{place}: leave out {}",
            quantities.len(),
            quantities.len() - n
        );
        diagnostics.error(first_too_many.declared.span, message);
        return;
    }
    if let Some(dependent) = first_dependent(dag, variables, quantities)
        && let Some(quantity) = quantities.get(dependent)
    {
        let others: Vec<String> = quantities
            .iter()
            .take(dependent)
            .map(|other| format!("`{}`", other.declared.ident))
            .collect();
        let message = format!(
            "`{}` depends on {}{place}: their gradients are linearly dependent; remove it",
            quantity.declared.ident,
            others.join(", ")
        );
        diagnostics.error(quantity.declared.span, message);
        return;
    }
    if quantities.len() == n
        && quantities.iter().all(|quantity| quantity.autonomous)
        && let Some(last) = quantities.last()
    {
        let message = format!(
            "{n} independent conserved quantities of {n} states leave nothing to move{place}: declare one less, or none where the vector field is zero"
        );
        diagnostics.error(last.declared.span, message);
    }
}

/// The first quantity whose gradient depends on those before it at every sample point.
fn first_dependent(dag: &Dag, variables: &Variables, quantities: &[Quantity<'_>]) -> Option<usize> {
    if quantities.len() < 2 {
        return None;
    }
    let n = variables.states.len();
    let roots: Vec<Id> = quantities
        .iter()
        .flat_map(|q| q.gradient.iter().copied())
        .collect();
    let mut in_domain = 0;
    let mut dependent = vec![true; quantities.len()];
    for point in sample_points(&variables.all) {
        let values = evaluate(dag, &roots, &point);
        if values.iter().any(|value| !value.is_finite()) {
            continue;
        }
        in_domain += 1;
        let rows: Vec<&[f64]> = values.chunks(n).collect();
        for (flag, here) in dependent.iter_mut().zip(dependencies(&rows)) {
            *flag &= here;
        }
    }
    if in_domain < SAMPLES / 4 {
        return None;
    }
    dependent.iter().position(|&flag| flag)
}

/// Which rows depend on the rows before them, by orthogonal projection (modified Gram–Schmidt,
/// twice, which is enough).
fn dependencies(rows: &[&[f64]]) -> Vec<bool> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    rows.iter()
        .map(|row| {
            let size = norm(row);
            let mut rest = row.to_vec();
            for _ in 0..2 {
                for direction in &basis {
                    let along: f64 = rest.iter().zip(direction).map(|(a, b)| a * b).sum();
                    for (component, unit) in rest.iter_mut().zip(direction) {
                        *component -= along * unit;
                    }
                }
            }
            let left = norm(&rest);
            if left <= DEPENDENT * size {
                return true;
            }
            basis.push(rest.iter().map(|component| component / left).collect());
            false
        })
        .collect()
}

fn norm(row: &[f64]) -> f64 {
    row.iter()
        .map(|component| component * component)
        .sum::<f64>()
        .sqrt()
}

/// Points with generic coordinates, half of them positive only, where roots and logarithms are
/// real. They are the same in every run.
fn sample_points(variables: &[Name]) -> impl Iterator<Item = BTreeMap<Name, f64>> {
    // the golden ratio's multiples modulo 1 are spread evenly
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    (0..SAMPLES).map(move |sample| {
        let coordinate = |(index, name): (usize, &Name)| {
            let number = (sample * variables.len() + index + 1) as f64;
            let unit = (number * GOLDEN + (index as f64).sqrt() * GOLDEN).fract();
            let value = if sample % 2 == 0 {
                0.1 + 0.8 * unit
            } else {
                3.7 * unit - 1.6
            };
            (name.clone(), value)
        };
        variables.iter().enumerate().map(coordinate).collect()
    })
}
