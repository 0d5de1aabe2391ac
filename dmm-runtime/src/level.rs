//! Conservation for ever: the level ψ_ref of a segment, and the correction towards it.
//!
//! A step conserves ψ up to its truncation and rounding errors, which add up over a long run.
//! The level is therefore kept from the entry into a region, where it is taken as a pair of
//! doubles of the state with its remainder, and the residual r = ψ(t, x) − ψ_ref is taken off
//! the state: the smallest δx with Λ δx = −r, each component measured by its [`Weights`], so that
//! neither its unit nor its zeros matter. With W = diag(wᵢ²), δx = −WΛᵀ(ΛWΛᵀ)⁻¹ r.
//!
//! One displacement leaves its square, which the next step's displacement takes off, as the level is that
//! of the entry. A point that is shown or met, and one that was far from the level, is moved until
//! what is left is a rounding error.
//!
//! Where no interface bounds a region, two steps are made without a correction after one whose
//! displacement was within the tolerance of a step; what is shown is on the level, and the end time too.
//! A step that meets an interface starts on the level, as what is off it would move the crossing.
//!
//! Where ψ has little slope the rounding error of ψ, and not r, would be what moves the state.
//! There r is evaluated in pairs of doubles. Where ψ has no slope to speak of even r must not be
//! amplified: there, for one quantity δx = −WΛᵀ r/(ΛWΛᵀ + D) with D = (σ·|terms of ψ|/|x|)². Of
//! several quantities each is damped in the direction that it adds to those before it, and the rows
//! that count are those that [`MinimalNorm`] keeps in the discrete vector field. Where all rows are
//! independent and none is damped, ΛWΛᵀ is solved by its factors, which is several times as fast.

mod factors;
mod guard_point;
mod pairs;
mod reached;
mod weights;

use pulp::NullaryFnOnce;

use crate::arithmetic::double::Pair;
use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::linear::dot;
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::arithmetic::{MinimalNorm, State, Time, filled};
use crate::contract::{Dynamics, Matrix, Vector};

use factors::Factors;
pub(crate) use guard_point::{Found, GuardPoint, OnGuard};
use pairs::{MOST_IN_PAIRS, in_pairs, remainder, switching_in_pairs};
pub(crate) use reached::Turn;
pub(crate) use weights::{COARSE, Weights};

/// The level of the conserved quantities in a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level<const N: usize, const M: usize, S: Masked = f64> {
    pub(crate) reference: Vector<S, M>,
    /// What the reference lacks as doubles.
    pub(crate) remainder: Vector<S, M>,
    /// (|terms of ψ|/|x|)²: the squares of slopes count relative to these.
    pub(crate) scale: Vector<S, M>,
}

/// Steps between adaptions of the level's correction to the size of the state.
pub(crate) const RESCALING: u64 = 256;
/// Where the slope is smaller than this, rounding errors of ψ would move the state by more
/// than some units in its last place.
const LITTLE: f64 = 1.0 / 16.0;
/// Rounding errors of ψ are below this part of its terms.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// σ: where the slope is smaller than this, the second order of r is more than a rounding
/// error of ψ.
const NONE: f64 = 1e-6;

impl<const N: usize, const M: usize, S: Masked> Level<N, M, S> {
    /// The level ψ at a state.
    #[inline(always)]
    fn at<F: Dynamics<S, N, M>>(
        dynamics: &F,
        (t, state): (S, &State<N, S>),
        psi: &Vector<Pair<S>, M>,
    ) -> Self {
        let mut level = Self {
            reference: vector!(|m| psi[m].high),
            remainder: vector!(|m| psi[m].low),
            scale: filled(S::from_f64(0.0)),
        };
        level.rescale(dynamics, t, state);
        level
    }

    /// Takes the scale of slopes from the present state, which may have grown or shrunk since
    /// the entry.
    #[inline]
    pub(crate) fn rescale<F: Dynamics<S, N, M>>(
        &mut self,
        dynamics: &F,
        t: S,
        state: &State<N, S>,
    ) {
        let least = S::from_f64(f64::MIN_POSITIVE);
        let mut square = least;
        for i in 0..N {
            square = square.max(state.x[i] * state.x[i]);
        }
        let size = dynamics.conserved_size(t, &state.x);
        self.scale = vector!(|m| size[m] * (size[m] / square) + least);
    }

