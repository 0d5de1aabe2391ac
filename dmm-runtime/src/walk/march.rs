//! A segment by the exact flow of an affine field: steps as long as the interfaces allow, and
//! crossings located on the flow itself.
//!
//! Along ẋ = A x + b the fourth derivative of g = c·x + γt + d is c A³ f with f(t) = exp(tA) f(0),
//! and so bounded by a constant row times |f| at an earlier time: that makes what the
//! [`Cubic`] through the ends of a step tells certain. A step is taken where it excludes a crossing, or
//! proves that there is one. Where it does neither, the step is made shorter, down to the lowest
//! rung of the ladder; there the power series of g, which converges to rounding, decides like in
//! a Taylor step.

use crate::error::{Error, StepFailure};
use crate::events::cubic::{self, Cubic, Doubt, Reading};
use crate::exact::{FIRST, Ladder};
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::{Observer, Point};
use crate::scalar::Scalar;
use crate::scheme::Best;
use crate::series::jet::Jet;
use crate::series::polynomial::{Roots, first_root, root};
use crate::series::radius::unit_for;
use crate::series::{MOST_COEFFICIENTS, Rolled};
use crate::state::State;
use crate::system::{Boundary, Flow, Side, System, Vector};
use crate::time::Time;
use crate::transition::Locator;
use crate::walk::land::Found;
use crate::walk::{SegmentEnd, Walk};

/// Steps between looks at the level.
const INTERVAL: u64 = 32;
/// After so many steps on a rung the next one is tried.
const PATIENCE: u32 = 4;
/// g this many rounding errors of its terms away from zero is not distinguished from it.
const NOISE: f64 = 16.0;
/// g and dg/dt of every interface that bounds the region.
type Readings<F, const N: usize, const M: usize> =
    <<F as Flow<f64, N, M>>::Boundary as Boundary<f64, N>>::Each<Reading>;

/// A point of the solution, with what is known there.
struct Place<F: Flow<f64, N, M>, const N: usize, const M: usize> {
    state: State<N>,
    /// f
    field: Vector<f64, N>,
    readings: Readings<F, N, M>,
}

