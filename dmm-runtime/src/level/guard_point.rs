//! The point where a solution meets a guard: t̂* and x̂* such that g = 0 and ψ keeps its level,
//! both to rounding.
//!
//! The root of g along the polynomial is found by Halley's method, with d²g/dt² from the cubic
//! between the start of the step and the point. The rest, so small that the flow is a straight
//! line over it, is taken together with what is off the level: with u = −Λ⁺(ψ − ψ_ref) and
//! δ = −(g + ∇g·u)/(dg/dt) the point moves by u + f δ and the time by δ, because f keeps ψ. The
//! last time g and ψ are evaluated in pairs of doubles, at the point with its remainder: both
//! hold to some thirty digits, and transitions add nothing to the level.

use super::reached::{displaced, select};
use super::{Level, Weights, switching_in_pairs};
use crate::arithmetic::linear::{dot, is_finite};
use crate::arithmetic::masked::{Mask, Masked, vector};
use crate::arithmetic::{State, Time, filled};
use crate::contract::{Dynamics, Guards, Vector};

/// Corrections of a crossing next to it.
const MOST_CORRECTIONS: u32 = 12;
/// Iterations towards a crossing, of which some may halve its bracket.
const MOST_HALVINGS: u32 = 100;
/// Halley's method comes closer than [`SMALL`] by a correction smaller than this part of the step.
const CLOSE: f64 = 4e-4;
/// A correction of the time smaller than this part of the step is made along the field.
const SMALL: f64 = 1e-8;

/// A crossing in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<S = f64> {
    pub(crate) guard: usize,
    /// The sign of g in the region that is left.
    pub(crate) sign: f64,
    /// About how long after the start.
    pub(crate) elapsed: S,
    /// How long after the start g is positive, and negative, with one root in between.
    pub(crate) bracket: (S, S),
    /// g and dg/dt at the start of the step, unless `elapsed` is a root to rounding.
    pub(crate) start: Option<(S, S)>,
}

/// A point of a solution, and g there.
#[derive(Clone, Copy)]
pub(crate) struct GuardPoint<const N: usize, S: Masked = f64> {
    time: Time<S>,
    pub(crate) state: State<N, S>,
    value: S,
    gradient: Vector<S, N>,
    /// f
    field: Vector<S, N>,
    /// dg/dt
    rate: S,
}

/// A point on the guard, and dg/dt there.
#[derive(Clone, Copy)]
pub(crate) struct OnGuard<const N: usize, S: Masked = f64> {
    pub(crate) time: Time<S>,
    pub(crate) state: State<N, S>,
    pub(crate) rate: S,
}

impl<const N: usize, S: Masked> GuardPoint<N, S> {
    #[inline(always)]
    pub(crate) fn at<const M: usize, D: Dynamics<S, N, M>>(
        dynamics: &D,
        guard: usize,
        time: Time<S>,
        state: State<N, S>,
    ) -> Self {
        let guards = dynamics.guards();
        let value = guards.switching_function(guard, time.value, &state.x);
        let (by_time, gradient) = guards.switching_gradient(guard, time.value, &state.x);
        let field = dynamics.vector_field(time.value, &state.x);
        Self {
            value: value + dot(&gradient, &state.remainder) + by_time * time.remainder,
            rate: by_time + dot(&gradient, &field),
            time,
            state,
            gradient,
            field,
        }
    }

    /// Reads g anew, at the point that it was moved to.
    #[inline(always)]
    fn read<const M: usize, D: Dynamics<S, N, M>>(&mut self, dynamics: &D, guard: usize) {
        let there = Self::at(dynamics, guard, self.time, self.state);
        (self.value, self.rate) = (there.value, there.rate);
        (self.gradient, self.field) = (there.gradient, there.field);
    }

    /// How far to move by `off` and along the field such that g = 0: in the state and in the time.
    #[inline(always)]
    fn displacement(&self, off: &Vector<S, N>) -> (Vector<S, N>, S) {
        // which does not wait for `off`
        let inverse = S::from_f64(1.0) / self.rate;
        let delta = (-(self.value + dot(&self.gradient, off)) * inverse).settled();
        (
            vector!(|i| (off[i] + self.field[i] * delta).settled()),
            delta,
        )
    }

    /// Moves the `used` lanes.
    #[inline(always)]
    fn shift(&mut self, (displacement, delta): (&Vector<S, N>, S), used: S::Mask) {
        // there is nothing to choose from
        let used = if S::LANES == 1 {
            S::Mask::all_are(true)
        } else {
            used
        };
        let time = self.time.after(delta);
        self.state = select(used, &displaced(self.state, displacement), &self.state);
        self.time.value = used.select(time.value, self.time.value);
        self.time.remainder = used.select(time.remainder, self.time.remainder);
    }

    /// A point close to the one that is `found` in a step over `tau` from `start`, with the state `along` it;
    /// and the lanes that have come to it.
    #[inline(always)]
    pub(crate) fn near<const M: usize, D: Dynamics<S, N, M>>(
        dynamics: &D,
        found: &Found<S>,
        start: Time<S>,
        tau: S,
        along: impl Fn(S) -> State<N, S>,
        used: S::Mask,
    ) -> ((Time<S>, State<N, S>), S::Mask) {
        let n = S::from_f64;
        let (close, small) = (n(CLOSE) * tau, n(SMALL) * tau);
        let mut elapsed = found.elapsed;
        let mut open = used;
        let (mut lower, mut upper) = found.bracket;
        let mut iterations = 0;
        loop {
            let (time, state) = (start.after(elapsed), along(elapsed));
            if !open.any() || iterations == MOST_HALVINGS {
                return ((time, state), used.and(open.not()));
            }
            let point = Self::at(dynamics, found.guard, time, state);
            iterations += 1;
            let delta = point.correction(found, elapsed);
            let inside = (n(found.sign) * point.value).above(n(0.0));
            lower = open.and(inside).select(elapsed, lower);
            upper = open.and(inside.not()).select(elapsed, upper);
            let next = elapsed + delta;
            let within = lower.at_most(next).and(next.at_most(upper));
            // at an end of the bracket the root may be a rounding error outside
            let is_there = delta.abs().at_most(small);
            let other = is_there.select(elapsed, n(0.5) * (lower + upper));
            elapsed = open.select(within.select(next, other), elapsed).settled();
            let is_last = is_there.or(within.and(delta.abs().at_most(close)));
            open = open.and(is_last.not());
        }
    }

