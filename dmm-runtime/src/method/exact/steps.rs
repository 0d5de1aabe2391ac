//! A segment by the exact flow of an affine field: steps as long as the interfaces allow, and
//! crossings located on the flow itself.
//!
//! Along ẋ = A x + b the fourth derivative of g = c·x + γt + d is c A³ f with f(t) = exp(tA) f(0),
//! and so bounded by a constant row times |f| at an earlier time: that makes what the
//! [`Cubic`] through the ends of a step tells certain. A step is taken where it excludes a crossing, or
//! proves that there is one. Where it does neither, the step is made shorter, down to the lowest
//! size; there the power series of g, which converges to rounding, decides like in
//! a Taylor step.

use super::crossing::Found;
use super::segment::{Entered, Segment};
use super::step_sizes::{FIRST, StepSizes};
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{State, Time, noise};
use crate::contract::{Dynamics, Guards, Vector};
use crate::events::cubic::{self, Bounds, Cubic, Reading};
use crate::events::{Root, Series};
use crate::expansion::jet::Jet;
use crate::expansion::radius::unit_for;
use crate::method::{Ended, Failure, Sink, StepFailure};
use crate::series::{MOST_COEFFICIENTS, Rolled};

/// Steps between looks at the level.
const INTERVAL: u64 = 32;
/// After so many steps of a size the next one is tried.
const PATIENCE: u32 = 4;
/// g and dg/dt of every interface that bounds the region.
type Readings<D, const N: usize, const M: usize> =
    <<D as Dynamics<f64, N, M>>::Guards as Guards<f64, N>>::Each<Reading>;

/// A point of the solution, with what is known there.
struct Place<D: Dynamics<f64, N, M>, const N: usize, const M: usize> {
    state: State<N>,
    /// f
    field: Vector<f64, N>,
    readings: Readings<D, N, M>,
}

impl<D: Dynamics<f64, N, M>, const N: usize, const M: usize> Place<D, N, M> {
    #[inline(always)]
    fn new(dynamics: &D, t: f64, state: State<N>) -> Self {
        let field = dynamics.vector_field(t, &state.x);
        let sides = dynamics.sides();
        let guards = dynamics.guards();
        let readings = guards.each(|i| {
            let (guard, side) = sides[i];
            let value = guards.switching_function(guard, t, &state.x);
            let (by_time, gradient) = guards.switching_gradient(guard, t, &state.x);
            Reading {
                value: side.sign() * value,
                rate: side.sign() * (by_time + gradient.dot(&field)),
            }
        });
        Self {
            state,
            field,
            readings,
        }
    }
}

/// A step to be looked at.
struct Trial<D: Dynamics<f64, N, M>, const N: usize, const M: usize> {
    exponent: usize,
    tau: f64,
    end: Place<D, N, M>,
}

/// What is certain about a step.
#[derive(Clone, Copy)]
enum Course {
    /// There is no crossing.
    Free {
        /// By the look of it none in the next one of twice the size either.
        room: bool,
    },
    /// There is one, and none before.
    Crossing(Found),
    /// Nothing.
    Nothing(Reason),
}

/// Why nothing is certain.
#[derive(Clone, Copy)]
enum Reason {
    /// Whether this interface is met cannot be decided.
    Unknown(usize),
    /// The solution leaves the range of doubles.
    Lost,
}

/// How steps go on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress<const N: usize> {
    /// The exponent of the next step.
    exponent: usize,
    /// Steps with it.
    streak: u32,
    /// f at the start of the step before.
    field_before: Vector<f64, N>,
    /// The exponent of that step; the lowest if there was none.
    exponent_before: usize,
    /// Steps in the segment.
    count: u64,
}

