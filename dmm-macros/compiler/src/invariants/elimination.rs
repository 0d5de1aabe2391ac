//! The null space of a matrix modulo a prime, row by row.
//!
//! Columns are eliminated from the first to the last, so that the vector of a free column has
//! entries in columns before it only: if the columns are ordered by degree, each vector has the
//! least degree that it can have.

use super::field::{Field, NARROW};

/// Products of two residues that can be added before they are reduced.
const LAZY: usize = 14;

/// A matrix in echelon form that grows by rows.
pub(super) struct Echelon {
    columns: usize,
    /// By its first column, the rest of a row from there on, which begins with 1.
    pivots: Vec<Option<Vec<u32>>>,
    rank: usize,
}

/// A row on its way: entries are sums of products that were not reduced yet.
struct Row {
    entries: Vec<u64>,
    pending: usize,
}

impl Row {
    /// The entry of a column, reduced.
    fn leading(&mut self, column: usize) -> u64 {
        match self.entries.get_mut(column) {
            Some(entry) => {
                *entry %= NARROW.p;
                *entry
            }
            None => 0,
        }
    }

    /// Takes the multiple of a pivot away that makes this column zero.
    fn reduce(&mut self, column: usize, pivot: &[u32]) {
        let leading = self.leading(column);
        if leading == 0 {
            return;
        }
        let factor = NARROW.p - leading;
        let rest = self.entries.get_mut(column..).unwrap_or_default();
        for (entry, &value) in rest.iter_mut().zip(pivot) {
            *entry += factor * u64::from(value);
        }
        self.pending += 1;
        if self.pending == LAZY {
            self.pending = 0;
            rest.iter_mut().for_each(|entry| *entry %= NARROW.p);
        }
    }
}

/// An entry other than zero: column and value.
pub(super) type Entry = (usize, u64);

impl Echelon {
    pub(super) fn new(columns: usize) -> Self {
        Self {
            columns,
            pivots: vec![None; columns],
            rank: 0,
        }
    }

    pub(super) fn rank(&self) -> usize {
        self.rank
    }

    /// Adds rows of residues modulo the narrow prime. Rows that come together are reduced by each
    /// pivot together, which is then read from memory once.
    pub(super) fn insert(&mut self, rows: Vec<Vec<u64>>) {
        let mut rows: Vec<Row> = rows
            .into_iter()
            .map(|entries| Row {
                entries,
                pending: 0,
            })
            .collect();
        for (column, pivot) in self.pivots.iter().enumerate() {
            if let Some(pivot) = pivot {
                rows.iter_mut().for_each(|row| row.reduce(column, pivot));
            }
        }
        // What is left concerns the pivots that these rows become themselves.
        for mut row in rows {
            for column in 0..self.columns {
                if row.leading(column) == 0 {
                    continue;
                }
                match self.pivots.get(column) {
                    Some(Some(pivot)) => row.reduce(column, pivot),
                    _ => {
                        self.add_pivot(column, &row.entries);
                        break;
                    }
                }
            }
        }
    }

    fn add_pivot(&mut self, column: usize, row: &[u64]) {
        let entries = row.get(column..).unwrap_or_default();
        let first = entries.first().map_or(0, |first| first % NARROW.p);
        let Some(inverse) = NARROW.inverse(first) else {
            return;
        };
        let scaled = entries
            .iter()
            .map(|entry| NARROW.mul(entry % NARROW.p, inverse) as u32);
        let scaled = scaled.collect();
        if let Some(place) = self.pivots.get_mut(column) {
            *place = Some(scaled);
            self.rank += 1;
        }
    }

    /// The columns that are combinations of those before them.
    pub(super) fn free_columns(&self) -> Vec<usize> {
        let columns = self.pivots.iter().enumerate();
        let free = columns.filter(|(_, pivot)| pivot.is_none());
        free.map(|(column, _)| column).collect()
    }

