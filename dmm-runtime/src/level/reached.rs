//! The end of a step, put back on the level.

use pulp::NullaryFnOnce;

use super::factors::Factors;
use super::weights::COARSE;
use super::{Level, Weights, little, remainder, row};
use crate::arithmetic::linear::dot;
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::arithmetic::{Matrix, State, Time};
use crate::contract::{Dynamics, Vector};

/// Corrections with the same slopes: each leaves the product of the first displacement and its own.
const MOST_ALIKE: u32 = 3;

impl<const N: usize, const M: usize, S: Masked> Level<N, M, S> {
    /// The state that a step over `displacement` has come to, put back on the level if it
    /// `corrects`, in the lanes that are `used`.
    #[inline(always)]
    pub(crate) fn reached<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        displacement: &Vector<S, N>,
        (corrects, used): (bool, S::Mask),
    ) -> State<N, S> {
        if M == 0 || dynamics.quantities() == 0 || !corrects {
            return state.normalised();
        }
        let weights = Weights::new(&state.x, displacement);
        if M == 1 {
            return self.reached_at_once(dynamics, time, state, (&weights, used));
        }
        if S::LANES == 1 {
            return S::apart(|| self.reached_by_factors(dynamics, time, state, (&weights, used)));
        }
        self.reached_by_factors(dynamics, time, state, (&weights, used))
    }

    /// The same for several quantities, where each adds to the slope of the others. What a large
    /// correction leaves, the square of it, is taken off with the same slopes, again and again.
    #[inline(always)]
    fn reached_by_factors<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        (weights, used): (&Weights<N, S>, S::Mask),
    ) -> State<N, S> {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let little = self.bound(little(N), weights);
        let factors = Factors::new(weights, (&multiplier, dynamics.quantities()), &little);
        let flat = factors.steep.not().and(used);
        if !factors.steep.and(used).any() {
            return self.reached_by_steps(dynamics, time, state, (weights, flat));
        }
        let off = remainder(dynamics, time, &state);
        let first = factors.displacement(&self.rounded_residual(&psi, &multiplier, &off));
        let steep = factors.steep.and(used);
        let reached = select(steep, &displaced(state, &first), &state);
        let left = weights.are_left_by(&first).and(steep);
        let at = (time, reached, left);
        let (mut reached, left) =
            self.reached_alike(dynamics, &multiplier, at, |state, residual| {
                let next = factors.displacement(residual);
                // the same slopes again leave the product with the first displacement
                let left = weights.are_left_by_both(&first, &next);
                (displaced(state, &next), left)
            });
        let rest = flat.or(left);
        if rest.any() {
            reached = self.reached_by_steps(dynamics, time, reached, (weights, rest));
        }
        reached
    }

    /// The same for one quantity, where it has some slope.
    #[inline(always)]
    fn reached_at_once<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        (weights, used): (&Weights<N, S>, S::Mask),
    ) -> State<N, S> {
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let row = row(&multiplier, 0);
        let weighted = weights.times(&row);
        let square = dot(&row, &weighted);
        let steep = square.above(self.bound(little(N), weights)[0]);
        let flat = steep.not().and(used);
        if !steep.and(used).any() {
            return self.reached_by_steps(dynamics, time, state, (weights, flat));
        }
        let inverse = S::from_f64(1.0) / square;
        let gain: Vector<S, N> = vector!(|i| weighted[i] * inverse);
        let off = remainder(dynamics, time, &state);
        let first = self.rounded_residual(&psi, &multiplier, &off)[0];
        let reached = less(state, &gain, first);
        let coarse = square * (weights.unit * S::from_f64(COARSE * COARSE));
        let left = (first * first).above(coarse).and(steep).and(used);
        let at = (time, reached, left);
        // the squares of displacements, relative to the state
        let share = inverse / weights.unit;
        let firsts = first * first * share;
        let coarse_together = S::from_f64(COARSE * COARSE * COARSE * COARSE);
        let twice = S::from_f64(2.0) / first;
        let mut bent = None;
        let (mut reached, left) =
            self.reached_alike(dynamics, &multiplier, at, |state, residual| {
                let next = residual[0];
                let bent = *bent.get_or_insert_with(|| bend(twice, next));
                // what that leaves is of third order
                let left = (firsts * firsts * (next * next * share)).above(coarse_together);
                (less(state, &gain, bent.fused(next, next)), left)
            });
        let rest = flat.or(left);
        if rest.any() {
            reached = select(flat, &state, &reached);
            reached = self.reached_by_steps(dynamics, time, reached, (weights, rest));
        }
        reached
    }

    /// Corrections with the slopes of the first, in the lanes that are left, and the lanes that still
    /// are: `corrected` gives the state without a residual, and where the rest is no rounding error.
    #[inline(always)]
    fn reached_alike<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        multiplier: &Matrix<S, M, N>,
        (time, mut reached, mut left): (Time<S>, State<N, S>, S::Mask),
        mut corrected: impl FnMut(State<N, S>, &Vector<S, M>) -> (State<N, S>, S::Mask),
    ) -> (State<N, S>, S::Mask) {
        for _ in 0..MOST_ALIKE {
            if !left.any() {
                break;
            }
            let psi = dynamics.conserved(time.value, &reached.x);
            let off = remainder(dynamics, time, &reached);
            let (next, is_left) =
                corrected(reached, &self.rounded_residual(&psi, multiplier, &off));
            reached = select(left, &next, &reached);
            left = left.and(is_left);
        }
        (reached, left)
    }

    /// The same by one correction after the other, in the lanes that are `used`.
    #[inline(always)]
    fn reached_by_steps<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: State<N, S>,
        how: (&Weights<N, S>, S::Mask),
    ) -> State<N, S> {
        let steps = StepByStep {
            level: self,
            dynamics,
            place: (time, &state),
            how,
        };
        S::apart(steps)
    }
}

