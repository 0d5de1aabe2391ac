//! A segment by Taylor steps: the series of the solution at each point, over as much of its
//! radius of convergence as the tolerance allows.

use crate::error::{Error, StepFailure};
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::{Observer, Point};
use crate::scheme::Taylor;
use crate::series::jet::Jet;
use crate::series::radius::OtherUnit;
use crate::series::{MOST_COEFFICIENTS, Rolled, Unroll};
use crate::state::State;
use crate::system::{Flow, System};
use crate::time::Time;
use crate::transition::Locator;
use crate::walk::ahead::{Ahead, Part, sides};
use crate::walk::arrive::Found;
use crate::walk::{SegmentEnd, Walk};

/// Steps between adaptions of the level's correction to the size of the state.
const RESCALING: u64 = 256;

impl<Sys, Loc, Obs, const N: usize> Walk<'_, Sys, Taylor, Loc, Obs, N>
where
    Sys: System<N>,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// Steps with P coefficients, until the boundary of the region or the end time is reached.
    pub(crate) fn expand<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
    ) -> Result<SegmentEnd, Error> {
        let mut here = Here::of(self);
        let mut jet = Jet::<F, U, N, M, P>::new(self.scheme.order(), self.progress.unit);
        jet.expand(flow, here.time.value, &here.state.x);
        // after the chain of recurrences, which leaves the processor time for it
        let level = Level::enter(flow, here.time, &here.state);
        let end = self.steps::<P, M, F, U>(flow, level, &mut jet, &mut here);
        self.time = here.time;
        self.state = here.state;
        self.progress.step = here.before;
        self.progress.unit = jet.unit();
        self.statistics.steps += here.steps;
        match end {
            Ended::At(end) => Ok(end),
            Ended::Before { found, tau, level } => {
                self.arrive::<P, M, F, U>(flow, &level, &jet, &found, tau)
            }
            Ended::Not(tau) => Err(self.failure(StepFailure::NotFinite, tau)),
            Ended::Unknown { interface, tau } => Err(self.unknown(interface, tau)),
            Ended::Lost(OtherUnit(unit)) => {
                self.progress.unit = unit;
                self.fresh = self.fresh.filter(|_| here.steps == 0);
                self.expand_in_units(flow)
            }
        }
    }

    /// The same in any unit of time, not by straight-line code.
    #[cold]
    pub(crate) fn expand_in_units<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
    ) -> Result<SegmentEnd, Error> {
        self.expand::<MOST_COEFFICIENTS, M, F, Rolled>(flow)
    }

    /// The steps, from local variables to local variables; `jet` is that of the start.
    #[inline(always)]
    fn steps<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        mut level: Level<N, M>,
        jet: &mut Jet<F, U, N, M, P>,
        here: &mut Here<N>,
    ) -> Ended<N, M> {
        let end = self.progress.end;
        let fraction = self.progress.fraction;
        let corrects = self.scheme.corrects_level();
        let mut fresh = self.fresh;
        loop {
            let remaining = (end - here.time.value) - here.time.remainder;
            if remaining <= 0.0 {
                return Ended::At(SegmentEnd::Finished);
            }
            let wanted = match jet.step(flow, here.time.value, fraction, here.before) {
                Ok(wanted) => wanted,
                Err(other) => return Ended::Lost(other),
            };
            let mut part = Part::WHOLE;
            let (tau, time, mut state) = loop {
                let size = part.share * wanted;
                let Some((tau, time)) = step_to::<N, M, F>(here.time, size, (remaining, end))
                else {
                    return Ended::Not(size);
                };
                let state = here.state.after(&jet.increment(tau));
                if sides::<N, M, F>().is_empty() {
                    break (tau, time, state);
                }
                let end = (tau, time, &state);
                match self.look_ahead::<P, M, F, U>(flow, jet, here, end, (fresh, part)) {
                    Ahead::Free => break (tau, time, state),
                    Ahead::Crossing(found) => return Ended::Before { found, tau, level },
                    Ahead::Undecided(shorter) => part = shorter,
                    Ahead::Unknown(interface) => return Ended::Unknown { interface, tau },
                }
            };
            if self.observer.next_output().is_some() {
                self.outputs_along::<P, M, F, U>(flow, &level, jet, here, (tau, time));
            }
            state = level.reached(flow, time, state, &(state.x - here.state.x), corrects);
            if !is_finite(&state.x) {
                return Ended::Not(tau);
            }
            here.state = state;
            here.time = time;
            here.before = wanted;
            here.steps += 1;
            fresh = None;
            if here.steps.is_multiple_of(RESCALING) {
                level.rescale(flow, here.time.value, &here.state);
            }
            if self.observer.point(&here.point(self.region)).is_break() {
                return Ended::At(SegmentEnd::Stopped);
            }
            jet.expand(flow, here.time.value, &here.state.x);
        }
    }

    /// Serves the output times of a step over `tau` that ends at `end`.
    pub(super) fn outputs_along<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        jet: &Jet<F, U, N, M, P>,
        here: &Here<N>,
        (tau, end): (f64, Time),
    ) {
        let corrects = self.scheme.corrects_level();
        while let Some(t) = self.observer.next_output()
            && t <= end.value
        {
            let time = Time::new(t);
            let elapsed = time.since(here.time).max(0.0).min(tau);
            let state = here.state.after(&jet.increment(elapsed));
            let state = level.reached(flow, time, state, &(state.x - here.state.x), corrects);
            let point = Point {
                t,
                time,
                x: state.rounded(),
                region: self.region,
            };
            self.observer.output(&point);
        }
    }
}

/// Where the steps are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Here<const N: usize> {
    pub(super) time: Time,
    pub(super) state: State<N>,
    /// The size of the step before, or 0.
    before: f64,
    /// How many there were.
    steps: u64,
}

impl<const N: usize> Here<N> {
    /// Where a walk is.
    #[inline(always)]
    pub(super) fn of<Sys: System<N>, Loc, Obs>(walk: &Walk<'_, Sys, Taylor, Loc, Obs, N>) -> Self {
        Self {
            time: walk.time,
            state: walk.state,
            before: walk.progress.step,
            steps: 0,
        }
    }

    #[inline(always)]
    fn point<R>(&self, region: R) -> Point<R, N> {
        Point {
            t: self.time.value,
            time: self.time,
            x: self.state.rounded(),
            region,
        }
    }
}

/// How the steps ended.
enum Ended<const N: usize, const M: usize> {
    At(SegmentEnd),
    /// With one over `tau` to be made, in which an interface is met.
    Before {
        found: Found,
        tau: f64,
        level: Level<N, M>,
    },
    /// With one of this size that cannot be made.
    Not(f64),
    /// With one over `tau` of which it cannot be decided whether it meets an interface.
    Unknown {
        interface: usize,
        tau: f64,
    },
    /// With coefficients that are lost in the unit 1.
    Lost(OtherUnit),
}

/// The size and the end of a step of about `wanted`; nothing if it is none.
#[inline(always)]
fn step_to<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    start: Time,
    wanted: f64,
    (remaining, end): (f64, f64),
) -> Option<(f64, Time)> {
    if wanted >= remaining {
        let end = Time::new(end);
        return Some((end.since(start), end));
    }
    let (tau, time) = match F::AUTONOMOUS {
        true => (wanted, start.after(wanted)),
        // the formulas are evaluated at a double
        false => {
            let time = Time::new(start.value + wanted);
            (time.since(start), time)
        }
    };
    (tau > 0.0 && time != start).then_some((tau, time))
}
