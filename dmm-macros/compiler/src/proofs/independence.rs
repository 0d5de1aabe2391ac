//! Independence of conserved quantities: ΛΛᵀ has to have an inverse at generic points, so that
//! the rows of Λ = ∇ψ are linearly independent there, and M of them in N states leave N − M
//! directions to move in.
//!
//! - They are independent at generic points if one M×M minor of Λ is not zero at one point,
//!   which Gaussian elimination in interval arithmetic proves: formulas are analytic, so that
//!   the minor then vanishes on a set without interior only.
//! - The set where they become dependent is where all minors vanish, which the normal form of
//!   the minors gives if there are few and small ones.
//! - A row depends on those before it, everywhere, if one minor of these is not zero, and all
//!   minors that border it with the row and one more column are proved to be (Kronecker).

use std::collections::BTreeMap;

use super::message::RegionProblem;
use super::points::points;
use super::{Independence, Quantity, Variables};
use crate::algebra::evaluate::{Interval, enclose};
use crate::algebra::linear::determinant;
use crate::algebra::normal_form::common_zeros;
use crate::algebra::{Dag, Id, Name, evaluate, is_proved_zero};

/// Points at which gradients are compared.
const SAMPLES: usize = 48;
/// A gradient seems to depend on others if what is left of it, after projecting them out, is
/// smaller than this part of it: far above rounding, far below what an independent one leaves.
const DEPENDENT: f64 = 1e-9;
/// The set of dependence is looked for among this many minors …
const MOST_MINORS: usize = 20;
/// … of this many rows, …
const MOST_ROWS: usize = 4;
/// … and told if it is written with this many nodes.
const MOST_NODES: usize = 160;

/// What is known of the independence of `quantities`, or why there cannot be as many; of a motion that
/// `may_rest` there can be as many as states.
pub(super) fn examine(
    dag: &mut Dag,
    variables: &Variables,
    quantities: &[Quantity],
    may_rest: bool,
) -> Result<Independence, RegionProblem> {
    let (n, count) = (variables.states.len(), quantities.len());
    if count == 0 {
        // no rows are independent everywhere
        return Ok(Independence::Proved {
            factors: Vec::new(),
            minors: Vec::new(),
        });
    }
    if count > n {
        return Err(RegionProblem::TooMany { states: n });
    }
    let rows: Vec<&[Id]> = (quantities.iter())
        .map(|quantity| quantity.derivatives.gradient.as_slice())
        .collect();
    let formulas: Vec<Id> = quantities.iter().map(|q| q.psi).collect();
    let sampled = sample(dag, variables, &rows, &formulas);
    if let Some(dependent) = &sampled.dependent
        && is_proved_dependent(dag, &rows, dependent)
    {
        return Err(RegionProblem::Dependent { row: dependent.row });
    }
    if !sampled.independent {
        return Ok(Independence::Undecided);
    }
    if !may_rest && count == n && quantities.iter().all(|quantity| quantity.autonomous) {
        return Err(RegionProblem::NothingMoves);
    }
    Ok(set_of_dependence(dag, &rows).unwrap_or(Independence::Generic))
}

/// What the sample points say.
struct Sampled {
    /// Whether a minor of all rows is proved not to be zero at a point.
    independent: bool,
    /// The first row that seems to depend on those before it at every point.
    dependent: Option<Dependent>,
}

/// A row that seems to depend on those before it.
struct Dependent {
    row: usize,
    /// The columns of a minor of the rows before it that is proved not to be zero at a point.
    columns: Vec<usize>,
}

fn sample(dag: &Dag, variables: &Variables, rows: &[&[Id]], formulas: &[Id]) -> Sampled {
    let n = variables.states.len();
    let roots: Vec<Id> = rows.iter().flat_map(|row| row.iter().copied()).collect();
    let mut dependent = vec![true; rows.len()];
    let mut in_domain: Vec<BTreeMap<Name, f64>> = Vec::new();
    for point in points(dag, variables).take(SAMPLES) {
        let values = evaluate(dag, &roots, &point);
        if values.iter().any(|value| !value.is_finite()) {
            continue;
        }
        let values: Vec<&[f64]> = values.chunks(n).collect();
        let here = dependencies(&values);
        let full = here.iter().all(|&flag| !flag);
        if full && columns_of_minor(dag, rows, formulas, &point).is_some() {
            return Sampled {
                independent: true,
                dependent: None,
            };
        }
        for (flag, here) in dependent.iter_mut().zip(here) {
            *flag &= here;
        }
        in_domain.push(point);
    }
    let row = dependent.iter().position(|&flag| flag);
    let dependent = row.filter(|_| !in_domain.is_empty()).and_then(|row| {
        let before = rows.get(..row)?;
        let columns = in_domain
            .iter()
            .find_map(|point| columns_of_minor(dag, before, formulas, point))?;
        Some(Dependent { row, columns })
    });
    Sampled {
        independent: false,
        dependent,
    }
}

