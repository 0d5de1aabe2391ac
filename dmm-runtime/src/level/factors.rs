//! (ΛWΛᵀ)⁻¹ by the factors L D Lᵀ of ΛWΛᵀ: where every quantity adds to the others, the fast way to
//! the level.

use super::weights::Weights;
use crate::arithmetic::Scalar;
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::contract::{Matrix, Vector};

/// Where what a row adds to those before it is a smaller part of its square, the products in ΛWΛᵀ
/// have lost too many digits. What is lost above leaves 10⁻⁹ of a displacement.
const INDEPENDENT: f64 = 1e-6;

/// A displacement towards the level.
pub(super) struct ByFactors<S: Masked, const N: usize> {
    /// The displacement, which has no meaning where rows are not independent.
    pub(super) displacement: Vector<S, N>,
    /// Where all rows are independent.
    pub(super) independent: S::Mask,
    /// Where they are steep beyond the bound, too.
    pub(super) steep: S::Mask,
}

impl<const N: usize, S: Masked> Weights<N, S> {
    /// −WΛᵀ(ΛWΛᵀ)⁻¹ r of the first `count` rows of Λ, where all of them are independent.
    #[inline]
    pub(super) fn by_factors<const M: usize>(
        &self,
        (multiplier, count): (&Matrix<S, M, N>, usize),
        residual: &Vector<S, M>,
        bound: &Vector<S, M>,
    ) -> ByFactors<S, N> {
        let mut weighted = *multiplier;
        for i in 0..N {
            for m in 0..M {
                weighted[(m, i)] *= self.of(i);
            }
        }
        let mut factors = products(multiplier, &weighted);
        let mut solution = *residual;
        let mut inverses = vector::<S, M>(|_| S::from_f64(0.0));
        let mut independent = S::Mask::all_are(true);
        let mut steep = independent;
        for k in 0..count.min(M) {
            let square = factors[(k, k)];
            let mut rest = square;
            for j in 0..k {
                // still times the square of what row j adds
                let share = factors[(k, j)] * inverses[j];
                rest = (-share).fused(factors[(k, j)], rest);
                for later in k + 1..M {
                    let less = (-share).fused(factors[(later, j)], factors[(later, k)]);
                    factors[(later, k)] = less;
                }
                solution[k] = (-share).fused(solution[j], solution[k]);
            }
            independent = independent.and(rest.above(square * S::from_f64(INDEPENDENT)));
            steep = steep.and(rest.above(bound[k]));
            inverses[k] = S::from_f64(1.0) / rest;
        }
        for k in (0..M).rev() {
            solution[k] *= inverses[k];
            for later in k + 1..M {
                let share = factors[(later, k)] * inverses[k];
                solution[k] = (-share).fused(solution[later], solution[k]);
            }
        }
        let displacement = vector(|i| {
            let parts = (0..M).map(|m| (weighted[(m, i)], solution[m]));
            let zero = S::from_f64(0.0);
            parts.fold(zero, |sum, (row, part)| (-row).fused(part, sum))
        });
        ByFactors {
            displacement,
            independent,
            steep: steep.and(independent),
        }
    }
}

/// The lower half of ΛWΛᵀ from Λ and ΛW.
#[inline(always)]
fn products<S: Scalar, const N: usize, const M: usize>(
    multiplier: &Matrix<S, M, N>,
    weighted: &Matrix<S, M, N>,
) -> Matrix<S, M, M> {
    let mut products = Matrix::from_element(S::from_f64(0.0));
    for i in 0..N {
        for b in 0..M {
            for a in b..M {
                products[(a, b)] = multiplier[(a, i)].fused(weighted[(b, i)], products[(a, b)]);
            }
        }
    }
    products
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::MinimalNorm;

    type Rows = Matrix<f64, 3, 5>;

    fn rows() -> Rows {
        Rows::from_fn(|m, i| (1.0 + m as f64 * i as f64).sin() + 0.3 * i as f64)
    }

    #[test]
    fn the_displacement_is_the_one_of_the_projection() {
        let weights = Weights::new(
            &Vector::from([1.0, -2.0, 0.5, 3.0, 1e-3]),
            &Vector::from([0.1; 5]),
        );
        let residual = Vector::from([1e-8, -3e-9, 2e-9]);
        let bound = Vector::from([1e-20; 3]);
        let fast = weights.by_factors((&rows(), 3), &residual, &bound);
        let smallest = |projection: &MinimalNorm<f64, 5, 3>, residual: &_, _: &_| {
            projection.smallest(residual)
        };
        let (slow, steep) = weights.by_lane(&rows(), &residual, &bound, smallest);
        assert!(fast.steep && steep);
        // the rows are independent to a part of 10⁻²
        let difference = (fast.displacement - slow).amax();
        assert!(difference < 1e-20, "{difference:e}");
    }

    #[test]
    fn rows_that_add_nothing_are_refused() {
        let weights = Weights::new(&Vector::from([1.0; 5]), &Vector::from([0.0; 5]));
        let mut dependent = rows();
        let sum = dependent.row(0) + dependent.row(1);
        dependent.set_row(2, &sum);
        let residual = Vector::from([1e-8; 3]);
        let bound = Vector::from([1e-20; 3]);
        let independent = |count: usize| {
            let found = weights.by_factors((&dependent, count), &residual, &bound);
            found.independent
        };
        assert!(independent(2) && !independent(3));
    }

    #[test]
    fn rows_that_are_left_out_move_nothing() {
        let weights = Weights::new(&Vector::from([1.0; 5]), &Vector::from([0.0; 5]));
        let mut two = rows();
        two.set_row(2, &Matrix::<f64, 1, 5>::zeros());
        let residual = Vector::from([1e-8, 1e-8, 0.0]);
        let bound = Vector::from([1e-20; 3]);
        let found = weights.by_factors((&two, 2), &residual, &bound);
        assert!(found.steep && (two * found.displacement + residual).amax() < 1e-22);
    }
}
