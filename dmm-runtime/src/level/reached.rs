//! The end of a step, put back on the level.

use pulp::NullaryFnOnce;

use super::factors::Factors;
use super::weights::COARSE;
use super::{Level, Weights, little, remainder, row};
use crate::arithmetic::linear::dot;
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Vector};

/// Steps that are made without a correction after one that was small. Beyond two the errors that a
/// level keeps small begin to grow.
const FREE: f64 = 2.0;

/// Which steps are corrected where nothing bounds a region.
#[derive(Debug)]
pub(crate) struct Turn<'a, S: Masked> {
    /// How many are still made without, from 0 at the entry on.
    pub(crate) free: &'a mut S,
    /// The last ones are corrected.
    pub(crate) last: S::Mask,
    /// A smaller part of the state is a small displacement.
    pub(crate) near: f64,
}

/// Where a displacement towards the level leaves a state.
struct Nearly<K> {
    /// Where its square, which it leaves, is more than a rounding error.
    left: K,
    /// Where it was small.
    was_near: K,
}

/// A displacement by this part of the state is not left to be made good by the next step: what it leaves,
/// its square, is to be far below the error of the step, which is about as large as the displacement.
const FAR: f64 = 1e-2;

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
        if !corrects {
            return state.normalised();
        }
        let weights = Weights::new(&state.x, displacement);
        self.reached_by_steps(dynamics, time, state, (&weights, used))
    }

    /// The same by one displacement, if it is the step's turn, and where a state is off the level by
    /// more than a rounding error then.
    ///
    /// What is left of one step the displacement of a later one takes off, as the level is that of
    /// the entry: it does not accumulate. A state that is told, or at which a segment ends, has to
    /// be [`reached`](Self::reached).
    #[inline(always)]
    pub(crate) fn nearly_reached<F: Dynamics<S, N, M>>(
        &self,
        dynamics: &F,
        time: Time<S>,
        state: &mut State<N, S>,
        displacement: &Vector<S, N>,
        (corrects, used): (bool, S::Mask),
        Turn { free, last, near }: Turn<'_, S>,
    ) -> S::Mask {
        if M == 0 || dynamics.quantities() == 0 || !corrects {
            return S::Mask::all_are(false);
        }
        let none = S::from_f64(0.0);
        let is_bounded = dynamics.is_bounded();
        let is_due = if is_bounded {
            used
        } else {
            free.above(none).not().or(last).and(used)
        };
        let fewer = *free - S::from_f64(1.0);
        if !is_due.any() {
            *free = fewer;
            return used;
        }
        let weights = Weights::new(&state.x, displacement);
        let once = Once {
            level: self,
            dynamics,
            place: (time, state),
            how: (&weights, is_due),
            near,
        };
        let Nearly { left, was_near } = if M > 1 && S::LANES == 1 {
            S::apart(once)
        } else {
            once.call()
        };
        if is_bounded {
            return left;
        }
        *free = is_due.select(was_near.select(S::from_f64(FREE), none), fewer);
        left.or(used.and(is_due.not()))
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

/// One displacement, and more only where it is large or ψ has little slope.
struct Once<'a, F, const N: usize, const M: usize, S: Masked> {
    level: &'a Level<N, M, S>,
    dynamics: &'a F,
    place: (Time<S>, &'a mut State<N, S>),
    how: (&'a Weights<N, S>, S::Mask),
    near: f64,
}

impl<F: Dynamics<S, N, M>, const N: usize, const M: usize, S: Masked> NullaryFnOnce
    for Once<'_, F, N, M, S>
{
    type Output = Nearly<S::Mask>;

    #[inline(always)]
    fn call(self) -> Nearly<S::Mask> {
        let Self {
            level,
            dynamics,
            near,
            ..
        } = self;
        let ((time, state), (weights, used)) = (self.place, self.how);
        let (psi, multiplier) = dynamics.multiplier(time.value, &state.x);
        let off = remainder(dynamics, time, state);
        let residual = level.rounded_residual(&psi, &multiplier, &off);
        let little = level.bound(little(N), weights);
        let (displacement, steep, left, is_far) = if M == 1 {
            let row = row(&multiplier, 0);
            let weighted = weights.times(&row);
            let square = dot(&row, &weighted);
            let inverse = S::from_f64(1.0) / square;
            let gain: Vector<S, N> = vector!(|i| weighted[i] * inverse);
            let (size, unit) = (residual[0] * residual[0], square * weights.unit);
            let left = size.above(unit * S::from_f64(COARSE * COARSE));
            let is_far = size.above(unit * S::from_f64(near * near));
            let displacement = vector!(|i| -(gain[i] * residual[0]));
            (displacement, square.above(little[0]), left, is_far)
        } else {
            let rows = (&multiplier, dynamics.quantities());
            let factors = Factors::new(weights, rows, &little);
            let displacement = factors.displacement(&residual);
            let left = weights.exceeded_by(&displacement, COARSE);
            let is_far = weights.exceeded_by(&displacement, near);
            (displacement, factors.steep, left, is_far)
        };
        let reached = if S::LANES > 1 && !dynamics.is_bounded() {
            let none = S::from_f64(0.0);
            let moved = vector!(|i| used.select(displacement[i], none).settled());
            displaced(*state, &moved)
        } else {
            displaced(*state, &displacement)
        };
        let flat = steep.not().and(used);
        let left = left.and(steep).and(used);
        let was_near = is_far.not().and(steep);
        if !flat.or(left).any() {
            *state = reached;
            return Nearly { left, was_near };
        }
        *state = select(flat, state, &reached);
        let far = weights.exceeded_by(&displacement, FAR).and(left);
        let rest = flat.or(far);
        if rest.any() {
            *state = level.reached_by_steps(dynamics, time, *state, (weights, rest));
        }
        Nearly {
            left: left.and(rest.not()),
            was_near,
        }
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
            used = used.and(weights.exceeded_by(&displacement, COARSE));
            if !used.any() {
                break;
            }
        }
        state
    }
}

/// The state with a displacement.
#[inline(always)]
pub(super) fn displaced<const N: usize, S: Masked>(
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