impl<F: Flow<f64, N, M>, const N: usize, const M: usize> Place<F, N, M> {
    #[inline(always)]
    fn new(flow: &F, t: f64, state: State<N>) -> Self {
        let field = flow.vector_field(t, &state.x);
        let sides = sides::<N, M, F>();
        let boundary = flow.boundary();
        let readings = <F::Boundary as Boundary<f64, N>>::each(|i| {
            let (interface, side) = sides[i];
            let value = boundary.switching_function(interface, t, &state.x);
            let (by_time, gradient) = boundary.switching_gradient(interface, t, &state.x);
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
struct Stretch<F: Flow<f64, N, M>, const N: usize, const M: usize> {
    rung: usize,
    tau: f64,
    end: Place<F, N, M>,
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
    /// Whether this interface is met cannot be decided.
    Unknown(usize),
    /// The solution leaves the range of doubles.
    Lost,
}

/// The march through a segment.
struct March<F: Flow<f64, N, M>, const N: usize, const M: usize> {
    at: Place<F, N, M>,
    /// The interface that the next step starts on.
    fresh: Option<usize>,
    /// The rung of the next step.
    rung: usize,
    /// Steps on it.
    streak: u32,
    /// f at the start of the step before.
    field_before: Vector<f64, N>,
    /// The rung of that step; the lowest if there was none.
    rung_before: usize,
}

impl<Sys, Loc, Obs, const N: usize> Walk<'_, Sys, Best, Loc, Obs, N>
where
    Sys: System<N>,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// Steps of the exact flow, until the boundary of the region or the end time is reached.
    pub(crate) fn march<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
    ) -> Result<SegmentEnd, Error> {
        let end = Time::new(self.progress.series.end);
        let remaining = end.since(self.time);
        if remaining <= 0.0 {
            return Ok(SegmentEnd::Finished);
        }
        let regions = Sys::REGIONS.iter();
        let region = regions.take_while(|one| **one != self.region).count();
        let mut ladders = std::mem::take(&mut self.progress.ladders);
        let end = match ladders.of(region, || Ladder::new(flow, remaining)) {
            Some(ladder) => self.march_on(flow, ladder, end),
            None => Err(self.failure(StepFailure::NotFinite, remaining)),
        };
        self.progress.ladders = ladders;
        end
    }

    #[inline(always)]
    fn march_on<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        ladder: &mut Ladder<N>,
        end: Time,
    ) -> Result<SegmentEnd, Error> {
        let mut level = Level::enter(flow, self.time, &self.state);
        let at = Place::new(flow, self.time.value, self.state);
        let mut march = March {
            fresh: self.fresh,
            rung: FIRST,
            streak: 0,
            field_before: at.field,
            rung_before: 0,
            at,
        };
        let mut count = 0u64;
        loop {
            let remaining = end.since(self.time);
            if remaining <= 0.0 {
                return Ok(SegmentEnd::Finished);
            }
            let Some((stretch, course)) = self.stretch(flow, ladder, &march, remaining) else {
                march.rung -= 1;
                march.streak = 0;
                continue;
            };
            let room = match course {
                Course::Free { room } => room,
                Course::Crossing(found) => {
                    return self.cross_on_flow(flow, ladder, &mut level, found, stretch.tau);
                }
                Course::Lost => return Err(self.failure(StepFailure::NotFinite, stretch.tau)),
                Course::Unknown(interface) => return Err(self.unknown(interface, stretch.tau)),
            };
            let time = match stretch.tau < remaining {
                true => self.time.after(stretch.tau),
                false => end,
            };
            self.outputs_on_flow(ladder, time);
            if !is_finite(&stretch.end.state.x) {
                return Err(self.failure(StepFailure::NotFinite, stretch.tau));
            }
            march.advance(ladder, stretch.rung, room, stretch.end);
            count += 1;
            if count.is_multiple_of(INTERVAL)
                && let Some(state) = self.held(flow, &mut level, time, march.at.state)
            {
                march.at = Place::new(flow, time.value, state);
            }
            self.state = march.at.state;
            self.time = time;
            self.statistics.steps += 1;
            if self.tell_point().is_break() {
                return Ok(SegmentEnd::Stopped);
            }
        }
    }

    /// The next step, with what happens in it; nothing if it has to be a shorter one.
    #[inline(always)]
    fn stretch<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        ladder: &mut Ladder<N>,
        march: &March<F, N, M>,
        remaining: f64,
    ) -> Option<(Stretch<F, N, M>, Course)> {
        let rung = march.rung;
        let size = ladder.size(rung);
        let (tau, state) = if size <= remaining {
            (size, ladder.flow(rung).apply(&self.state))
        } else if rung > FIRST {
            return None;
        } else {
            (remaining, ladder.reach(&self.state, remaining))
        };
        let stretch = Stretch {
            rung,
            tau,
            end: Place::new(flow, self.time.value + tau, state),
        };
        let course = match self.outlook(flow, ladder, march, &stretch) {
            Some(course @ Course::Free { .. }) => course,
            Some(crossing) if rung <= FIRST => crossing,
            _ if rung > 0 => return None,
            // the step cannot be made
            _ if !is_finite(&stretch.end.state.x) => Course::Free { room: false },
            _ => self.first_on_flow(flow, march.fresh, tau),
        };
        Some((stretch, course))
    }

