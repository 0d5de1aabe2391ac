//! The point where a Taylor step meets a guard: t̂* and x̂* such that g = 0 and ψ keeps its
//! level, both to rounding.
//!
//! The root of g along the polynomial is found by Halley's method, with d²g/dt² from the cubic
//! between the start of the step and the point. The rest, so small that the flow is a straight
//! line over it, is taken together with what is off the level: with u = −Λ⁺(ψ − ψ_ref) and
//! δ = −(g + ∇g·u)/(dg/dt) the point moves by u + f δ and the time by δ, because f keeps ψ. The
//! last time g and ψ are evaluated in pairs of doubles, at the point with its remainder: both
//! hold to some thirty digits, and transitions add nothing to the level.

use super::segment::{Here, Segment};
use crate::arithmetic::linear::{dot, is_finite};
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Guards, Vector};
use crate::expansion::jet::Jet;
use crate::level::{Level, Weights, switching_in_pairs};
use crate::method::{Ended, Failure, Sink};
use crate::series::Unroll;

/// Corrections of a crossing next to it.
const MOST_CORRECTIONS: u32 = 12;
/// Iterations towards a crossing, of which some may halve its bracket.
const MOST_HALVINGS: u32 = 100;
/// A correction of the time smaller than this part of the step is made along the field.
const SMALL: f64 = 1e-8;

/// A crossing in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) guard: usize,
    /// The sign of g in the region that is left.
    pub(super) sign: f64,
    /// About how long after the start.
    pub(super) elapsed: f64,
    /// How long after the start g is positive, and negative, with one root in between.
    pub(super) bracket: (f64, f64),
    /// g and dg/dt at the start of the step, unless `elapsed` is a root to rounding.
    pub(super) start: Option<(f64, f64)>,
}

impl Found {
    /// The correction of a root at `elapsed`: a step of Halley's method, or of Newton's next to the
    /// root.
    #[inline(always)]
    fn correction<const N: usize>(&self, elapsed: f64, approach: &Approach<N>) -> f64 {
        let &Approach { value, rate, .. } = approach;
        match self.start {
            Some((start, slope)) => {
                let inverse = 1.0 / elapsed;
                let chord = (start - value) * inverse;
                let bend = inverse * (6.0 * chord + 2.0 * slope + 4.0 * rate);
                -value * rate / (rate * rate - 0.5 * value * bend)
            }
            None => -value / rate,
        }
    }
}

/// g at a point of the solution, and how it changes there.
struct Approach<const N: usize> {
    value: f64,
    gradient: Vector<f64, N>,
    /// f
    field: Vector<f64, N>,
    /// dg/dt
    rate: f64,
}

impl<const N: usize> Approach<N> {
    #[inline(always)]
    fn at<const M: usize, D: Dynamics<f64, N, M>>(
        dynamics: &D,
        guard: usize,
        time: Time,
        state: &State<N>,
    ) -> Self {
        let guards = dynamics.guards();
        let value = guards.switching_function(guard, time.value, &state.x);
        let (by_time, gradient) = guards.switching_gradient(guard, time.value, &state.x);
        let field = dynamics.vector_field(time.value, &state.x);
        Self {
            value: value + dot(&gradient, &state.remainder) + by_time * time.remainder,
            rate: by_time + dot(&gradient, &field),
            gradient,
            field,
        }
    }

