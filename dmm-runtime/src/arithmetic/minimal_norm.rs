//! The minimal-norm discrete vector field, solved at run time.
//!
//! With M < N conserved quantities and a consistent mean f̄ of the vector field,
//!
//! f^τ = f̄ − Λ^τᵀ λ, (Λ^τ Λ^τᵀ) λ = Λ^τ f̄ + ∂ₜ^τψ,
//!
//! is the field nearest to f̄ with Λ^τ f^τ + ∂ₜ^τψ = 0 (Schulz & Wan, MN-DMM). The rows of
//! Λ^τ are orthonormalised, Λ^τᵀ Π = Q R, rather than the Gram matrix inverted.
//!
//! Quantities that are independent elsewhere may become dependent on a set (E, L and Aₓ of
//! the Kepler problem where A_y = 0). There a row adds nothing that rounding errors do not
//! drown: it is left out, and its ψ is conserved to second order through the others, of which
//! those declared first come first. Which rows count is decided on Λ at the start of the
//! step, so that the decision is the same throughout the solution of a step, and the error
//! O(τ²) between Λ^τ and Λ cannot make a dependent row look independent.

use crate::arithmetic::Scalar;
use crate::arithmetic::linear::dot;
use crate::arithmetic::{Matrix, Vector};

/// A row whose part orthogonal to the others is smaller than this share of it is dependent:
/// the rounding errors of f^τ are enlarged by the inverse of the share.
const DEPENDENT: f64 = 1e-6;

/// The projection onto the discrete multiplier's null space.
#[derive(Clone, Copy, Debug)]
pub struct MinimalNorm<S: Scalar, const N: usize, const M: usize> {
    multiplier: Matrix<S, M, N>,
    /// Orthonormal rows qₖ that span the rows of Λ^τ; zero beyond the rank.
    basis: Matrix<S, M, N>,
    /// Λ^τ = L Q with the rows in their own order: lᵢₖ = Λ^τᵢ·qₖ.
    factor: Matrix<S, M, M>,
    /// The rows that count.
    rows: [usize; M],
    rank: usize,
}

impl<S: Scalar, const N: usize, const M: usize> MinimalNorm<S, N, M> {
    /// The projection for Λ^τ of a step, with the rows that count chosen by Λ at its start.
    #[inline]
    pub fn new(multiplier: &Matrix<S, M, N>, at_start: &Matrix<S, M, N>) -> Self {
        let (rows, rank) = independent_rows(at_start);
        let zero = S::from_f64(0.0);
        let mut projection = Self {
            multiplier: *multiplier,
            basis: Matrix::from_element(zero),
            factor: Matrix::from_element(zero),
            rows,
            rank: 0,
        };
        for &pivot in &rows[..rank] {
            let mut rest = row(multiplier, pivot);
            projection.orthogonalise(&mut rest);
            projection.orthogonalise(&mut rest);
            let length = norm(&rest);
            if length == zero {
                break;
            }
            let k = projection.rank;
            for j in 0..N {
                projection.basis[(k, j)] = rest[j] / length;
            }
            let q = row(&projection.basis, k);
            for i in 0..M {
                projection.factor[(i, k)] = dot(&row(multiplier, i), &q);
            }
            projection.rank += 1;
        }
        projection
    }

    /// Takes the directions so far off `v`; twice leaves nothing of them but rounding.
    #[inline]
    fn orthogonalise(&self, v: &mut Vector<S, N>) {
        for k in 0..self.rank {
            let q = row(&self.basis, k);
            let part = dot(&q, v);
            for j in 0..N {
                v[j] -= part * q[j];
            }
        }
    }

    /// The coordinates c of the minimal-norm solution v = Qᵀc of Λ^τ v = r.
    #[inline]
    fn coordinates(&self, r: &Vector<S, M>, damping: &Vector<S, M>) -> Vector<S, M> {
        let mut c = Vector::from_element(S::from_f64(0.0));
        for k in 0..self.rank {
            let pivot = self.rows[k];
            let mut value = r[pivot];
            for j in 0..k {
                value -= self.factor[(pivot, j)] * c[j];
            }
            let length = self.factor[(pivot, k)];
            c[k] = value * length / (length * length + damping[pivot]);
        }
        c
    }

    /// Whether the square of what each row that counts adds to the rows before it is more than
    /// `least`.
    #[inline]
    pub(crate) fn is_steep(&self, least: &Vector<S, M>) -> bool {
        (0..self.rank).all(|k| {
            let length = self.factor[(self.rows[k], k)];
            length * length > least[self.rows[k]]
        })
    }

