//! The matrix A⁻¹ of an implicit Runge–Kutta method on its eigenvectors, on which the stages of a
//! linear field are independent of each other (Butcher 1976; Hairer & Wanner, Solving Ordinary
//! Differential Equations II, section IV.8).

use nalgebra::{Complex, DMatrix, DVector};

/// An eigenvalue of A⁻¹; of two that are conjugate, that with the positive imaginary part.
#[derive(Clone, Debug)]
pub(super) struct Eigen {
    pub(super) value: Complex<f64>,
    /// The eigenvector, twice where it stands for its conjugate as well: Δz = Re Σ vector · Δw.
    pub(super) vector: Vec<Complex<f64>>,
    /// Its row in the inverse of the matrix of all eigenvectors: w = row · z.
    pub(super) row: Vec<Complex<f64>>,
}

/// A⁻¹ = T Λ T⁻¹. Only the iterations for the stages use it, not their equations: its rounding
/// errors do not enter the solution.
#[derive(Clone, Debug)]
pub(super) struct Transform {
    pub(super) eigen: Vec<Eigen>,
}

impl Transform {
    /// Of a regular A with different eigenvalues.
    pub(super) fn new(a: &[&[f64]]) -> Self {
        let size = a.len();
        let matrix = DMatrix::from_fn(size, size, |i, j| a[i][j]);
        let inverse = matrix.try_inverse().unwrap_or_default();
        let values = inverse.complex_eigenvalues();
        let complex = inverse.map(Complex::from);
        let vectors: Vec<_> = values.iter().map(|&v| eigenvector(&complex, v)).collect();
        let rows = DMatrix::from_columns(&vectors).try_inverse();
        let rows = rows.unwrap_or_default();
        let eigen = values.iter().zip(&vectors).enumerate();
        let eigen = eigen.filter(|(_, (value, _))| value.im >= 0.0);
        let eigen = eigen.map(|(k, (&value, vector))| {
            let count = if value.im > 0.0 { 2.0 } else { 1.0 };
            Eigen {
                value,
                vector: vector.iter().map(|&entry| entry * count).collect(),
                row: rows.row(k).iter().copied().collect(),
            }
        });
        Self {
            eigen: eigen.collect(),
        }
    }
}

/// The eigenvector of an eigenvalue that is known to rounding, by inverse iteration.
fn eigenvector(matrix: &DMatrix<Complex<f64>>, value: Complex<f64>) -> DVector<Complex<f64>> {
    let size = matrix.nrows();
    // not singular to rounding
    let shifted = value + 1e-10 * value.norm();
    let lu = (matrix - DMatrix::identity(size, size) * shifted).lu();
    let mut vector = DVector::from_fn(size, |i, _| Complex::new(1.0, 0.1 * i as f64));
    for _ in 0..4 {
        lu.solve_mut(&mut vector);
        vector.normalize_mut();
    }
    vector
}

#[cfg(test)]
mod tests {
    use super::super::tableaux::{GAUSS_LEGENDRE_4, LOBATTO_IIIC_3, RADAU_IIA_1, RADAU_IIA_5};
    use super::*;

    #[test]
    fn eigenvectors_make_the_inverse() {
        for tableau in [
            &GAUSS_LEGENDRE_4,
            &LOBATTO_IIIC_3,
            &RADAU_IIA_1,
            &RADAU_IIA_5,
        ] {
            let transform = Transform::new(tableau.a);
            let size = tableau.stages();
            let sum = DMatrix::from_fn(size, size, |i, j| {
                let terms = transform.eigen.iter();
                let terms = terms.map(|e| (e.vector[i] * e.value * e.row[j]).re);
                terms.sum::<f64>()
            });
            let a = DMatrix::from_fn(size, size, |i, j| tableau.a[i][j]);
            let error = (a * sum - DMatrix::identity(size, size)).amax();
            assert!(error < 1e-11, "{error}");
        }
    }
}
