//! A segment by Taylor steps: the series of the solution at each point, over as much of its
//! radius of convergence as the tolerance allows.

use crate::error::{Error, StepFailure};
use crate::events::cubic::Course;
use crate::events::ends::Ends;
use crate::events::switching::NOISE;
use crate::events::{Enclosed, Met, Path, Search};
use crate::level::Level;
use crate::linear::{dot, is_finite};
use crate::observer::{Observer, Point};
use crate::scalar::Scalar;
use crate::scheme::Taylor;
use crate::series::jet::Jet;
use crate::series::polynomial::{Roots, dips, first_root, root};
use crate::series::radius::OtherUnit;
use crate::series::{MOST_COEFFICIENTS, Rolled, Unroll};
use crate::state::State;
use crate::system::{Boundary, Flow, Side, System};
use crate::time::Time;
use crate::transition::Locator;
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

    /// The first crossing of a step that ends at `state`, if there is one.
    #[inline(always)]
    fn look_ahead<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, U, N, M, P>,
        here: &Here<N>,
        (tau, time, state): (f64, Time, &State<N>),
        (fresh, part): (Option<usize>, Part),
    ) -> Ahead {
        if !<F::Boundary as Boundary<f64, N>>::FOLLOWS_STATE {
            return self.first_enclosed::<P, M, F, U>(flow, jet, here, tau, (fresh, part));
        }
        let field = flow.vector_field(time.value, &state.x);
        let ends = Ends {
            tau: jet.in_units(tau),
            decay: self.progress.decay,
        };
        let mut once: Option<Found> = None;
        let mut near = false;
        let series = jet.first_switching(flow, here.time.value);
        for &(interface, side) in sides::<N, M, F>() {
            let c = &series.as_ref()[interface];
            let boundary = flow.boundary();
            let value = boundary.switching_function(interface, time.value, &state.x);
            let (by_time, gradient) = boundary.switching_gradient(interface, time.value, &state.x);
            let slope = (by_time + dot(&gradient, &field)) * jet.unit();
            let fresh = fresh == Some(interface);
            match ends.course(c, (value, slope), side.sign(), fresh) {
                Course::Free => {}
                Course::Falls { from, at } => {
                    near |= once.is_some();
                    once = Some(Found {
                        interface,
                        sign: side.sign(),
                        elapsed: at * jet.unit(),
                        bracket: (from * jet.unit(), tau),
                        start: Some((c[0], jet.in_units(c[1]))),
                    });
                }
                Course::Unknown => near = true,
            }
        }
        match (near, once) {
            (true, _) => match part.half() {
                Some(half) => Ahead::Undecided(half),
                None if const { <F::Boundary as Boundary<f64, N>>::AFFINE } => {
                    self.first::<P, M, F, U>(flow, jet, here, tau, (fresh, part))
                }
                // between roots that are close g is smaller than the rounding errors of its series
                None => self.first_enclosed::<P, M, F, U>(flow, jet, here, tau, (fresh, part)),
            },
            (false, Some(found)) => Ahead::Crossing(found),
            (false, None) => Ahead::Free,
        }
    }

    /// The first crossing of a step by all coefficients of every g, which is affine. What comes as
    /// close to an interface as the error of the step, and returns, is left undecided.
    #[cold]
    #[inline(never)]
    fn first<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, U, N, M, P>,
        here: &Here<N>,
        tau: f64,
        (fresh, part): (Option<usize>, Part),
    ) -> Ahead {
        let band = if part.is_finest {
            0.0
        } else {
            self.scheme.undecided()
        };
        let (t, x) = (here.time.value, &here.state.x);
        jet.expand_switching(flow, t);
        // in units, like the coefficients
        let tau = jet.in_units(tau);
        let mut first: Option<Found> = None;
        let mut horizon = tau;
        for &(interface, side) in sides::<N, M, F>() {
            let sign = side.sign();
            let series = jet.switching(interface).map(|c| sign * c);
            if !series.iter().all(|c| c.is_finite()) {
                return Ahead::Unknown(interface);
            }
            let size = flow.boundary().switching_size(interface, t, x);
            let noise = NOISE * f64::ROUNDING * size;
            let on_it = fresh == Some(interface) || (series[0] <= noise && series[1] > 0.0);
            // on the interface zero is a root, which is divided off
            let (series, part) = match on_it {
                true => (&series[1..], 1.0 / tau),
                false => (&series[..], 1.0),
            };
            let (noise, band) = (noise * part, band * size * part);
            if band > noise && dips(series, horizon, band) {
                return Ahead::Undecided(Part {
                    share: self.progress.finest,
                    is_finest: true,
                });
            }
            let Roots {
                first: found,
                touches,
            } = first_root(series, horizon, noise);
            self.statistics.grazes += u64::from(touches);
            if let Some((lower, upper)) = found {
                horizon = root(series, lower, upper);
                first = Some(Found {
                    interface,
                    sign,
                    elapsed: horizon * jet.unit(),
                    bracket: (lower * jet.unit(), upper * jet.unit()),
                    start: None,
                });
            }
        }
        first.map_or(Ahead::Free, Ahead::Crossing)
    }

    /// The first crossing of a step by enclosures of every g along the solution's polynomial: where
    /// its series may converge more slowly than that of the state, or the ends of the step do not
    /// tell enough.
    #[cold]
    #[inline(never)]
    fn first_enclosed<const P: usize, const M: usize, F: Flow<f64, N, M>, U: Unroll>(
        &mut self,
        flow: &F,
        jet: &Jet<F, U, N, M, P>,
        here: &Here<N>,
        tau: f64,
        (fresh, part): (Option<usize>, Part),
    ) -> Ahead {
        let path = Path {
            t0: here.time.value,
            unit: jet.unit(),
            coefficients: std::array::from_fn(|i| &jet.coefficients()[i][..]),
        };
        let enclosed = Enclosed::new(flow.boundary());
        let mut first: Option<Found> = None;
        let mut end = jet.in_units(tau);
        for &(interface, side) in sides::<N, M, F>() {
            let search = Search {
                switching: &enclosed,
                interface,
                sign: side.sign(),
                path: &path,
                end,
                level: 0.0,
            };
            let fresh = fresh == Some(interface);
            let (met, touches) = if part.is_finest {
                search.first(fresh)
            } else {
                let boundary = flow.boundary();
                let size =
                    |s: f64| boundary.switching_size(interface, path.time(s), &path.state(s));
                let size = size(0.0).max(size(end));
                search.first_clear(fresh, self.scheme.undecided() * size)
            };
            match met {
                Met::Nothing => {}
                Met::Crossing { lower, upper } => {
                    end = search.root(lower, upper);
                    first = Some(Found {
                        interface,
                        sign: side.sign(),
                        elapsed: end * jet.unit(),
                        bracket: (lower * jet.unit(), upper * jet.unit()),
                        start: None,
                    });
                }
                Met::Undecided(_) if part.is_finest => return Ahead::Unknown(interface),
                Met::Undecided(_) => {
                    return Ahead::Undecided(Part {
                        share: self.progress.finest,
                        is_finest: true,
                    });
                }
            }
            self.statistics.grazes += u64::from(touches);
        }
        first.map_or(Ahead::Free, Ahead::Crossing)
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

/// What a step meets.
enum Ahead {
    /// No interface.
    Free,
    /// An interface.
    Crossing(Found),
    /// It comes so close to an interface that a shorter step has to decide.
    Undecided(Part),
    /// Whether this interface is met cannot be decided.
    Unknown(usize),
}

/// A part of the step that the tolerance allows.
#[derive(Clone, Copy, Debug)]
struct Part {
    share: f64,
    /// Whether the error of such a step is below rounding.
    is_finest: bool,
}

impl Part {
    const WHOLE: Self = Self {
        share: 1.0,
        is_finest: false,
    };

    /// Half of it. The ends of a shorter step tell more, at less than the cost of all coefficients
    /// of g, until that has been tried in vain.
    #[inline(always)]
    fn half(self) -> Option<Self> {
        const SMALLEST: f64 = 0.25;
        let half = Self {
            share: 0.5 * self.share,
            ..self
        };
        (half.share >= SMALLEST && !self.is_finest).then_some(half)
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

/// The interfaces that bound the region of a flow, with its sides.
#[inline(always)]
fn sides<const N: usize, const M: usize, F: Flow<f64, N, M>>() -> &'static [(usize, Side)] {
    <F::Boundary as Boundary<f64, N>>::SIDES
}