    /// The same for one lane by Halley's method alone, which mostly needs no bracket; nothing where it
    /// leaves it.
    #[inline(always)]
    pub(crate) fn nearest<const M: usize, D: Dynamics<S, N, M>>(
        dynamics: &D,
        found: &Found<S>,
        start: Time<S>,
        tau: S,
        along: impl Fn(S) -> State<N, S>,
    ) -> Option<(Time<S>, State<N, S>)> {
        let mut elapsed = found.elapsed;
        let mut is_close = false;
        for _ in 0..MOST_CORRECTIONS {
            let (time, state) = (start.after(elapsed), along(elapsed));
            if is_close {
                let (lower, upper) = found.bracket;
                let slack = S::from_f64(SMALL) * tau;
                let inside = (lower - slack).at_most(elapsed);
                let inside = inside.and(elapsed.at_most(upper + slack));
                return inside.all().then_some((time, state));
            }
            let point = Self::at(dynamics, found.guard, time, state);
            let delta = point.correction(found, elapsed);
            is_close = delta.abs().at_most(S::from_f64(CLOSE) * tau).all();
            elapsed += delta;
        }
        None
    }

    /// The correction of a root at `elapsed`: a step of Halley's method, or of Newton's next to the
    /// root.
    #[inline(always)]
    fn correction(&self, found: &Found<S>, elapsed: S) -> S {
        let (n, value, rate) = (S::from_f64, self.value, self.rate);
        match found.start {
            Some((start, slope)) => {
                let inverse = n(1.0) / elapsed;
                let chord = (start - value) * inverse;
                let bend = inverse * (n(6.0) * chord + n(2.0) * slope + n(4.0) * rate);
                -value * rate / (rate * rate - n(0.5) * value * bend)
            }
            None => -value / rate,
        }
    }

    /// Takes g and what is off the level of ψ, if that `corrects`, off a point close to the guard
    /// after an `increment` of the state: in doubles until what is left is of the size of their
    /// rounding errors, then once in pairs of doubles. Returns the point, and the lanes in which
    /// it is one.
    #[inline(always)]
    pub(crate) fn settled<const M: usize, D: Dynamics<S, N, M>>(
        (time, state): (Time<S>, &State<N, S>),
        dynamics: &D,
        level: &Level<N, M, S>,
        guard: usize,
        increment: &Vector<S, N>,
        (corrects, used): (bool, S::Mask),
    ) -> (OnGuard<N, S>, S::Mask) {
        /// A displacement of this part of the state or of the step has an error of second order far
        /// below a rounding error of doubles.
        const SMALL: f64 = 1e-11;
        /// One of this part has one that is below the rounding errors of pairs.
        const SMALLEST: f64 = 1e-15;
        let n = S::from_f64;
        let none: Vector<S, N> = filled(n(0.0));
        let x = state.x;
        let weights = Weights::new(&x, increment);
        let whole = dot(&x, &x) + dot(increment, increment);
        let (small, smallest) = (n(SMALL * SMALL) * whole, n(SMALLEST * SMALLEST) * whole);
        let mut point = Self::at(dynamics, guard, time, *state);
        let mut before = n(f64::INFINITY);
        let mut moves = used;
        for _ in 0..MOST_CORRECTIONS {
            let off = if corrects {
                level.correction(dynamics, point.time, &point.state, (&weights, moves))
            } else {
                none
            };
            let (displacement, delta) = point.displacement(&off);
            let size = dot(&displacement, &displacement);
            // where g hardly changes, its rounding errors in doubles move the point further
            moves = moves
                .and(size.above(smallest))
                .and(before.above(n(4.0) * size));
            if !moves.any() {
                break;
            }
            point.shift((&displacement, delta), moves);
            point.read(dynamics, guard);
            // what is left now is a rounding error
            moves = moves.and(size.above(small));
            if !moves.any() {
                break;
            }
            before = size;
        }
        let mut moves = used;
        for _ in 0..MOST_CORRECTIONS {
            point.value = switching_in_pairs(dynamics, guard, point.time, &point.state);
            let off = if corrects {
                let (_, multiplier) = dynamics.multiplier(point.time.value, &point.state.x);
                let residual = level.residual(dynamics, point.time, &point.state);
                let rows = (&multiplier, dynamics.quantities());
                level.towards(rows, &residual, (&weights, moves))
            } else {
                none
            };
            let (displacement, delta) = point.displacement(&off);
            point.shift((&displacement, delta), moves);
            let size = dot(&displacement, &displacement);
            moves = moves.and(size.at_most(small).not());
            if !moves.any() {
                break;
            }
            let rate = point.rate;
            point.read(dynamics, guard);
            point.rate = moves.select(point.rate, rate);
        }
        let located = used.and(moves.not()).and(is_finite(&point.state.x));
        let Self {
            time, state, rate, ..
        } = point;
        (OnGuard { time, state, rate }, located)
    }
}
