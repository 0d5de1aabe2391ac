//! What a segment of one-step steps works with, whatever decides their size: a step is accepted on
//! its level, and outputs within it are served by steps of their own.

use super::crossing::Locator;
use super::map::{OneStep, Step};
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Guards, Side, Vector};
use crate::level::{COARSE, Level, Weights};
use crate::method::{Cursor, Failure, Sink, Statistics, StepFailure};

/// A segment under way.
pub(super) struct Segment<'a, Map, Loc, S, const N: usize> {
    pub(super) map: &'a Map,
    pub(super) locator: &'a Loc,
    pub(super) corrects_level: bool,
    pub(super) cursor: &'a mut Cursor<N>,
    pub(super) sink: &'a mut S,
}

impl<Map: OneStep, Loc: Locator, S: Sink<N>, const N: usize> Segment<'_, Map, Loc, S, N> {
    /// A step from here.
    pub(super) fn step<'b, D>(&'b self, dynamics: &'b D, tau: f64) -> Step<'b, D, N> {
        Step {
            dynamics,
            t0: self.cursor.time.value,
            x0: &self.cursor.state.x,
            tau,
        }
    }

    /// Moves over `increment` to `time`, corrected towards the level.
    pub(super) fn accept<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        increment: &Vector<f64, N>,
        tau: f64,
        time: Time,
    ) -> Result<(), Failure> {
        let mut state = self.cursor.state.after(increment);
        if self.corrects_level {
            restore(self.map, dynamics, (level, time), &mut state, increment);
        }
        let state = state.normalised();
        // neither the step nor the correction has left the range of doubles
        if !is_finite(&state.x) {
            return Err(StepFailure::NotFinite.over(tau));
        }
        self.cursor.state = state;
        self.cursor.time = time;
        self.sink.statistics().steps += 1;
        Ok(())
    }

    /// Serves the output times up to `end`, the end of a step over `tau`.
    pub(super) fn outputs<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        tau: f64,
        end: Time,
    ) -> Result<(), Failure> {
        while let Some(t) = self.sink.next_output()
            && t <= end.value
        {
            let elapsed = Time::new(t).since(self.cursor.time).max(0.0).min(tau);
            let increment = if elapsed > 0.0 {
                let step = self.step(dynamics, elapsed);
                let increment = self.map.step(&step, &mut Statistics::default());
                increment.map_err(|failure| failure.over(elapsed))?
            } else {
                Vector::zeros()
            };
            let x = self.cursor.state.after(&increment).rounded();
            self.sink.output(t, x);
        }
        Ok(())
    }
}

/// Corrects a state that an increment led to towards the level. By a map that does not conserve, that
/// is more than rounding: it is left for later where it would lead across a guard.
#[inline(always)]
pub(super) fn restore<Map: OneStep, const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
    map: &Map,
    dynamics: &D,
    (level, time): (&Level<N, M>, Time),
    state: &mut State<N>,
    increment: &Vector<f64, N>,
) {
    /// Of truncation errors; each squares what is left.
    const MOST_CORRECTIONS: u32 = 4;
    let weights = Weights::new(&state.x, increment);
    let before = *state;
    let mut displacement = level.correction(dynamics, time, state, (&weights, true));
    state.remainder += displacement;
    if map.conserves() {
        return;
    }
    for _ in 1..MOST_CORRECTIONS {
        if !weights.exceeded_by(&displacement, COARSE) {
            break;
        }
        *state = state.normalised();
        displacement = level.correction(dynamics, time, state, (&weights, true));
        state.remainder += displacement;
    }
    *state = state.normalised();
    let leaves = |&(guard, side): &(usize, Side)| {
        let g = |x| side.sign() * dynamics.guards().switching_function(guard, time.value, x);
        g(&before.x) > 0.0 && g(&state.x) <= 0.0
    };
    if dynamics.sides().iter().any(leaves) {
        *state = before;
    }
}
