//! What a correction of the state is measured by.

use std::ops::Range;

use crate::arithmetic::linear::together;
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::arithmetic::{MinimalNorm, filled};
use crate::contract::{Matrix, Vector};

/// Where squares of sizes and the products that they enter are far from the ends of the range of
/// doubles.
const USUAL: Range<f64> = 1e-20..1e20;

/// The error of second order of a displacement by this part of the state is more than a rounding
/// error.
pub(crate) const COARSE: f64 = 1e-9;

/// The sizes of components next to a point: wᵢ² = xᵢ² + dᵢ² of the state and the step that led to
/// it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights<const N: usize, S: Masked = f64> {
    squares: Vector<S, N>,
    /// The largest of them.
    pub(super) largest: S,
    /// What they are multiples of: 1 unless they are so small or so large that the products they
    /// enter could leave the range of doubles.
    pub(super) unit: S,
}

impl<const N: usize, S: Masked> Weights<N, S> {
    /// Those at the end `x` of a step over `displacement`.
    #[inline(always)]
    pub(crate) fn new(x: &Vector<S, N>, displacement: &Vector<S, N>) -> Self {
        let one = S::from_f64(1.0);
        let squares = vector!(|i| displacement[i].fused(displacement[i], x[i] * x[i]));
        let least = S::from_f64(f64::MIN_POSITIVE);
        let larger = |largest: S, i: usize| largest.max(squares[i]);
        let largest = together::<S, N>(least, larger, S::max);
        let above = largest.above(S::from_f64(USUAL.start));
        let usual = above.and(S::from_f64(USUAL.end).above(largest));
        let weights = Self {
            squares,
            largest,
            unit: one,
        };
        // nothing waits for a division that is not made
        if usual.all() {
            return weights;
        }
        let inverse = one / largest;
        Self {
            squares: vector!(|i| usual.select(squares[i], squares[i] * inverse)),
            largest: usual.select(largest, one),
            unit: usual.select(one, largest),
        }
    }

    /// wᵢ²
    #[inline(always)]
    pub(super) fn of(&self, i: usize) -> S {
        self.squares[i]
    }

    /// wᵢ² Λᵢ
    #[inline(always)]
    pub(super) fn times(&self, row: &Vector<S, N>) -> Vector<S, N> {
        vector!(|i| row[i] * self.squares[i])
    }

    /// The displacement that takes a residual off by Λ with column i times wᵢ, as `value` has it, and
    /// where that matrix is steep beyond a `bound`. Lane by lane, because which of several
    /// quantities count differs.
    #[inline]
    pub(super) fn by_lane<const M: usize>(
        &self,
        multiplier: &Matrix<S, M, N>,
        residual: &Vector<S, M>,
        bound: &Vector<S, M>,
        value: impl Fn(&MinimalNorm<f64, N, M>, &Vector<f64, M>, &Vector<f64, M>) -> Vector<f64, N>,
    ) -> (Vector<S, N>, S::Mask) {
        let mut results: Vector<S, N> = filled(S::from_f64(0.0));
        let mut steep = S::from_f64(0.0);
        for lane in 0..S::LANES {
            let sizes: Vector<f64, N> = vector!(|i| self.squares[i].lane(lane).sqrt());
            let scaled = Matrix::from_fn(|m, i| multiplier[(m, i)].lane(lane) * sizes[i]);
            let projection = MinimalNorm::new(&scaled, &scaled);
            let bound = vector!(|m| bound[m].lane(lane));
            steep.set_lane(lane, f64::from(u8::from(projection.is_steep(&bound))));
            let result = value(&projection, &vector!(|m| residual[m].lane(lane)), &bound);
            for i in 0..N {
                results[i].set_lane(lane, -(result[i] * sizes[i]));
            }
        }
        (results, steep.above(S::from_f64(0.5)))
    }

    /// Whether a displacement is more than a part of the state.
    #[inline(always)]
    pub(crate) fn exceeded_by(&self, displacement: &Vector<S, N>, part: f64) -> S::Mask {
        let square = S::from_f64(part * part) * self.unit;
        let mut any = S::Mask::all_are(false);
        for i in 0..N {
            let of = displacement[i] * displacement[i];
            any = any.or(of.above(square * self.squares[i]));
        }
        any
    }
}