    /// The squares of slopes below which a part of the scale is.
    #[inline(always)]
    fn bound(&self, part: f64, weights: &Weights<N, S>) -> Vector<S, M> {
        let factor = S::from_f64(part * part) * weights.largest;
        vector!(|m| self.scale[m] * factor)
    }

    /// ψ(t, x) − ψ_ref, from ψ of the rounded state.
    #[inline(always)]
    fn rounded_residual(
        &self,
        psi: &Vector<S, M>,
        multiplier: &Matrix<S, M, N>,
        remainder: &Vector<S, N>,
    ) -> Vector<S, M> {
        vector!(|m| {
            let drift = dot(&row(multiplier, m), remainder) - self.remainder[m];
            (psi[m] - self.reference[m]) + drift
        })
    }

    /// The displacement δx towards the level, in the lanes that are `used`.
    #[inline(always)]
    pub(crate) fn correction<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: &State<N, S>,
        (weights, used): (&Weights<N, S>, S::Mask),
    ) -> Vector<S, N> {
        if M == 0 || dynamics.quantities() == 0 {
            return filled(S::from_f64(0.0));
        }
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let little = self.bound(little(N), weights);
        let (displacement, steep) = if M == 1 {
            let row = row(&multiplier, 0);
            let weighted = weights.times(&row);
            let square = dot(&row, &weighted);
            let inverse = S::from_f64(1.0) / square;
            let remainder = remainder(dynamics, time, state);
            let residual = self.rounded_residual(&psi, &multiplier, &remainder);
            let factor = -(residual[0] * inverse);
            (vector!(|i| weighted[i] * factor), square.above(little[0]))
        } else {
            let remainder = remainder(dynamics, time, state);
            let residual = self.rounded_residual(&psi, &multiplier, &remainder);
            let rows = (&multiplier, dynamics.quantities());
            weights.solved(rows, &residual, (&little, used))
        };
        if steep.all_of(used) {
            return displacement;
        }
        let gentle = Gentle {
            level: self,
            dynamics,
            place: (time, state),
            multiplier: &multiplier,
            how: (weights, used),
        };
        steep.select_vector(&displacement, &S::apart(gentle))
    }

    /// ψ(t, x) − ψ_ref in pairs of doubles, rounded.
    #[inline(always)]
    pub(crate) fn residual<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: &State<N, S>,
    ) -> Vector<S, M> {
        let psi = in_pairs(dynamics, time, state);
        vector!(|m| (psi[m] - Pair::new(self.reference[m], self.remainder[m])).high)
    }

    /// The displacement that takes a residual off, in the lanes that are `used`.
    #[inline(always)]
    pub(crate) fn towards(
        &self,
        (multiplier, count): (&Matrix<S, M, N>, usize),
        residual: &Vector<S, M>,
        (weights, used): (&Weights<N, S>, S::Mask),
    ) -> Vector<S, N> {
        let damping = self.bound(NONE, weights);
        if M == 1 {
            let row = row(multiplier, 0);
            let weighted = weights.times(&row);
            let square = dot(&row, &weighted);
            let steep = square.above(damping[0]);
            let damping = steep.select(S::from_f64(0.0), damping[0]);
            // whose inverse may leave the range of doubles
            let factor = -(residual[0] / (square + damping));
            return vector!(|i| weighted[i] * factor);
        }
        let fast = Factors::new(weights, (multiplier, count), &damping);
        let displacement = fast.displacement(residual);
        if fast.steep.all_of(used) {
            return displacement;
        }
        let gentle =
            |projection: &MinimalNorm<f64, N, M>, residual: &Vector<f64, M>, damping: &_| {
                if projection.is_steep(damping) {
                    projection.smallest(residual)
                } else {
                    projection.damped(residual, damping)
                }
            };
        let (slow, _) = weights.by_lane(multiplier, residual, &damping, gentle);
        fast.steep.select_vector(&displacement, &slow)
    }
}

