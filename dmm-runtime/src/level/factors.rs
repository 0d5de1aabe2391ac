//! (ΛWΛᵀ)⁻¹ by the factors L D Lᵀ of ΛWΛᵀ: where every quantity adds to the others, the fast way to
//! the level.

use super::weights::Weights;
use crate::arithmetic::masked::{Mask, Masked};
use crate::arithmetic::{Scalar, filled};
use crate::contract::{Matrix, Vector};

/// Where what a row adds to those before it is a smaller part of its square, the products in ΛWΛᵀ
/// have lost too many digits. What is lost above leaves 10⁻⁹ of a displacement.
const INDEPENDENT: f64 = 1e-6;

/// ΛW and the factors of ΛWΛᵀ, of as many rows of Λ as there are quantities.
pub(super) struct Factors<S: Masked, const N: usize, const M: usize> {
    weighted: Matrix<S, M, N>,
    /// L, below its diagonal of ones.
    lower: Matrix<S, M, M>,
    /// D⁻¹
    inverses: Vector<S, M>,
    /// Where all rows are independent; what is solved for has no meaning elsewhere.
    pub(super) independent: S::Mask,
    /// Where they are steep beyond the bound, too.
    pub(super) steep: S::Mask,
}

impl<const N: usize, const M: usize, S: Masked> Factors<S, N, M> {
    /// Those of the first `count` rows of Λ.
    #[inline(always)]
    pub(super) fn new(
        weights: &Weights<N, S>,
        (multiplier, count): (&Matrix<S, M, N>, usize),
        bound: &Vector<S, M>,
    ) -> Self {
        let mut weighted = *multiplier;
        for i in 0..N {
            for m in 0..M {
                weighted[(m, i)] *= weights.of(i);
            }
        }
        let mut lower = products(multiplier, &weighted);
        let mut inverses = filled(S::from_f64(0.0));
        let mut independent = S::Mask::all_are(true);
        let mut steep = independent;
        for k in 0..count.min(M) {
            let square = lower[(k, k)];
            let mut rest = square;
            for j in 0..k {
                // still times the square of what row j adds
                let share = lower[(k, j)] * inverses[j];
                rest = (-share).fused(lower[(k, j)], rest);
                for later in k + 1..M {
                    let less = (-share).fused(lower[(later, j)], lower[(later, k)]);
                    lower[(later, k)] = less;
                }
            }
            independent = independent.and(rest.above(square * S::from_f64(INDEPENDENT)));
            steep = steep.and(rest.above(bound[k]));
            inverses[k] = S::from_f64(1.0) / rest;
        }
        for k in 0..M {
            for later in k + 1..M {
                lower[(later, k)] *= inverses[k];
            }
        }
        Self {
            weighted,
            lower,
            inverses,
            independent,
            steep: steep.and(independent),
        }
    }

    /// The displacement −WΛᵀ(ΛWΛᵀ)⁻¹ r.
    #[inline(always)]
    pub(super) fn displacement(&self, residual: &Vector<S, M>) -> Vector<S, N> {
        let mut solution = *residual;
        for k in 0..M {
            for j in 0..k {
                solution[k] = (-self.lower[(k, j)]).fused(solution[j], solution[k]);
            }
        }
        for k in (0..M).rev() {
            solution[k] *= self.inverses[k];
            for later in k + 1..M {
                solution[k] = (-self.lower[(later, k)]).fused(solution[later], solution[k]);
            }
        }
        let mut displacement = filled(S::from_f64(0.0));
        for i in 0..N {
            for m in 0..M {
                displacement[i] = (-self.weighted[(m, i)]).fused(solution[m], displacement[i]);
            }
        }
        displacement
    }
}

impl<const N: usize, S: Masked> Weights<N, S> {
    /// The displacement that takes the residual of `count` quantities off, and where Λ is steep beyond
    /// a `bound`, in the lanes that are `used`.
    #[inline(always)]
    pub(super) fn solved<const M: usize>(
        &self,
        (multiplier, count): (&Matrix<S, M, N>, usize),
        residual: &Vector<S, M>,
        (bound, used): (&Vector<S, M>, S::Mask),
    ) -> (Vector<S, N>, S::Mask) {
        let fast = Factors::new(self, (multiplier, count), bound);
        let displacement = fast.displacement(residual);
        if fast.independent.all_of(used) {
            return (displacement, fast.steep);
        }
        let (slow, steep) = self.by_lane(multiplier, residual, bound, |projection, residual, _| {
            projection.smallest(residual)
        });
        (
            fast.independent.select_vector(&displacement, &slow),
            fast.steep.or(fast.independent.not().and(steep)),
        )
    }
}

/// The lower half of ΛWΛᵀ from Λ and ΛW.
#[inline(always)]
fn products<S: Scalar, const N: usize, const M: usize>(
    multiplier: &Matrix<S, M, N>,
    weighted: &Matrix<S, M, N>,
) -> Matrix<S, M, M> {
    let mut products = filled(S::from_f64(0.0));
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
        let fast = Factors::new(&weights, (&rows(), 3), &bound);
        let smallest = |projection: &MinimalNorm<f64, 5, 3>, residual: &_, _: &_| {
            projection.smallest(residual)
        };
        let (slow, steep) = weights.by_lane(&rows(), &residual, &bound, smallest);
        assert!(fast.steep && steep);
        // the rows are independent to a part of 10⁻²
        let difference = (fast.displacement(&residual) - slow).amax();
        assert!(difference < 1e-20, "{difference:e}");
    }

    #[test]
    fn rows_that_add_nothing_are_refused() {
        let weights = Weights::new(&Vector::from([1.0; 5]), &Vector::from([0.0; 5]));
        let mut dependent = rows();
        let sum = dependent.row(0) + dependent.row(1);
        dependent.set_row(2, &sum);
        let bound = Vector::from([1e-20; 3]);
        let independent =
            |count: usize| Factors::new(&weights, (&dependent, count), &bound).independent;
        assert!(independent(2) && !independent(3));
    }

    #[test]
    fn rows_that_are_left_out_move_nothing() {
        let weights = Weights::new(&Vector::from([1.0; 5]), &Vector::from([0.0; 5]));
        let mut two = rows();
        two.set_row(2, &Matrix::<f64, 1, 5>::zeros());
        let residual = Vector::from([1e-8, 1e-8, 0.0]);
        let bound = Vector::from([1e-20; 3]);
        let found = Factors::new(&weights, (&two, 2), &bound);
        let displacement = found.displacement(&residual);
        assert!(found.steep && (two * displacement + residual).amax() < 1e-22);
    }
}
