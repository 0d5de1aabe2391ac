//! The level of the conserved quantities in every lane; the mathematics is that of
//! [`crate::level`].

use super::register::{Register, WIDTH, Wide};
use crate::arithmetic::MinimalNorm;
use crate::arithmetic::Scalar;
use crate::arithmetic::error_free::two_sum;
use crate::arithmetic::lanes::Mask;
use crate::contract::{Dynamics, Matrix, Vector};

/// σ
const SLOPE: f64 = 1.0 / 16.0;
/// Rounding errors of ψ are below so many units of its terms.
const NOISE: f64 = 16.0 * f64::EPSILON;
/// Corrections of a step.
const MOST: u32 = 8;
/// A displacement beyond this part of the state leaves more than a rounding error.
const COARSE: f64 = 1e-9;

/// A point of every lane's solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<const N: usize> {
    pub(super) t: Wide,
    pub(super) t_remainder: Wide,
    pub(super) x: Vector<Wide, N>,
    pub(super) remainder: Vector<Wide, N>,
}

/// The vector of `value(0)`, `value(1)`, …
#[inline(always)]
pub(super) fn vector<const K: usize>(value: impl Fn(usize) -> Wide) -> Vector<Wide, K> {
    let mut vector = Vector::from_element(Wide::from_f64(0.0));
    for i in 0..K {
        vector[i] = value(i);
    }
    vector
}

impl<const N: usize> Place<N> {
    /// Adds an increment; what rounding takes from it goes to the remainder.
    #[inline(always)]
    pub(super) fn add(&mut self, increment: &Vector<Wide, N>) {
        for i in 0..N {
            let (x, error) = two_sum(self.x[i], increment[i]);
            self.x[i] = x;
            self.remainder[i] += error;
        }
    }

    /// Leaves a remainder of at most half a unit in the last place.
    #[inline(always)]
    pub(super) fn normalise(&mut self) {
        for i in 0..N {
            (self.x[i], self.remainder[i]) = two_sum(self.x[i], self.remainder[i]);
        }
    }

    /// Adds to the time.
    #[inline(always)]
    pub(super) fn add_time(&mut self, delta: Wide) {
        let (sum, error) = two_sum(self.t, delta);
        (self.t, self.t_remainder) = two_sum(sum, error + self.t_remainder);
    }

    /// The remainder as far as ψ is concerned with that of the time.
    #[inline(always)]
    fn whole_remainder<const M: usize, F: Dynamics<Wide, N, M>>(
        &self,
        dynamics: &F,
    ) -> Vector<Wide, N> {
        if dynamics.is_autonomous() {
            return self.remainder;
        }
        let field = dynamics.vector_field(self.t, &self.x);
        vector(|i| self.remainder[i] - field[i] * self.t_remainder)
    }
}

impl<const N: usize> Register<N> {
    /// The level at the entry into a region.
    #[inline(always)]
    pub(super) fn enter_level<const M: usize, F: Dynamics<Wide, N, M>>(&mut self, dynamics: &F) {
        let place = self.place();
        let (psi, multiplier) = dynamics.multiplier(place.t, &place.x);
        let size = dynamics.conserved_size(place.t, &place.x);
        let remainder = place.whole_remainder(dynamics);
        let square = (0..N).fold(Wide::from_f64(f64::MIN_POSITIVE), |sum, i| {
            place.x[i].fused(place.x[i], sum)
        });
        let scale = Wide::from_f64(SLOPE * SLOPE) / square;
        for m in 0..M {
            let off = (0..N).fold(psi[m], |sum, i| multiplier[(m, i)].fused(remainder[i], sum));
            self.level[0][m] = off;
            self.level[1][m] = size[m] * size[m] * scale + Wide::from_f64(f64::MIN_POSITIVE);
            self.level[2][m] = size[m] * Wide::from_f64(NOISE);
        }
    }

    /// The squares of the sizes of components after a step to a place.
    #[inline(always)]
    fn squares(&self, place: &Place<N>) -> Vector<Wide, N> {
        vector(|i| {
            let moved = place.x[i] - self.x[i];
            moved.fused(moved, place.x[i] * place.x[i])
        })
    }