/// Columns of a minor of `rows` that is proved not to be zero at `point`: every pivot of a
/// Gaussian elimination in intervals excludes zero.
fn columns_of_minor(
    dag: &Dag,
    rows: &[&[Id]],
    formulas: &[Id],
    point: &BTreeMap<Name, f64>,
) -> Option<Vec<usize>> {
    if !enclose(dag, formulas, point)
        .iter()
        .all(|value| value.defined)
    {
        return None;
    }
    let mut matrix: Vec<Vec<Interval>> = rows.iter().map(|row| enclose(dag, row, point)).collect();
    if !matrix.iter().flatten().all(|entry| entry.defined) {
        return None;
    }
    let mut columns = Vec::new();
    for row in 0..matrix.len() {
        let (done, rest) = matrix.split_at_mut(row + 1);
        let pivot_row = done.last()?;
        let size = |entry: &Interval| entry.low.max(-entry.high);
        let (column, pivot) = pivot_row
            .iter()
            .enumerate()
            .filter(|(_, entry)| entry.nonzero)
            .max_by(|a, b| size(a.1).total_cmp(&size(b.1)))?;
        for other in rest {
            let factor = *other.get(column)? / *pivot;
            for (entry, above) in other.iter_mut().zip(pivot_row) {
                *entry = *entry - factor * *above;
            }
            // it is zero by construction
            *other.get_mut(column)? = Interval::point(0.0);
        }
        columns.push(column);
    }
    Some(columns)
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

/// Whether every minor that borders the one of `dependent` is proved to be zero.
fn is_proved_dependent(dag: &mut Dag, rows: &[&[Id]], dependent: &Dependent) -> bool {
    let Some(bordered) = rows.get(..=dependent.row) else {
        return false;
    };
    let n = bordered.first().map_or(0, |row| row.len());
    if bordered.len() > MOST_ROWS + 1 {
        return false;
    }
    (0..n)
        .filter(|column| !dependent.columns.contains(column))
        .all(|column| {
            let mut columns = dependent.columns.clone();
            columns.push(column);
            let minor = determinant(dag, bordered, &columns);
            is_proved_zero(dag, minor)
        })
}

/// Where all minors of `rows` vanish, if they are few and the answer is short.
fn set_of_dependence(dag: &mut Dag, rows: &[&[Id]]) -> Option<Independence> {
    let n = rows.first()?.len();
    if rows.len() > MOST_ROWS {
        return None;
    }
    let choices = choices(n, rows.len(), MOST_MINORS)?;
    let minors: Vec<Id> = choices
        .iter()
        .map(|columns| determinant(dag, rows, columns))
        .collect();
    let zeros = common_zeros(dag, &minors)?;
    let nodes: usize = zeros
        .factors
        .iter()
        .chain(&zeros.cofactors)
        .map(|&id| dag.tree_size(id))
        .sum();
    (nodes <= MOST_NODES).then_some(Independence::Proved {
        factors: zeros.factors,
        minors: zeros.cofactors,
    })
}

/// The subsets of `count` columns of `n`, unless there are more than `most`.
fn choices(n: usize, count: usize, most: usize) -> Option<Vec<Vec<usize>>> {
    let mut subsets: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..count {
        let mut longer = Vec::new();
        for subset in &subsets {
            let first = subset.last().map_or(0, |&last| last + 1);
            for column in first..n {
                let mut extended = subset.clone();
                extended.push(column);
                longer.push(extended);
            }
        }
        subsets = longer;
        if subsets.len() > most.saturating_mul(4) {
            return None;
        }
    }
    (subsets.len() <= most).then_some(subsets)
}
