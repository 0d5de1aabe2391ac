//! Matrices of large systems, most of whose entries are zero.

use crate::arithmetic::Matrix;
use crate::arithmetic::Scalar;

/// The R×C matrix with `entries`, each with its row and column, and zeros otherwise.
#[inline]
pub fn sparse<S: Scalar, const R: usize, const C: usize, const COUNT: usize>(
    entries: [((usize, usize), S); COUNT],
) -> Matrix<S, R, C> {
    let mut matrix = Matrix::from_element(S::from_f64(0.0));
    for (place, entry) in entries {
        matrix[place] = entry;
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_given_is_zero() {
        let matrix: Matrix<f64, 2, 3> = sparse([((0, 2), 1.0), ((1, 0), 2.0)]);
        assert_eq!(matrix, Matrix::from([[0.0, 2.0], [0.0, 0.0], [1.0, 0.0]]));
    }
}