    /// What the bounds say about a step; nothing if they are too coarse.
    #[inline(always)]
    fn outlook<const M: usize, F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        ladder: &Ladder<N>,
        march: &March<F, N, M>,
        stretch: &Stretch<F, N, M>,
    ) -> Option<Course> {
        let mut course = Course::Free { room: true };
        let (tau, x) = (stretch.tau, &march.at.state.x);
        let rung = stretch.rung.max(march.rung_before);
        let fourth_power = (tau * tau) * (tau * tau) * (1.0 / 24.0);
        for (i, &(interface, _)) in sides::<N, M, F>().iter().enumerate() {
            let fourth = match rung > FIRST {
                true => ladder.fourth_later(i, rung, &march.field_before),
                false => ladder.fourth(i, &march.at.field),
            };
            let size = flow
                .boundary()
                .switching_size(interface, self.time.value, x);
            let noise = NOISE * f64::ROUNDING * (size + tau * ladder.rate_size(i, x));
            let doubt = Doubt {
                truncation: fourth * fourth_power,
                noise,
                ends: noise,
            };
            let (start, end) = (&march.at.readings, &stretch.end.readings);
            let cubic = Cubic::new(start.as_ref()[i], end.as_ref()[i], tau);
            let by_ends = cubic.course(doubt, march.fresh == Some(interface));
            course = match (by_ends, course) {
                (cubic::Course::Free, Course::Free { room }) => Course::Free {
                    room: room && cubic.has_room(doubt),
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

    /// The first crossing of a step on the lowest rung, by the power series of every g.
    #[cold]
    #[inline(never)]
    fn first_on_flow<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        fresh: Option<usize>,
        tau: f64,
    ) -> Course {
        let t = self.time.value;
        let unit = unit_for(tau);
        let mut jet = Jet::<F, Rolled, N, M, MOST_COEFFICIENTS>::new(MOST_COEFFICIENTS - 1, unit);
        jet.expand(flow, t, &self.state.x);
        jet.expand_switching(flow, t);
        let mut horizon = jet.in_units(tau);
        let mut first = Course::Free { room: false };
        for (i, &(interface, side)) in sides::<N, M, F>().iter().enumerate() {
            let series = jet.switching(interface).map(|c| side.sign() * c);
            if !series.iter().all(|c| c.is_finite()) {
                return if jet.coefficients().iter().flatten().all(|c| c.is_finite()) {
                    Course::Unknown(interface)
                } else {
                    Course::Lost
                };
            }
            let size = flow.boundary().switching_size(interface, t, &self.state.x);
            let noise = NOISE * f64::ROUNDING * size;
            let on_it = fresh == Some(interface) || (series[0] <= noise && series[1] > 0.0);
            // on the interface zero is a root, which is divided off
            let (series, noise) = match on_it {
                true => (&series[1..], noise / jet.in_units(tau)),
                false => (&series[..], noise),
            };
            let Roots {
                first: found,
                touches,
            } = first_root(series, horizon, noise);
            self.statistics.grazes += u64::from(touches);
            if let Some((lower, upper)) = found {
                horizon = root(series, lower, upper);
                first = Course::Crossing(Found {
                    side: i,
                    elapsed: horizon * unit,
                    precise: true,
                    bracket: (lower * unit, upper * unit),
                });
            }
        }
        first
    }

    /// The state put back on its level, if it has left it.
    #[inline(always)]
    pub(super) fn held<const M: usize, F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        level: &mut Level<N, M>,
        time: Time,
        state: State<N>,
    ) -> Option<State<N>> {
        let strays = self.scheme.corrects_level() && level.strays(flow, time, &state);
        let put_back = || put_back(flow, level, time, state, &self.state.x);
        strays.then(put_back).flatten()
    }

    /// Serves the output times up to `end`, the end of a step.
    #[inline(always)]
    pub(super) fn outputs_on_flow(&mut self, ladder: &mut Ladder<N>, end: Time) {
        while let Some(t) = self.observer.next_output()
            && t <= end.value
        {
            let time = Time::new(t);
            let elapsed = time.since(self.time).max(0.0);
            let point = Point {
                t,
                time,
                x: ladder.reach(&self.state, elapsed).rounded(),
                region: self.region,
            };
            self.observer.output(&point);
        }
    }
}

impl<F: Flow<f64, N, M>, const N: usize, const M: usize> March<F, N, M> {
    /// Moves on to `place`, and chooses the rung of the next step.
    #[inline(always)]
    fn advance(&mut self, ladder: &mut Ladder<N>, rung: usize, room: bool, place: Place<F, N, M>) {
        self.field_before = self.at.field;
        self.rung_before = rung;
        self.at = place;
        self.fresh = None;
        self.streak += 1;
        if (room || self.streak >= PATIENCE) && ladder.climbs_to(rung + 1) {
            self.rung = rung + 1;
            self.streak = 0;
        }
    }
}

/// The state on its level, if it has left that by the size of ψ's terms at present too; the step
/// started from `before`.
#[cold]
#[inline(never)]
fn put_back<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
    level: &mut Level<N, M>,
    time: Time,
    state: State<N>,
    before: &Vector<f64, N>,
) -> Option<State<N>> {
    level.rescale(flow, time.value, &state);
    let strays = level.strays(flow, time, &state);
    strays.then(|| level.reached(flow, time, state, &(state.x - before), true))
}

/// The interfaces that bound the region of a flow, with its sides.
#[inline(always)]
pub(super) fn sides<const N: usize, const M: usize, F: Flow<f64, N, M>>() -> &'static [(usize, Side)]
{
    <F::Boundary as Boundary<f64, N>>::SIDES
}