    /// v = Λ⁺ r, the solution of Λ^τ v = r of smallest norm.
    #[inline]
    pub(crate) fn smallest(&self, r: &Vector<S, M>) -> Vector<S, N> {
        self.damped(r, &Vector::from_element(S::from_f64(0.0)))
    }

    /// The same with Dᵢ added to the square of what row i adds to the rows before it, so that
    /// along a direction that adds little r is not enlarged.
    #[inline]
    pub(crate) fn damped(&self, r: &Vector<S, M>, damping: &Vector<S, M>) -> Vector<S, N> {
        let c = self.coordinates(r, damping);
        Vector::from_fn(|i, _| {
            (0..self.rank).fold(S::from_f64(0.0), |sum, k| sum + c[k] * self.basis[(k, i)])
        })
    }

    /// P v = v − Λ⁺Λ v, the part of v in the null space.
    #[inline]
    fn project(&self, mut v: Vector<S, N>) -> Vector<S, N> {
        self.orthogonalise(&mut v);
        v
    }

    /// f^τ = f̄ − Λ^τᵀλ and λ, from f̄ and ∂ₜ^τψ.
    #[inline]
    pub fn field(
        &self,
        mean: &Vector<S, N>,
        time_derivative: &Vector<S, M>,
    ) -> (Vector<S, N>, Vector<S, M>) {
        let mut right = *time_derivative;
        for i in 0..M {
            right[i] += dot(&row(&self.multiplier, i), mean);
        }
        let excess = self.smallest(&right);
        let field = Vector::from_fn(|i, _| mean[i] - excess[i]);
        (field, self.multipliers(&excess))
    }

    /// λ with Λ^τᵀλ = v for v in the span of the rows; zero for the rows left out.
    #[inline]
    fn multipliers(&self, v: &Vector<S, N>) -> Vector<S, M> {
        let mut lambda = Vector::from_element(S::from_f64(0.0));
        for k in (0..self.rank).rev() {
            let mut value = dot(&row(&self.basis, k), v);
            for j in k + 1..self.rank {
                let later = self.rows[j];
                value -= self.factor[(later, k)] * lambda[later];
            }
            let pivot = self.rows[k];
            lambda[pivot] = value / self.factor[(pivot, k)];
        }
        lambda
    }

    /// ∂f^τ/∂x₁ = P(∂f̄ − B) − Λ⁺C with B = ∂(Λ^τᵀλ)/∂x₁ at constant λ and
    /// C = ∂(Λ^τw + ∂ₜ^τψ)/∂x₁ at constant w = f^τ.
    #[inline]
    pub fn jacobian(
        &self,
        mean: &Matrix<S, N, N>,
        transposed: &Matrix<S, N, N>,
        constraint: &Matrix<S, M, N>,
    ) -> Matrix<S, N, N> {
        let mut jacobian = *mean;
        for j in 0..N {
            let column = self.time_derivative(
                &Vector::from_fn(|i, _| mean[(i, j)]),
                &Vector::from_fn(|i, _| transposed[(i, j)]),
                &Vector::from_fn(|i, _| constraint[(i, j)]),
            );
            for i in 0..N {
                jacobian[(i, j)] = column[i];
            }
        }
        jacobian
    }

    /// ∂f^τ/∂t₁, or a column of [`MinimalNorm::jacobian`], from the same derivatives.
    #[inline]
    pub fn time_derivative(
        &self,
        mean: &Vector<S, N>,
        transposed: &Vector<S, N>,
        constraint: &Vector<S, M>,
    ) -> Vector<S, N> {
        let inside = self.project(Vector::from_fn(|i, _| mean[i] - transposed[i]));
        let outside = self.smallest(constraint);
        Vector::from_fn(|i, _| inside[i] - outside[i])
    }
}

/// The rows of a matrix that are independent of those before them, and how many there are. A
/// single row always counts.
#[inline]
fn independent_rows<S: Scalar, const M: usize, const N: usize>(
    matrix: &Matrix<S, M, N>,
) -> ([usize; M], usize) {
    let mut rows: [usize; M] = std::array::from_fn(|i| i);
    if M <= 1 {
        return (rows, M);
    }
    let mut rest = *matrix;
    let mut rank = 0;
    for i in 0..M {
        let direction = row(&rest, i);
        if norm(&direction) <= S::from_f64(DEPENDENT) * norm(&row(matrix, i)) {
            continue;
        }
        rows[rank] = i;
        rank += 1;
        let square = dot(&direction, &direction);
        for later in i + 1..M {
            let part = dot(&row(&rest, later), &direction) / square;
            for j in 0..N {
                rest[(later, j)] -= part * direction[j];
            }
        }
    }
    (rows, rank)
}

