//! Taylor steps: the series of the solution at each point, over as much of its radius of
//! convergence as the tolerance allows.

use std::ops::ControlFlow;

use super::ahead::{Part, Undecided};
use super::segment::{Here, Segment};
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::masked::{Mask, Masked};
use crate::arithmetic::{State, Time, filled};
use crate::contract::{Dynamics, Guards, Vector};
use crate::expansion::jet::Jet;
use crate::expansion::radius::OtherUnit;
use crate::level::{Found, Level, RESCALING, Turn};
use crate::method::{Ended, Failure, Sink, StepFailure};
use crate::series::{Choice, MOST_COEFFICIENTS, Rolled, Unroll};

/// A segment with P coefficients, still to be chosen.
pub(super) struct Choose<'a, D, S, const N: usize, const M: usize> {
    pub(super) segment: Segment<'a, S, N>,
    pub(super) dynamics: &'a D,
}

impl<D, S, const N: usize, const M: usize> Choice for Choose<'_, D, S, N, M>
where
    D: Dynamics<f64, N, M>,
    S: Sink<N>,
{
    type Output = Result<Ended, Failure>;

    fn with<const P: usize, U: Unroll>(mut self) -> Self::Output {
        if self.segment.memory.unit == 1.0 {
            self.segment.expand::<P, M, D, U>(self.dynamics)
        } else {
            self.segment.expand_in_units(self.dynamics)
        }
    }
}

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// Steps with P coefficients, until a guard is met or the end time is reached.
    pub(super) fn expand<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
    ) -> Result<Ended, Failure> {
        let mut here = Here::of(self);
        let mut jet = Jet::<D, U, N, M, P>::new(dynamics, self.method.order(), self.memory.unit);
        let mut level = Level::unknown();
        let end = self.steps::<P, M, D, U>(dynamics, &mut level, &mut jet, &mut here);
        self.memory.step = here.before;
        self.memory.free = here.free;
        self.memory.unit = jet.unit();
        self.sink.statistics().steps += here.steps;
        let ended = match end {
            Next::Crossing { found, tau } => {
                self.go_to_guard::<P, M, D, U>(dynamics, &level, &jet, here, &found, tau)
            }
            Next::Finished => {
                self.cursor.time = here.time;
                self.cursor.state = here.state;
                return Ok(Ended::Finished);
            }
            Next::Stopped(shown) => {
                self.cursor.time = here.time;
                self.cursor.state = shown;
                self.cursor.level = Some(level.kept());
                self.cursor.active.clear();
                self.memory.stopped = Some(here.state);
                return Ok(Ended::Stopped);
            }
            Next::Lost(OtherUnit(unit)) => {
                if here.steps > 0 {
                    self.cursor.active.clear();
                }
                self.cursor.level = Some(level.kept());
                self.stop_at(dynamics, &level, here);
                self.memory.stopped = Some(here.state);
                self.memory.unit = unit;
                return self.expand_in_units(dynamics);
            }
            Next::Not(tau) => Err(StepFailure::NotFinite.over(tau)),
            Next::Unknown { guard, tau } => Err(Failure::undecided(guard, tau)),
        };
        if ended.is_err() {
            self.stop_at(dynamics, &level, here);
        }
        ended
    }

    /// Leaves the cursor at the last point of the steps as an observer is shown it: on the level.
    #[cold]
    #[inline(never)]
    fn stop_at<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        here: Here<N>,
    ) {
        if here.steps > 0 {
            let how = (self.method.corrects_level(), true);
            self.cursor.time = here.time;
            self.cursor.state = level.reached(dynamics, here.time, here.state, &filled(0.0), how);
        }
    }

    /// Shows a point, on the level, if something `left` it off the level after a step over that; and
    /// whether steps end there.
    #[cold]
    #[inline(never)]
    fn show<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: Level<N, M>,
        (time, mut state): (Time, State<N>),
        left: Option<Vector<f64, N>>,
    ) -> (State<N>, ControlFlow<()>) {
        if let Some(displacement) = left {
            state = level.reached(dynamics, time, state, &displacement, (true, true));
        }
        let goes_on = self.sink.point(time, &state);
        (state, goes_on)
    }

    /// The same in any unit of time, not by straight-line code.
    #[cold]
    pub(super) fn expand_in_units<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
    ) -> Result<Ended, Failure> {
        self.expand::<MOST_COEFFICIENTS, M, D, Rolled>(dynamics)
    }

    /// The steps, from local variables to local variables.
    #[inline(always)]
    fn steps<const P: usize, const M: usize, D: Dynamics<f64, N, M>, U: Unroll>(
        &mut self,
        dynamics: &D,
        level: &mut Level<N, M>,
        jet: &mut Jet<D, U, N, M, P>,
        here: &mut Here<N>,
    ) -> Next<N> {
        let end = self.until;
        let fraction = self.memory.fraction;
        let (corrects, near) = (self.method.corrects_level(), self.method.near());
        // Where every guard is a new start, the start has code of its own, which is faster. Elsewhere the code
        // of the series is there once.
        let may_end = <D::Guards as Guards<f64, N>>::MAY_END;
        if may_end {
            jet.expand(dynamics, here.time.value, &here.state.x);
            // after the chain of recurrences, which leaves the processor time for it
            let kept = self.cursor.level.as_deref();
            *level = Level::enter(dynamics, here.time, &here.state, kept);
        }
        loop {
            if !may_end {
                jet.expand(dynamics, here.time.value, &here.state.x);
                if here.steps == 0 {
                    *level = self.level_at_start(dynamics, *here);
                }
            }
            let remaining = (end - here.time.value) - here.time.remainder;
            if remaining <= 0.0 {
                return Next::Finished;
            }
            let wanted = match jet.step(dynamics, here.time.value, fraction, here.before) {
                Ok(wanted) => wanted,
                Err(other) => return Next::Lost(other),
            };
            let mut part = Part::WHOLE;
            let mut state;
            let (tau, time, is_last) = loop {
                let size = part.share * wanted;
                let (tau, time, is_last) = step_to(dynamics.is_autonomous(), here.time, size, end);
                if !(tau > 0.0 && time != here.time) {
                    return Next::Not(size);
                }
                state = jet.after(&here.state, tau);
                if !may_end {
                    break (tau, time, is_last);
                }
                let end = (tau, time, &state);
                match self.look_ahead::<P, M, D, U>(dynamics, jet, *here, end, part) {
                    Ok(None) => break (tau, time, is_last),
                    Ok(Some(found)) => return Next::Crossing { found, tau },
                    Err(Undecided::Shorter(shorter)) => part = shorter,
                    Err(Undecided::Never(guard)) => return Next::Unknown { guard, tau },
                }
            };
            if self.sink.next_output().is_some() {
                self.outputs_along::<P, M, D, U>(dynamics, *level, jet, *here, (tau, time));
            }
            let displacement = state.x - here.state.x;
            let how = (corrects, true);
            let turn = Turn {
                free: &mut here.free,
                last: is_last,
                near,
            };
            let left = level.nearly_reached(dynamics, time, &mut state, &displacement, how, turn);
            if !is_finite(&state.x) {
                return Next::Not(tau);
            }
            here.state = state.by_numbers();
            here.time = time;
            here.before = wanted;
            here.steps += 1;
            if here.steps.is_multiple_of(RESCALING) {
                level.rescale(dynamics, here.time.value, &state);
            }
            if is_last || self.sink.listens() {
                let left = left.then_some(displacement);
                let (shown, goes_on) = self.show(dynamics, *level, (time, state), left);
                if is_last {
                    here.state = shown;
                }
                if goes_on.is_break() {
                    return Next::Stopped(shown);
                }
                if is_last {
                    return Next::Finished;
                }
            }
            if may_end {
                jet.expand(dynamics, here.time.value, &here.state.x);
            }
        }
    }

    /// The level of steps that start here.
    #[cold]
    #[inline(never)]
    fn level_at_start<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        here: Here<N>,
    ) -> Level<N, M> {
        let kept = self.cursor.level.as_deref();
        Level::enter(dynamics, here.time, &here.state, kept)
    }
}