/// Corrections, while the square of the last one is no rounding error.
struct StepByStep<'a, F, const N: usize, const M: usize, S: Masked> {
    level: &'a Level<N, M, S>,
    dynamics: &'a F,
    place: (Time<S>, &'a State<N, S>),
    how: (&'a Weights<N, S>, S::Mask),
}

impl<F: Dynamics<S, N, M>, const N: usize, const M: usize, S: Masked> NullaryFnOnce
    for StepByStep<'_, F, N, M, S>
{
    type Output = State<N, S>;

    #[inline(always)]
    fn call(self) -> State<N, S> {
        /// The error falls to its square each time, and then to the part that damping leaves.
        const MOST: u32 = 9;
        let (time, mut state) = (self.place.0, *self.place.1);
        let (weights, mut used) = self.how;
        for _ in 0..MOST {
            let how = (weights, used);
            let displacement = self.level.correction(self.dynamics, time, &state, how);
            state = select(used, &displaced(state, &displacement), &state);
            used = used.and(weights.are_left_by(&displacement));
            if !used.any() {
                break;
            }
        }
        state
    }
}

/// By how much of itself a residual is to be made larger before the first slope takes it off, where the
/// displacement before left `next` of `first`: that residual is r − s + cs² at s = r, and has the
/// slope 2 next/first − 1 there. Nothing where the curve is too steep for that.
#[inline(always)]
fn bend<S: Masked>(twice: S, next: S) -> S {
    const LARGEST: f64 = 0.5;
    let ratio = twice * next;
    let is_small = S::from_f64(LARGEST).above(ratio.abs());
    is_small.select(ratio, S::from_f64(0.0))
}

/// The state without `gain` times a residual.
#[inline(always)]
fn less<const N: usize, S: Masked>(
    mut state: State<N, S>,
    gain: &Vector<S, N>,
    residual: S,
) -> State<N, S> {
    for i in 0..N {
        state.remainder[i] -= gain[i] * residual;
    }
    state.normalised()
}

/// The state with a displacement.
#[inline(always)]
fn displaced<const N: usize, S: Masked>(
    mut state: State<N, S>,
    displacement: &Vector<S, N>,
) -> State<N, S> {
    for i in 0..N {
        state.remainder[i] += displacement[i];
    }
    state.normalised()
}

/// The one state where a mask is true, the other elsewhere.
#[inline(always)]
pub(super) fn select<const N: usize, S: Masked>(
    mask: S::Mask,
    one: &State<N, S>,
    other: &State<N, S>,
) -> State<N, S> {
    State {
        x: mask.select_vector(&one.x, &other.x),
        remainder: mask.select_vector(&one.remainder, &other.remainder),
    }
}