/// The displacement where ψ has little slope, with the residual in pairs of doubles.
struct Gentle<'a, F, const N: usize, const M: usize, S: Masked> {
    level: &'a Level<N, M, S>,
    dynamics: &'a F,
    place: (Time<S>, &'a State<N, S>),
    multiplier: &'a Matrix<S, M, N>,
    how: (&'a Weights<N, S>, S::Mask),
}

impl<F: Dynamics<S, N, M>, const N: usize, const M: usize, S: Masked> NullaryFnOnce
    for Gentle<'_, F, N, M, S>
{
    type Output = Vector<S, N>;

    #[inline(always)]
    fn call(self) -> Vector<S, N> {
        let (time, state) = self.place;
        let residual = self.level.residual(self.dynamics, time, state);
        let rows = (self.multiplier, self.dynamics.quantities());
        self.level.towards(rows, &residual, self.how)
    }
}

impl<const N: usize, const M: usize, const L: usize> Level<N, M, Lanes<L>> {
    /// The levels at the entry into a mode.
    #[inline(always)]
    pub(crate) fn in_lanes<F: Dynamics<Lanes<L>, N, M>>(
        dynamics: &F,
        time: Time<Lanes<L>>,
        state: &State<N, Lanes<L>>,
    ) -> Self {
        let psi = in_pairs(dynamics, time, state);
        Self::at(dynamics, (time.value, state), &psi)
    }
}

impl<const N: usize, const M: usize> Level<N, M> {
    /// That of a mode before it is entered.
    #[inline(always)]
    pub(crate) fn unknown() -> Self {
        Self {
            reference: filled(f64::NAN),
            remainder: filled(f64::NAN),
            scale: filled(f64::NAN),
        }
    }

    /// The level at the entry into a mode, or the one that was `kept` of a segment that goes on.
    #[inline(always)]
    pub(crate) fn enter<F: Dynamics<f64, N, M>>(
        dynamics: &F,
        time: Time,
        state: &State<N>,
        kept: Option<&[[f64; 2]]>,
    ) -> Self {
        let psi = match kept {
            Some(kept) => from_kept(kept),
            None => in_pairs(dynamics, time, state),
        };
        Self::at(dynamics, (time.value, state), &psi)
    }

    /// What goes on with the next segment.
    #[cold]
    pub(crate) fn kept(&self) -> Vec<[f64; 2]> {
        let pairs = self.reference.iter().zip(&self.remainder);
        pairs.map(|(&high, &low)| [high, low]).collect()
    }

    /// Whether ψ is further from its level than the rounding errors of evaluating it: a state that
    /// is better than them is not to be moved by them.
    pub(crate) fn strays<F: Dynamics<f64, N, M>>(
        &self,
        dynamics: &F,
        time: Time,
        state: &State<N>,
    ) -> bool {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let remainder = remainder(dynamics, time, state);
        let residual = self.rounded_residual(&psi, &multiplier, &remainder);
        let size = dynamics.conserved_size(time.value, &state.x);
        let mut errors = residual.iter().zip(&size);
        errors.any(|(residual, size)| residual.abs() > ROUNDING * size)
    }
}

/// The part of the scale below which the slope of ψ of `states` states is little. Where ψ is not
/// evaluated in pairs of doubles, nothing is gained by trying.
const fn little(states: usize) -> f64 {
    if states > MOST_IN_PAIRS { NONE } else { LITTLE }
}

/// Row m of Λ.
#[inline(always)]
fn row<S: Masked, const N: usize, const M: usize>(
    multiplier: &Matrix<S, M, N>,
    m: usize,
) -> Vector<S, N> {
    vector!(|i| multiplier[(m, i)])
}

/// ψ_ref of a segment that was stopped; NaN where there is none.
#[cold]
fn from_kept<const M: usize>(kept: &[[f64; 2]]) -> Vector<Pair<f64>, M> {
    vector!(|i| {
        let [high, low] = kept.get(i).copied().unwrap_or([f64::NAN; 2]);
        Pair::new(high, low)
    })
}
