//! The point where an exact flow meets a guard: the root of g in the short series at the end of the
//! step, or at the nearest multiple of the smallest one, then a slide along the field, which is a
//! straight line over what is left.

use super::segment::{Entered, Segment};
use super::step_sizes::StepSizes;
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{Scalar, State, Time};
use crate::contract::{Dynamics, Guards, Vector};
use crate::method::{Ended, Failure, Sink};

/// Newton iterations of a crossing.
const MOST_ITERATIONS: u32 = 20;

/// A crossing.
#[derive(Clone, Copy)]
pub(super) struct Found {
    pub(super) side: usize,
    /// How long after the start of the step.
    pub(super) elapsed: f64,
    /// Whether that is more than an estimate.
    pub(super) precise: bool,
    /// How long after the start of the step g is positive, and negative, with one root in between.
    pub(super) bracket: (f64, f64),
}

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// Moves to the guard, met in a step over a time to a state `end`: t̂* and x̂* on the flow with
    /// g = 0; on the level of the segment, where that is looked at.
    #[inline(always)]
    pub(super) fn cross<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        sizes: &mut StepSizes<N>,
        entered: Option<&mut Entered<N, M>>,
        found: Found,
        end: (f64, &State<N>),
    ) -> Result<Ended, Failure> {
        let (guard, _) = dynamics.sides()[found.side];
        let (mut time, mut state) = match self.meet(dynamics, sizes, found, end) {
            Some(point) => point,
            None => self.halve(dynamics, sizes, found),
        };
        let mut rate = slide(dynamics, guard, &mut time, &mut state);
        if let Some(entered) = entered
            && let Some(on_level) = self.on_level(dynamics, entered, time, state)
        {
            state = on_level;
            rate = slide(dynamics, guard, &mut time, &mut state);
        }
        if !is_finite(&state.x) || !rate.is_finite() {
            return Err(Failure::not_located(guard, end.0));
        }
        self.outputs(sizes, time);
        self.cursor.state = state.by_numbers();
        self.cursor.time = time;
        self.sink.statistics().steps += 1;
        Ok(Ended::AtGuard { guard, rate })
    }

    /// Where the flow meets a guard in a step over `tau` to `end`, but for a slide along the field;
    /// nothing if a root of g is not found within the bracket: it may be another one.
    #[inline(always)]
    fn meet<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        sizes: &mut StepSizes<N>,
        found: Found,
        (tau, end): (f64, &State<N>),
    ) -> Option<(Time, State<N>)> {
        /// Nodes to try: an estimate is mostly next to the right one.
        const MOST_NODES: u32 = 16;
        let (guard, _) = dynamics.sides()[found.side];
        let mut elapsed = if found.precise {
            found.elapsed
        } else {
            sizes.expected(found.side, found.elapsed)
        };
        for _ in 0..MOST_NODES {
            let (node, offset, first) = if sizes.ends_next_to(tau, elapsed) {
                (*end, tau, elapsed - tau)
            } else {
                sizes.node(&self.cursor.state, elapsed)
            };
            let short = sizes.short(node);
            let time = self.cursor.time.after(offset);
            let (value, by_time, _) = switching(dynamics, guard, time, &node);
            let mut along = sizes.along(found.side, &short.field());
            along[0] += by_time;
            // at the start of the step there may be a root that does not count
            let start = if found.precise || offset == 0.0 {
                first
            } else {
                -value * along[0] / (along[0] * along[0] - value * along[1])
            };
            let rest = fall(value, &along, start, tau)?;
            elapsed = offset + rest;
            let (lower, upper) = found.bracket;
            if elapsed < lower || elapsed > upper {
                return None;
            }
            if sizes.is_next_to(rest) {
                sizes.keep(found.side, elapsed);
                return Some((time.after(rest), short.after(rest)));
            }
        }
        None
    }

    /// The same by halving the bracket.
    #[cold]
    #[inline(never)]
    fn halve<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        sizes: &mut StepSizes<N>,
        found: Found,
    ) -> (Time, State<N>) {
        let (guard, side) = dynamics.sides()[found.side];
        let (mut lower, mut upper) = found.bracket;
        loop {
            let middle = f64::midpoint(lower, upper);
            let (time, state) = (
                self.cursor.time.after(middle),
                sizes.reach(&self.cursor.state, middle),
            );
            if middle <= lower || middle >= upper {
                return (time, state);
            }
            let (value, ..) = switching(dynamics, guard, time, &state);
            if side.sign() * value > 0.0 {
                lower = middle;
            } else {
                upper = middle;
            }
        }
    }
}

/// g with the remainders of time and state, ∂ₜg and ∇g.
#[inline(always)]
fn switching<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
    dynamics: &D,
    guard: usize,
    time: Time,
    state: &State<N>,
) -> (f64, f64, Vector<f64, N>) {
    let guards = dynamics.guards();
    let value = guards.switching_function(guard, time.value, &state.x);
    let (by_time, gradient) = guards.switching_gradient(guard, time.value, &state.x);
    let rest = gradient.dot(&state.remainder) + by_time * time.remainder;
    (value + rest, by_time, gradient)
}

/// Moves along the field to g = 0, which is next to the state; dg/dt.
#[inline(always)]
fn slide<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
    dynamics: &D,
    guard: usize,
    time: &mut Time,
    state: &mut State<N>,
) -> f64 {
    let (value, by_time, gradient) = switching(dynamics, guard, *time, state);
    let field = dynamics.vector_field(time.value, &state.x);
    let rate = by_time + gradient.dot(&field);
    let delta = -value / rate;
    state.remainder += field * delta;
    *state = state.normalised();
    *time = time.after(delta);
    rate
}

/// The root of c + Σ cₖ dᵏ, k from 1, next to `start`, by Halley's method; nothing if it is further
/// than it can be.
#[inline(always)]
fn fall<const T: usize>(c: f64, along: &[f64; T], start: f64, scale: f64) -> Option<f64> {
    /// The method leaves the third power of the last correction, and the slide the square of that.
    const LAST: f64 = 5e-4;
    let mut d = start;
    for _ in 0..MOST_ITERATIONS {
        let (mut value, mut slope, mut half_bend) = (0.0f64, 0.0f64, 0.0f64);
        for &coefficient in along.iter().rev() {
            half_bend = half_bend.fused(d, slope);
            slope = slope.fused(d, value);
            value = value.fused(d, coefficient);
        }
        half_bend = half_bend.fused(d, slope);
        slope = slope.fused(d, value);
        value = value.fused(d, c);
        let delta = value * slope / (slope * slope - value * half_bend);
        d -= delta;
        // the next root is about slope / half_bend away
        let is_small = delta.abs() <= LAST * scale;
        if is_small && (delta * half_bend).abs() <= LAST * slope.abs() {
            return Some(d);
        }
    }
    None
}