    /// Where a displacement at a place is so large that its square is no rounding error.
    #[inline(always)]
    pub(super) fn coarse(&self, displacement: &Vector<Wide, N>, place: &Place<N>) -> Mask<WIDTH> {
        let squares = self.squares(place);
        let bound = Wide::from_f64(COARSE * COARSE);
        (0..N).fold(Mask::all(false), |any, i| {
            let square = displacement[i] * displacement[i];
            any.or(square.above(bound * squares[i]))
        })
    }

    /// The squares of the sizes of components after a step to a place, relative to the largest.
    #[inline(always)]
    fn weights(&self, place: &Place<N>) -> Vector<Wide, N> {
        let squares = self.squares(place);
        let least = Wide::from_f64(f64::MIN_POSITIVE);
        let largest = (0..N).fold(least, |largest, i| largest.max(squares[i]));
        let inverse = Wide::from_f64(1.0) / largest;
        vector(|i| squares[i] * inverse)
    }

    /// The displacement towards the level.
    #[inline(always)]
    pub(super) fn correction<const M: usize, F: Dynamics<Wide, N, M>>(
        &self,
        dynamics: &F,
        place: &Place<N>,
    ) -> Vector<Wide, N> {
        if M == 0 {
            return Vector::from_element(Wide::from_f64(0.0));
        }
        let weights = self.weights(place);
        let (psi, multiplier) = dynamics.multiplier(place.t, &place.x);
        let remainder = place.whole_remainder(dynamics);
        let [reference, damping, noise] = &self.level;
        let residual: Vector<Wide, M> = vector(|m| {
            (0..N).fold(psi[m] - reference[m], |sum, i| {
                multiplier[(m, i)].fused(remainder[i], sum)
            })
        });
        let damping: Vector<Wide, M> = vector(|m| {
            let large = residual[m].abs().above(noise[m]);
            large.select(Wide::from_f64(f64::MIN_POSITIVE), damping[m])
        });
        if M == 1 {
            let square = (0..N).fold(damping[0], |sum, i| {
                (weights[i] * multiplier[(0, i)]).fused(multiplier[(0, i)], sum)
            });
            let factor = (-residual[0] / square).settled();
            return vector(|i| weights[i] * multiplier[(0, i)] * factor);
        }
        let sizes: Vector<Wide, N> = vector(|i| weights[i].sqrt());
        let scaled = Matrix::<Wide, M, N>::from_fn(|m, i| multiplier[(m, i)] * sizes[i]);
        let displacement = lane_by_lane(&scaled, &residual, &damping);
        vector(|i| sizes[i] * displacement[i])
    }

    /// Puts a place back on the level.
    #[inline(always)]
    pub(super) fn correct<const M: usize, F: Dynamics<Wide, N, M>>(
        &self,
        dynamics: &F,
        place: &mut Place<N>,
    ) {
        for _ in 0..MOST {
            let displacement = self.correction(dynamics, place);
            for i in 0..N {
                place.remainder[i] += displacement[i];
            }
            place.normalise();
            let again = self.coarse(&displacement, place).and(self.used());
            if !again.any() {
                break;
            }
        }
    }
}

/// Of several quantities: which of them count is different from lane to lane.
#[inline(never)]
fn lane_by_lane<const N: usize, const M: usize>(
    multiplier: &Matrix<Wide, M, N>,
    residual: &Vector<Wide, M>,
    damping: &Vector<Wide, M>,
) -> Vector<Wide, N> {
    let mut displacement = Vector::from_element(Wide::from_f64(0.0));
    for lane in 0..WIDTH {
        let multiplier = multiplier.map(|entry| entry.0[lane]);
        let residual = residual.map(|entry| entry.0[lane]);
        let damping = damping.map(|entry| entry.0[lane]);
        let v = MinimalNorm::new(&multiplier, &multiplier).damped(&residual, &damping);
        for i in 0..N {
            displacement[i].0[lane] = -v[i];
        }
    }
    displacement
}
