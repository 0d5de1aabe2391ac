//! Sums of products: scalar products and determinants.

use super::{Dag, Id};

/// Σ aᵢ bᵢ
pub fn dot(dag: &mut Dag, a: &[Id], b: &[Id]) -> Id {
    let terms: Vec<Id> = a.iter().zip(b).map(|(&a, &b)| dag.mul(a, b)).collect();
    dag.sum(terms)
}

/// The determinant of the square matrix of `columns` of `rows`, by the first row.
pub fn determinant<R: AsRef<[Id]>>(dag: &mut Dag, rows: &[R], columns: &[usize]) -> Id {
    let Some((first, rest)) = rows.split_first() else {
        return dag.integer(1);
    };
    let mut sum = dag.integer(0);
    for (position, &column) in columns.iter().enumerate() {
        let entry = match first.as_ref().get(column) {
            Some(&entry) if !dag.is_zero(entry) => entry,
            _ => continue,
        };
        let mut others = columns.to_vec();
        others.remove(position);
        let minor = determinant(dag, rest, &others);
        let term = dag.mul(entry, minor);
        sum = if position % 2 == 0 {
            dag.add(sum, term)
        } else {
            dag.sub(sum, term)
        };
    }
    sum
}
