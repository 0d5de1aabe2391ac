//! Factors of matrices that are solved with several times, real or complex. Zeros are skipped: those of
//! a chain have a handful of entries a row.

use std::ops::{Mul, SubAssign};

use nalgebra::ComplexField;

/// P A = L U of a square matrix, by Gaussian elimination with partial pivoting.
#[derive(Clone, Debug)]
pub(crate) struct Factors<T> {
    /// The matrix, and what becomes of it, by columns.
    matrix: Vec<T>,
    /// The row that was exchanged with row k, in the order of the columns k.
    exchanged: Vec<usize>,
    /// 1/uₖₖ
    inverses: Vec<T>,
    /// What else is not zero, by columns, with its row: of U, then of L.
    entries: Vec<(usize, T)>,
    /// Where the entries of U and those of L end, by columns.
    ends: Vec<[usize; 2]>,
    /// Rows below a pivot that are not zero.
    rows: Vec<usize>,
}

impl<T> Default for Factors<T> {
    fn default() -> Self {
        Self {
            matrix: Vec::new(),
            exchanged: Vec::new(),
            inverses: Vec::new(),
            entries: Vec::new(),
            ends: Vec::new(),
            rows: Vec::new(),
        }
    }
}

impl<T: ComplexField<RealField = f64> + Copy> Factors<T> {
    /// Of a matrix by its columns, one after the other; nothing if a pivot is zero or not finite.
    pub(crate) fn new(size: usize, matrix: impl IntoIterator<Item = T>) -> Option<Self> {
        let mut factors = Self::default();
        factors.renew(size, matrix)?;
        Some(factors)
    }

    /// Makes them those of another matrix, in the same memory.
    pub(crate) fn renew(&mut self, size: usize, matrix: impl IntoIterator<Item = T>) -> Option<()> {
        let zero = T::zero();
        let Self {
            matrix: columns,
            exchanged,
            inverses,
            entries,
            ends,
            rows,
        } = self;
        columns.clear();
        columns.extend(matrix);
        exchanged.clear();
        inverses.clear();
        entries.clear();
        ends.clear();
        for k in 0..size {
            let (left, right) = columns.split_at_mut((k + 1) * size);
            let column = &mut left[k * size..];
            let length = |i: usize| column[i].norm1();
            let pivot = (k..size).max_by(|&i, &j| length(i).total_cmp(&length(j)))?;
            let inverse = T::one() / column[pivot];
            if !inverse.is_finite() {
                return None;
            }
            exchanged.push(pivot);
            inverses.push(inverse);
            column.swap(k, pivot);
            rows.clear();
            for (i, factor) in column.iter_mut().enumerate().skip(k + 1) {
                if *factor != zero {
                    *factor *= inverse;
                    rows.push(i);
                }
            }
            for other in right.chunks_exact_mut(size) {
                other.swap(k, pivot);
                let value = other[k];
                if value != zero {
                    for &i in &*rows {
                        other[i] -= value * column[i];
                    }
                }
            }
            // rows of L are exchanged as well
            for other in left[..k * size].chunks_exact_mut(size) {
                other.swap(k, pivot);
            }
        }
        for (k, column) in columns.chunks_exact(size).enumerate() {
            let (upper, lower) = column.split_at(k);
            let mut keep = |from: usize, part: &[T]| {
                let parts = part.iter().enumerate();
                let parts = parts.filter(|(_, entry)| **entry != zero);
                entries.extend(parts.map(|(i, &entry)| (from + i, entry)));
                entries.len()
            };
            ends.push([keep(0, upper), keep(k + 1, &lower[1..])]);
        }
        Some(())
    }

    /// Turns b into the solution of A·s = b.
    pub(crate) fn solve(&self, b: &mut [T]) {
        self.solve_over(b, |factor| factor);
    }

    /// The same over other scalars, of which `factor` makes those of an entry.
    pub(crate) fn solve_over<S>(&self, b: &mut [S], factor: impl Fn(T) -> S)
    where
        S: Copy + Mul<Output = S> + SubAssign,
    {
        for (k, &row) in self.exchanged.iter().enumerate() {
            b.swap(k, row);
        }
        for (k, &[upper, end]) in self.ends.iter().enumerate() {
            let value = b[k];
            for &(i, entry) in &self.entries[upper..end] {
                b[i] -= factor(entry) * value;
            }
        }
        for (k, &[upper, _]) in self.ends.iter().enumerate().rev() {
            let start = k.checked_sub(1).map_or(0, |before| self.ends[before][1]);
            b[k] = factor(self.inverses[k]) * b[k];
            let value = b[k];
            for &(i, entry) in &self.entries[start..upper] {
                b[i] -= factor(entry) * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Complex, DMatrix, DVector};

    use super::*;

    /// Entries of which most are zero, those of the diagonal at times too.
    fn matrix(size: usize, seed: usize) -> DMatrix<Complex<f64>> {
        let number = |k: usize| ((1 + k + seed) as f64).powi(2).sin();
        DMatrix::from_fn(size, size, |i, j| {
            let place = i * size + j;
            let is_there = (i + 3 * j + seed).is_multiple_of(4) || (i + 1) % size == j;
            if is_there {
                Complex::new(number(place), number(place + 7))
            } else {
                Complex::default()
            }
        })
    }

    fn factors<T>(matrix: &DMatrix<T>) -> Option<Factors<T>>
    where
        T: ComplexField<RealField = f64> + Copy,
    {
        Factors::new(matrix.nrows(), matrix.iter().copied())
    }

    #[test]
    fn solutions_solve() {
        for (size, seed) in [(1, 0), (2, 1), (5, 2), (17, 3), (40, 4)] {
            let a = matrix(size, seed);
            let exact = DVector::from_fn(size, |i, _| Complex::new(1.0 + i as f64, 0.3));
            let mut b = &a * &exact;
            factors(&a).expect("regular").solve(b.as_mut_slice());
            let bound = 1e-10 * exact.norm();
            assert!((b - exact).norm() < bound, "{size}");
        }
    }

    #[test]
    fn scalars_with_derivatives_are_solved_for() {
        use crate::arithmetic::Scalar;
        use crate::arithmetic::dual::Dual;
        let a = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 4.0, 1.0]);
        let factors = factors(&a).expect("regular");
        let mut b = [Dual::<f64, 1>::new(2.0, |_| 1.0), Dual::new(9.0, |_| 0.0)];
        factors.solve_over(&mut b, Dual::from_f64);
        assert_eq!([b[0].value, b[1].value], [2.0, 1.0]);
        assert_eq!([b[0].parts[0], b[1].parts[0]], [-0.125, 0.5]);
    }

    #[test]
    fn singular_matrices_have_none() {
        for a in [
            DMatrix::zeros(3, 3),
            DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0]),
            DMatrix::from_element(2, 2, f64::NAN),
        ] {
            assert!(factors(&a).is_none(), "{a}");
        }
    }
}