/// What is known at the start of the next step.
struct Start<D: Dynamics<f64, N, M>, const N: usize, const M: usize> {
    at: Place<D, N, M>,
    progress: Progress<N>,
}

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// Steps of the exact flow, until a guard is met or the end time is reached.
    #[inline(always)]
    pub(super) fn run<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        sizes: &mut StepSizes<N>,
        stopped: &mut Option<Progress<N>>,
        end: Time,
    ) -> Result<Ended, Failure> {
        let mut entered = Entered::new(dynamics, self.cursor);
        let at = Place::new(
            dynamics,
            self.cursor.time.value,
            self.cursor.state.by_numbers(),
        );
        let progress = stopped.take().filter(|_| self.cursor.level.is_some());
        let mut start = Start {
            progress: progress.unwrap_or(Progress {
                exponent: FIRST,
                streak: 0,
                field_before: at.field,
                exponent_before: 0,
                count: 0,
            }),
            at,
        };
        loop {
            let remaining = end.since(self.cursor.time);
            if remaining <= 0.0 {
                return Ok(Ended::Finished);
            }
            let Some((trial, course)) = self.next_step(dynamics, sizes, &start, remaining) else {
                start.progress.exponent -= 1;
                start.progress.streak = 0;
                continue;
            };
            let room = match course {
                Course::Free { room } => room,
                Course::Crossing(found) => {
                    let is_long = start.progress.count >= INTERVAL;
                    let entered = is_long.then_some(&mut entered);
                    let end = (trial.tau, &trial.end.state);
                    return self.cross(dynamics, sizes, entered, found, end);
                }
                Course::Nothing(Reason::Lost) => {
                    return Err(StepFailure::NotFinite.over(trial.tau));
                }
                Course::Nothing(Reason::Unknown(guard)) => {
                    return Err(Failure::undecided(guard, trial.tau));
                }
            };
            let time = if trial.tau < remaining {
                self.cursor.time.after(trial.tau)
            } else {
                end
            };
            self.outputs(sizes, time);
            if !is_finite(&trial.end.state.x) {
                return Err(StepFailure::NotFinite.over(trial.tau));
            }
            start.advance(sizes, trial.exponent, room, trial.end);
            start.progress.count += 1;
            if start.progress.count.is_multiple_of(INTERVAL)
                && let Some(state) = self.on_level(dynamics, &mut entered, time, start.at.state)
            {
                start.at = Place::new(dynamics, time.value, state);
            }
            self.cursor.state = start.at.state;
            self.cursor.time = time;
            self.cursor.active.clear();
            self.sink.statistics().steps += 1;
            if self.sink.point(time, &self.cursor.state).is_break() {
                self.cursor.level = Some(entered.level(dynamics).kept());
                *stopped = Some(start.progress);
                return Ok(Ended::Stopped);
            }
        }
    }

    /// The next step, with what happens in it; nothing if it has to be a shorter one.
    #[inline(always)]
    fn next_step<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        sizes: &mut StepSizes<N>,
        start: &Start<D, N, M>,
        remaining: f64,
    ) -> Option<(Trial<D, N, M>, Course)> {
        let exponent = start.progress.exponent;
        let size = sizes.size(exponent);
        let (tau, state) = if size <= remaining {
            (size, sizes.flow(exponent).apply(&self.cursor.state))
        } else if exponent > FIRST {
            return None;
        } else {
            (remaining, sizes.reach(&self.cursor.state, remaining))
        };
        let trial = Trial {
            exponent,
            tau,
            end: Place::new(dynamics, self.cursor.time.value + tau, state),
        };
        let course = match self.by_bounds(dynamics, sizes, start, &trial) {
            Some(course @ Course::Free { .. }) => course,
            Some(crossing) if exponent <= FIRST => crossing,
            _ if exponent > 0 => return None,
            // the step cannot be made
            _ if !is_finite(&trial.end.state.x) => Course::Free { room: false },
            _ => match self.by_series(dynamics, tau) {
                Ok(Some(found)) => Course::Crossing(found),
                Ok(None) => Course::Free { room: false },
                Err(reason) => Course::Nothing(reason),
            },
        };
        Some((trial, course))
    }

    /// What the bounds say about a step; nothing if they are too coarse.
    #[inline(always)]
    fn by_bounds<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        sizes: &StepSizes<N>,
        start: &Start<D, N, M>,
        trial: &Trial<D, N, M>,
    ) -> Option<Course> {
        let mut course = Course::Free { room: true };
        let (tau, x) = (trial.tau, &start.at.state.x);
        let exponent = trial.exponent.max(start.progress.exponent_before);
        let fourth_power = (tau * tau) * (tau * tau) * (1.0 / 24.0);
        for (i, &(guard, _)) in dynamics.sides().iter().enumerate() {
            let fourth = if exponent > FIRST {
                sizes.fourth_later(i, exponent, &start.progress.field_before)
            } else {
                sizes.fourth(i, &start.at.field)
            };
            let size = dynamics
                .guards()
                .switching_size(guard, self.cursor.time.value, x);
            let noise = noise(size + tau * sizes.rate_size(i, x));
            let bounds = Bounds {
                truncation: fourth * fourth_power,
                noise,
                ends: noise,
            };
            let (first, last) = (&start.at.readings, &trial.end.readings);
            let cubic = Cubic::new(first.as_ref()[i], last.as_ref()[i], tau);
            let by_ends = cubic.course(bounds, self.cursor.active.contains(guard));
            course = match (by_ends, course) {
                (cubic::Course::Free, Course::Free { room }) => Course::Free {
                    room: room && cubic.has_room(bounds),
                },
                (cubic::Course::Free, crossing) => crossing,
                (cubic::Course::Falls { from, at }, Course::Free { .. }) => {
                    Course::Crossing(Found {
                        side: i,
                        elapsed: at,
                        precise: false,
                        bracket: (from, tau),
                    })
                }
                _ => return None,
            };
        }
        Some(course)
    }

    /// The first crossing of a step on the lowest size, by the power series of every g.
    #[cold]
    #[inline(never)]
    fn by_series<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        tau: f64,
    ) -> Result<Option<Found>, Reason> {
        let t = self.cursor.time.value;
        let unit = unit_for(tau);
        let mut jet =
            Jet::<D, Rolled, N, M, MOST_COEFFICIENTS>::new(dynamics, MOST_COEFFICIENTS - 1, unit);
        jet.expand(dynamics, t, &self.cursor.state.x);
        jet.expand_switching(dynamics, t);
        let mut horizon = jet.in_units(tau);
        let mut first = None;
        for (i, &(guard, side)) in dynamics.sides().iter().enumerate() {
            let coefficients = jet.switching(guard).map(|c| side.sign() * c);
            let x = &self.cursor.state.x;
            let size = dynamics.guards().switching_size(guard, t, x);
            let is_active = self.cursor.active.contains(guard);
            let Some(series) = Series::new(coefficients, size, is_active, jet.in_units(tau)) else {
                let is_finite = jet.coefficients().iter().flatten().all(|c| c.is_finite());
                return Err(if is_finite {
                    Reason::Unknown(guard)
                } else {
                    Reason::Lost
                });
            };
            let (found, touches) = series.first_root(horizon);
            self.sink.statistics().grazes += u64::from(touches);
            if let Some(Root { place, bracket }) = found {
                horizon = place;
                first = Some(Found {
                    side: i,
                    elapsed: place * unit,
                    precise: true,
                    bracket: (bracket.0 * unit, bracket.1 * unit),
                });
            }
        }
        Ok(first)
    }
}

impl<D: Dynamics<f64, N, M>, const N: usize, const M: usize> Start<D, N, M> {
    /// Moves on to `place`, and chooses the exponent of the next step.
    #[inline(always)]
    fn advance(
        &mut self,
        sizes: &mut StepSizes<N>,
        exponent: usize,
        room: bool,
        place: Place<D, N, M>,
    ) {
        let progress = &mut self.progress;
        progress.field_before = self.at.field;
        progress.exponent_before = exponent;
        self.at = place;
        progress.streak += 1;
        if (room || progress.streak >= PATIENCE) && sizes.reaches(exponent + 1) {
            progress.exponent = exponent + 1;
            progress.streak = 0;
        }
    }
}