    /// The vector of the null space that is 1 in this free column and 0 in the others.
    pub(super) fn null_vector(&self, free: usize) -> Vec<Entry> {
        let mut entries: Vec<Entry> = vec![(free, 1)];
        for column in (0..free).rev() {
            let Some(Some(pivot)) = self.pivots.get(column) else {
                continue;
            };
            let sum = entries.iter().fold(0, |sum, &(other, value)| {
                let coefficient = pivot.get(other - column).copied().unwrap_or(0);
                NARROW.add(sum, NARROW.mul(u64::from(coefficient), value))
            });
            if sum != 0 {
                entries.push((column, NARROW.neg(sum)));
            }
        }
        entries.reverse();
        entries
    }
}

/// The solution of a small system Σ aⱼ xⱼ + b = 0, each row with b last; `None` unless there is
/// just one.
pub(super) fn solve(field: Field, rows: &[Vec<u64>], unknowns: usize) -> Option<Vec<u64>> {
    let mut rows = rows.to_vec();
    for column in 0..unknowns {
        let found = (column..rows.len()).find(|&row| entry(&rows, row, column) != 0)?;
        rows.swap(column, found);
        let inverse = field.inverse(entry(&rows, column, column))?;
        let pivot: Vec<u64> = rows
            .get(column)?
            .iter()
            .map(|&v| field.mul(v, inverse))
            .collect();
        for (index, row) in rows.iter_mut().enumerate() {
            let factor = row.get(column).copied().unwrap_or(0);
            if index == column || factor == 0 {
                continue;
            }
            let factor = field.neg(factor);
            for (value, &other) in row.iter_mut().zip(&pivot) {
                *value = field.add(*value, field.mul(factor, other));
            }
        }
        if let Some(place) = rows.get_mut(column) {
            *place = pivot;
        }
    }
    let is_consistent = rows
        .iter()
        .skip(unknowns)
        .all(|row| row.iter().all(|&value| value == 0));
    is_consistent.then(|| {
        (0..unknowns)
            .map(|row| field.neg(entry(&rows, row, unknowns)))
            .collect()
    })
}

fn entry(rows: &[Vec<u64>], row: usize, column: usize) -> u64 {
    let row = rows.get(row).and_then(|row| row.get(column));
    row.copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn null_vectors_have_the_least_degree() {
        let mut echelon = Echelon::new(4);
        // x₀ + 2x₁ + x₃ = 0, x₂ = 0
        let rows = [[1, 2, 0, 1], [1, 2, 3, 1], [2, 4, 0, 2]].map(|row| row.to_vec());
        echelon.insert(rows.to_vec());
        assert_eq!(echelon.rank(), 2);
        assert_eq!(echelon.free_columns(), [1, 3]);
        assert_eq!(echelon.null_vector(1), [(0, NARROW.p - 2), (1, 1)]);
        assert_eq!(echelon.null_vector(3), [(0, NARROW.p - 1), (3, 1)]);
    }

    #[test]
    fn lazy_sums_do_not_overflow() {
        let n = 60;
        let mut random = super::super::field::Random(7);
        let mut echelon = Echelon::new(n + 1);
        let mut rows = Vec::new();
        for _ in 0..n {
            let row: Vec<u64> = (0..=n).map(|_| NARROW.p - 1 - random.below(9)).collect();
            rows.push(row);
        }
        for part in rows.chunks(7) {
            echelon.insert(part.to_vec());
        }
        let vector = echelon.null_vector(n);
        for row in rows {
            let product = vector.iter().fold(0, |sum, &(column, value)| {
                NARROW.add(sum, NARROW.mul(row[column], value))
            });
            assert_eq!(product, 0);
        }
    }

    #[test]
    fn small_systems_are_solved() {
        let field = NARROW;
        // x + y − 3 = 0, x − y − 1 = 0
        let rows = vec![vec![1, 1, field.p - 3], vec![1, field.p - 1, field.p - 1]];
        assert_eq!(solve(field, &rows, 2), Some(vec![2, 1]));
        assert_eq!(solve(field, &rows[..1], 2), None);
    }
}