#[inline]
fn row<S: Scalar, const R: usize, const C: usize>(m: &Matrix<S, R, C>, i: usize) -> Vector<S, C> {
    Vector::from_fn(|j, _| m[(i, j)])
}

#[inline]
fn norm<S: Scalar, const N: usize>(a: &Vector<S, N>) -> S {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    type V4 = Vector<f64, 4>;
    type M24 = Matrix<f64, 2, 4>;

    /// Λ^τ, f̄ and ∂ₜ^τψ as smooth functions of x₁.
    fn multiplier(x: &V4) -> M24 {
        M24::from_fn(|i, j| {
            (x[j] * (1.0 + i as f64)).sin() + x[(i + j) % 4].powi(2) + 0.3 * j as f64
        })
    }
    fn mean(x: &V4) -> V4 {
        V4::from_fn(|i, _| x[(i + 1) % 4] * x[i] - 0.5 * x[(i + 2) % 4])
    }
    fn time_derivative(x: &V4) -> Vector<f64, 2> {
        Vector::from([x[0] * x[3], x[1].cos()])
    }
    fn field(x: &V4) -> (V4, Vector<f64, 2>) {
        MinimalNorm::new(&multiplier(x), &multiplier(x)).field(&mean(x), &time_derivative(x))
    }

    /// ∂h/∂x by central differences.
    fn derivative<const R: usize>(x: &V4, h: impl Fn(&V4) -> Vector<f64, R>) -> Matrix<f64, R, 4> {
        let step = 1e-5;
        let mut matrix = Matrix::<f64, R, 4>::zeros();
        for j in 0..4 {
            let mut shift = V4::zeros();
            shift[j] = step;
            matrix.set_column(j, &((h(&(x + shift)) - h(&(x - shift))) / (2.0 * step)));
        }
        matrix
    }

    #[test]
    fn the_field_conserves_and_is_nearest() {
        let x = V4::new(0.3, -0.7, 1.1, 0.4);
        let (w, lambda) = field(&x);
        let matrix = multiplier(&x);
        assert!((matrix * w + time_derivative(&x)).amax() < 1e-14);
        assert!((mean(&x) - matrix.transpose() * lambda - w).amax() < 1e-14);
    }

    #[test]
    fn the_jacobian_is_the_derivative() {
        let x = V4::new(0.3, -0.7, 1.1, 0.4);
        let (w, lambda) = field(&x);
        let projection = MinimalNorm::new(&multiplier(&x), &multiplier(&x));
        let jacobian = projection.jacobian(
            &derivative(&x, mean),
            &derivative(&x, |x| multiplier(x).transpose() * lambda),
            &derivative(&x, |x| multiplier(x) * w + time_derivative(x)),
        );
        // both are central differences of step 1e-5: truncation and cancellation leave 1e-9
        assert!((jacobian - derivative(&x, |x| field(x).0)).amax() < 1e-9);
    }

    #[test]
    fn dependent_rows_are_left_out() {
        let first = V4::new(1.0, 2.0, -1.0, 0.5);
        let mut matrix = Matrix::<f64, 3, 4>::zeros();
        matrix.set_row(0, &first.transpose());
        matrix.set_row(1, &(first * -3.0).transpose());
        let projection = MinimalNorm::new(&matrix, &matrix);
        assert_eq!(projection.rank, 1);
        let (w, lambda) = projection.field(&V4::new(0.2, 0.4, 0.1, 1.0), &Vector::zeros());
        assert!((matrix * w).amax() < 1e-15);
        assert!(lambda.iter().all(|l| l.is_finite()));
    }

    #[test]
    fn a_vanishing_multiplier_changes_nothing() {
        let projection = MinimalNorm::<f64, 4, 1>::new(&Matrix::zeros(), &Matrix::zeros());
        let mean = V4::new(0.2, 0.4, 0.1, 1.0);
        assert_eq!(
            projection.field(&mean, &Vector::zeros()),
            (mean, Vector::zeros())
        );
    }
}