    /// Moves the time and the state by `off` and along the field such that g = 0; returns by how
    /// much the state moved.
    #[inline(always)]
    fn remove(
        &self,
        time: &mut Time,
        state: &mut State<N>,
        off: &Vector<f64, N>,
    ) -> Vector<f64, N> {
        let delta = -(self.value + dot(&self.gradient, off)) / self.rate;
        let displacement = off + self.field * delta;
        state.remainder += displacement;
        *state = state.normalised();
        *time = time.after(delta);
        displacement
    }
}

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// Moves to the guard.
    #[inline(never)]
    pub(super) fn arrive<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
        tau: f64,
    ) -> Result<Ended, Failure> {
        let guard = found.guard;
        let located = self
            .locate::<P, M, D, U>(dynamics, level, jet, found, tau)
            .or_else(|| self.about_condition::<P, M, D, U>(dynamics, jet, found));
        let Some((time, state, rate)) = located else {
            return Err(Failure::not_located(guard, tau));
        };
        let elapsed = time.since(self.cursor.time).clamp(0.0, tau);
        let here = Here::of(self);
        if self.sink.next_output().is_some() {
            self.outputs_along::<P, M, D, U>(dynamics, level, jet, &here, (elapsed, time));
        }
        self.cursor.state = state;
        self.cursor.time = time;
        self.sink.statistics().steps += 1;
        self.memory.step = tau;
        Ok(Ended::AtGuard { guard, rate })
    }

    /// About where the solution comes to the condition of a proof, on which f may have no value;
    /// nothing for an interface.
    #[cold]
    fn about_condition<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
    ) -> Option<(Time, State<N>, f64)> {
        if !dynamics.guards().is_condition(found.guard) {
            return None;
        }
        let state = self
            .cursor
            .state
            .after(&jet.increment(found.elapsed))
            .normalised();
        let time = self.cursor.time.after(found.elapsed);
        is_finite(&state.x).then_some((time, state, f64::NAN))
    }

    /// t̂*, x̂* and dg/dt there: by Halley's method alone, which mostly needs no bracket.
    #[inline(always)]
    fn locate<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        level: &Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
        tau: f64,
    ) -> Option<(Time, State<N>, f64)> {
        let mut elapsed = found.elapsed;
        for _ in 0..MOST_CORRECTIONS {
            let (place, approach) = self.approach(dynamics, jet, found.guard, elapsed);
            let delta = found.correction(elapsed, &approach);
            if delta.abs() <= SMALL * tau {
                let (lower, upper) = found.bracket;
                if elapsed < lower || elapsed > upper {
                    break;
                }
                return self.settle(dynamics, level, found.guard, place, approach);
            }
            elapsed += delta;
        }
        self.locate_in_bracket::<P, M, D, U>(dynamics, level, jet, found, tau)
    }

    /// The same within the bracket, which is halved where the method leaves it.
    #[cold]
    #[inline(never)]
    fn locate_in_bracket<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        level: &Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        found: &Found,
        tau: f64,
    ) -> Option<(Time, State<N>, f64)> {
        let mut elapsed = found.elapsed;
        let (mut lower, mut upper) = found.bracket;
        for _ in 0..MOST_HALVINGS {
            let (place, approach) = self.approach(dynamics, jet, found.guard, elapsed);
            let delta = found.correction(elapsed, &approach);
            if delta.abs() <= SMALL * tau {
                return self.settle(dynamics, level, found.guard, place, approach);
            }
            if found.sign * approach.value > 0.0 {
                lower = elapsed;
            } else {
                upper = elapsed;
            }
            let next = elapsed + delta;
            elapsed = if next >= lower && next <= upper {
                next
            } else {
                f64::midpoint(lower, upper)
            };
        }
        None
    }

    /// The point of the series after `elapsed`, and g there.
    #[inline(always)]
    fn approach<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &self,
        dynamics: &D,
        jet: &Jet<D, U, N, M, P>,
        guard: usize,
        elapsed: f64,
    ) -> ((Time, State<N>), Approach<N>) {
        let time = self.cursor.time.after(elapsed);
        let state = self.cursor.state.after(&jet.increment(elapsed));
        let approach = Approach::at(dynamics, guard, time, &state);
        ((time, state), approach)
    }

    /// The point on the guard next to one that is close to it.
    #[inline(always)]
    fn settle<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        level: &Level<N, M>,
        guard: usize,
        place: (Time, State<N>),
        approach: Approach<N>,
    ) -> Option<(Time, State<N>, f64)> {
        // beyond a condition ψ may have another value
        let corrects = self.method.corrects_level() && !dynamics.guards().is_condition(guard);
        let settled = self.settle_on(dynamics, level, guard, place, (approach, corrects));
        if settled.is_none() && corrects {
            return self.settle_uncorrected(dynamics, level, guard, place);
        }
        settled
    }

    /// The same without a correction of the level, where ψ has no gradient: at a root that is zero
    /// on the guard.
    #[cold]
    #[inline(never)]
    fn settle_uncorrected<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        level: &Level<N, M>,
        guard: usize,
        (time, state): (Time, State<N>),
    ) -> Option<(Time, State<N>, f64)> {
        let approach = Approach::at(dynamics, guard, time, &state);
        self.settle_on(dynamics, level, guard, (time, state), (approach, false))
    }

    /// Takes g and what is off the level of ψ off a point close to the guard: in doubles
    /// until what is left is of the size of their rounding errors, then once in pairs of doubles.
    #[inline(always)]
    fn settle_on<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        level: &Level<N, M>,
        guard: usize,
        (mut time, mut state): (Time, State<N>),
        (mut approach, corrects): (Approach<N>, bool),
    ) -> Option<(Time, State<N>, f64)> {
        /// A displacement of this part of the state or of the step has an error of second order far below a
        /// rounding error of doubles, and after one more of pairs.
        const SMALL: f64 = 1e-11;
        let weights = Weights::new(&state.x, &(state.x - self.cursor.state.x));
        let small = SMALL * SMALL * weights.sum();
        let mut psi = dynamics.multiplier(time.value, &state.x);
        let mut before = f64::INFINITY;
        for _ in 0..MOST_CORRECTIONS {
            let off = match corrects {
                true => level.correction_by(dynamics, time, &state, &weights, &psi),
                false => Vector::zeros(),
            };
            let displacement = approach.remove(&mut time, &mut state, &off);
            let size = dot(&displacement, &displacement);
            approach = Approach::at(dynamics, guard, time, &state);
            psi = dynamics.multiplier(time.value, &state.x);
            // where g hardly changes, its rounding errors in doubles move the point further
            if size <= small || 4.0 * size >= before {
                break;
            }
            before = size;
        }
        for _ in 0..MOST_CORRECTIONS {
            approach.value = switching_in_pairs(dynamics, guard, time, &state);
            let off = match corrects {
                true => {
                    let residual = level.residual(dynamics, time, &state);
                    level.towards(&psi.1, &residual, &weights)
                }
                false => Vector::zeros(),
            };
            let displacement = approach.remove(&mut time, &mut state, &off);
            if dot(&displacement, &displacement) <= small {
                return is_finite(&state.x).then_some((time, state, approach.rate));
            }
            approach = Approach::at(dynamics, guard, time, &state);
            psi = dynamics.multiplier(time.value, &state.x);
        }
        None
    }
}