/// What comes after some steps.
enum Next<const N: usize> {
    /// Nothing: the end time is reached.
    Finished,
    /// Nothing more, by the sink's wish, which was shown this state.
    Stopped(State<N>),
    /// A step over `tau` in which a guard is met.
    Crossing { found: Found, tau: f64 },
    /// A step of this size that cannot be made.
    Not(f64),
    /// A step over `tau` of which it cannot be decided whether it meets a guard.
    Unknown { guard: usize, tau: f64 },
    /// Steps with coefficients in another unit: these are lost in the unit 1.
    Lost(OtherUnit),
}

/// The size and the end of a step of about `wanted`, and whether it is the last one before `end`.
#[inline(always)]
pub(crate) fn step_to<S: Masked>(
    is_autonomous: bool,
    start: Time<S>,
    wanted: S,
    end: S,
) -> (S, Time<S>, S::Mask) {
    let remaining = (end - start.value) - start.remainder;
    let last = remaining.at_most(wanted);
    let end = Time::new(end);
    if last.all() {
        return (end.since(start), end, last);
    }
    let (mut tau, mut time) = if is_autonomous {
        (wanted, start.after(wanted))
    } else {
        // the formulas are evaluated at a double
        let time = Time::new(start.value + wanted);
        (time.since(start), time)
    };
    if last.any() {
        tau = last.select(end.since(start), tau);
        time.value = last.select(end.value, time.value);
        time.remainder = last.select(end.remainder, time.remainder);
    }
    (tau, time, last)
}
