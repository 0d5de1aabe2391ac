//! The guards of a mode over a step of a one-step method: watched cheaply, searched for along the
//! step's dense output where one is near, and located at the one that comes first.

use super::crossing::{Crossing, Located, Locator};
use super::dip::Dip;
use super::map::{OneStep, Step};
use super::segment::Segment;
use super::watch::Watch;
use crate::arithmetic::linear::is_finite;
use crate::contract::{Dynamics, Guards, Vector};
use crate::events::cubic::Course;
use crate::events::ends::{Decay, Ends};
use crate::events::{Enclosed, Met, Path, Search, Switching};
use crate::expansion::jet::FIRST;
use crate::level::{GuardPoint, Level};
use crate::method::{Active, Ended, Failure, Sink, Statistics};

/// A watch for each guard of a mode.
pub(super) type Watches<F, const N: usize, const M: usize> =
    <<F as Dynamics<f64, N, M>>::Guards as Guards<f64, N>>::Each<Watch>;

/// A reading of each guard of a mode.
pub(super) type Readings<F, const N: usize, const M: usize> =
    <<F as Dynamics<f64, N, M>>::Guards as Guards<f64, N>>::Each<f64>;

/// A guard that is met in a step, and where.
struct Crossed<const N: usize> {
    guard: usize,
    located: Located<N>,
}

/// A step that has been made, with its dense output.
pub(super) struct Dense<'a, const N: usize> {
    pub(super) path: Path<'a, N>,
    /// τ
    pub(super) tau: f64,
    /// How the coefficients of the path fall off.
    pub(super) decay: Decay,
}

/// The cubic through both ends of a step, with the field at its start and the velocity ∂d/∂τ of
/// the one-step map at its end: coefficients of powers of the time.
pub(super) fn through_ends<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    map: &impl OneStep,
    step: &Step<'_, F, N>,
    increment: &Vector<f64, N>,
) -> [[f64; 4]; N] {
    let tau = step.tau;
    let start = step.dynamics.vector_field(step.t0, step.x0);
    let end = match map.correction(step, increment) {
        Some(correction) => correction.velocity,
        None => step
            .dynamics
            .vector_field(step.t0 + tau, &(step.x0 + increment)),
    };
    let inverse = 1.0 / tau;
    std::array::from_fn(|i| {
        let (chord, v0, v1) = (increment[i] * inverse, start[i], end[i]);
        let square = (3.0 * chord - 2.0 * v0 - v1) * inverse;
        let cube = (v0 + v1 - 2.0 * chord) * (inverse * inverse);
        [step.x0[i], v0, square, cube]
    })
}

/// A watch for each interface, from (t, x); `active` are those that the solution is on.
pub(super) fn watches<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    t: f64,
    x: &Vector<f64, N>,
    active: &Active,
) -> Watches<F, N, M> {
    let readings = readings::<N, M, F>(dynamics, t, x);
    dynamics.guards().each(|i| {
        let (guard, _) = dynamics.sides()[i];
        Watch::new(readings.as_ref()[i], active.contains(guard))
    })
}

/// The guards that a step may start on, as far as the watches know.
pub(super) fn active<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    watches: &Watches<F, N, M>,
) -> Active {
    let watches = watches.as_ref().iter().zip(dynamics.sides());
    let mut active = Active::default();
    for (_, &(guard, _)) in watches.filter(|(watch, _)| watch.is_active) {
        active.insert(guard);
    }
    active
}

/// g of each interface at (t, x), positive in the region.
#[inline]
pub(super) fn readings<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    t: f64,
    x: &Vector<f64, N>,
) -> Readings<F, N, M> {
    dynamics.guards().each(|i| {
        let (guard, side) = dynamics.sides()[i];
        side.sign() * dynamics.guards().switching_function(guard, t, x)
    })
}

/// Whether a step that ends with these readings needs a closer look at an interface.
#[inline]
pub(super) fn is_near(
    watches: &impl AsRef<[Watch]>,
    readings: &impl AsRef<[f64]>,
    reach: f64,
) -> bool {
    let mut near = false;
    for (watch, &value) in watches.as_ref().iter().zip(readings.as_ref()) {
        near |= watch.is_near(value, reach);
    }
    near
}

/// Moves the watches on to a step that starts with these readings, after one that ended `near` an
/// interface or not.
#[inline]
pub(super) fn advance(watches: &mut impl AsMut<[Watch]>, readings: &impl AsRef<[f64]>, near: bool) {
    for (watch, &value) in watches.as_mut().iter_mut().zip(readings.as_ref()) {
        watch.advance(value, near);
    }
}

impl<Map: OneStep, Loc: Locator, S: Sink<N>, const N: usize> Segment<'_, Map, Loc, S, N> {
    /// Looks at every guard over a step, and moves to the one met first.
    #[cold]
    pub(super) fn look<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        watches: &Watches<D, N, M>,
        dense: &Dense<'_, N>,
        step_size: f64,
    ) -> Result<Option<Ended>, Failure> {
        if watches.as_ref().is_empty() {
            return Ok(None);
        }
        match self.first_crossing(dynamics, watches, dense, step_size)? {
            Some(first) => self.cross(dynamics, level, &first).map(Some),
            None => Ok(None),
        }
    }

    /// Moves to a guard.
    fn cross<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        &Crossed { guard, located }: &Crossed<N>,
    ) -> Result<Ended, Failure> {
        let time = self.cursor.time.after(located.elapsed);
        self.outputs(dynamics, located.elapsed, time)?;
        let corrects_level = self.corrects_level;
        if !self.map.conserves()
            && corrects_level
            && !dynamics.guards().is_condition(guard)
            && let Some(rate) = self.settle(dynamics, level, guard, &located)
        {
            return Ok(Ended::AtGuard { guard, rate });
        }
        // where there is no such point, g = 0 is what counts
        self.corrects_level &= self.map.conserves();
        let accepted = self.accept(dynamics, level, &located.increment, located.elapsed, time);
        self.corrects_level = corrects_level;
        accepted?;
        let rate = dynamics.rate(guard, time.value, &self.cursor.state.x);
        Ok(Ended::AtGuard { guard, rate })
    }

    /// Moves to a guard by a map that does not conserve: to the point close to the located one at which
    /// g = 0 and ψ has its level; gives dg/dt there.
    #[cold]
    fn settle<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        guard: usize,
        located: &Located<N>,
    ) -> Option<f64> {
        let time = self.cursor.time.after(located.elapsed);
        let state = self.cursor.state.after(&located.increment).normalised();
        let near = (time, &state);
        let how = (true, true);
        let (there, settled) =
            GuardPoint::settled(near, dynamics, level, guard, &located.increment, how);
        let is_later = there.time.since(self.cursor.time) >= 0.0;
        if !(settled && is_later && is_finite(&there.state.x)) {
            return None;
        }
        (self.cursor.time, self.cursor.state) = (there.time, there.state);
        self.sink.statistics().steps += 1;
        Some(there.rate)
    }

    /// The first crossing of a step with a dense output, if there is one.
    fn first_crossing<const M: usize, F: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &F,
        watches: &Watches<F, N, M>,
        dense: &Dense<'_, N>,
        step_size: f64,
    ) -> Result<Option<Crossed<N>>, Failure> {
        let enclosed = Enclosed::new(dynamics.guards());
        let mut first: Option<Crossed<N>> = None;
        let mut end = dense.tau;
        for (watch, &(guard, side)) in watches.as_ref().iter().zip(dynamics.sides()) {
            let crossing = Crossing {
                map: self.map,
                dynamics,
                guard,
                t0: self.cursor.time.value,
                state: &self.cursor.state,
                lower: 0.0,
                upper: dense.tau,
                step_size,
                sign: side.sign(),
            };
            let statistics = self.sink.statistics();
            let bracketed = bracket(&enclosed, crossing, dense, end, watch.is_active, statistics)?;
            let Some(crossing) = bracketed else {
                continue;
            };
            match locate_in(
                crossing,
                self.locator,
                dense.tau,
                watch.is_active,
                statistics,
            )? {
                None => statistics.grazes += 1,
                Some(located) if first.is_some() && located.elapsed >= end => {}
                Some(located) => {
                    end = located.elapsed;
                    first = Some(Crossed { guard, located });
                }
            }
        }
        Ok(first)
    }
}

/// The crossing with a bracket of the first root of its switching function on the dense output of a
/// step; none if there is none up to `end`.
fn bracket<'a, Map, F, const N: usize, const M: usize>(
    enclosed: &Enclosed<'_, F::Guards, N>,
    mut crossing: Crossing<'a, Map, F, N>,
    dense: &Dense<'_, N>,
    end: f64,
    is_active: bool,
    statistics: &mut Statistics,
) -> Result<Option<Crossing<'a, Map, F, N>>, Failure>
where
    Map: OneStep,
    F: Dynamics<f64, N, M>,
{
    let unit = dense.path.unit;
    let mut search = Search {
        switching: enclosed,
        interface: crossing.guard,
        sign: crossing.sign,
        path: &dense.path,
        end: dense.tau / unit,
        level: 0.0,
    };
    match by_ends(crossing.dynamics, enclosed, &search, dense, is_active) {
        Course::Free => return Ok(None),
        Course::Falls { from, .. } => {
            crossing.lower = from * unit;
            return Ok(Some(crossing));
        }
        Course::Unknown => {}
    }
    let dip = match search.single_dip() {
        Some(noise) if !is_active => crossing.dip(noise, statistics),
        _ => None,
    };
    match dip {
        Some(Dip::Inside) => return Ok(None),
        Some(Dip::Touch) => {
            statistics.grazes += 1;
            return Ok(None);
        }
        Some(Dip::Crossed { lower, upper }) => {
            (crossing.lower, crossing.upper) = (lower, upper);
            return Ok(Some(crossing));
        }
        None => {}
    }
    search.end = end / unit;
    let (met, touches) = search.first(is_active);
    statistics.grazes += u64::from(touches);
    match met {
        Met::Nothing => Ok(None),
        Met::Crossing { lower, upper } => {
            crossing.lower = lower * unit;
            crossing.upper = (upper * unit).min(dense.tau);
            Ok(Some(crossing))
        }
        Met::Undecided(_) => Err(Failure::undecided(crossing.guard, dense.tau)),
    }
}

/// The crossing that the dense output of a step shows, on the one-step map: none if that comes as
/// close to the guard as the dense output is to it, and returns.
fn locate_in<Map: OneStep, Loc: Locator, F: Dynamics<f64, N, M>, const N: usize, const M: usize>(
    mut crossing: Crossing<'_, Map, F, N>,
    locator: &Loc,
    tau: f64,
    is_active: bool,
    statistics: &mut Statistics,
) -> Result<Option<Located<N>>, Failure> {
    let located = match crossing.bracket_on_map(tau, is_active, statistics) {
        Some(false) => return Ok(None),
        Some(true) => locator.locate(&crossing, statistics),
        None => None,
    };
    let located = located.filter(|located| located.elapsed >= 0.0 && is_finite(&located.increment));
    match located {
        Some(located) => Ok(Some(located)),
        // no step may end on the condition of a proof, beyond which ψ may have another value
        None if crossing.dynamics.guards().is_condition(crossing.guard) => Ok(Some(Located {
            elapsed: 0.0,
            increment: Vector::zeros(),
        })),
        None => Err(Failure::not_located(crossing.guard, tau)),
    }
}

/// What the ends of a step tell of an interface whose switching function follows the state.
fn by_ends<const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
    dynamics: &F,
    enclosed: &Enclosed<'_, F::Guards, N>,
    search: &Search<'_, N>,
    dense: &Dense<'_, N>,
    is_active: bool,
) -> Course {
    if !dynamics.guards().follows_state() {
        return Course::Unknown;
    }
    let &Search {
        interface,
        sign,
        path,
        end,
        ..
    } = search;
    let c: [f64; FIRST] = enclosed.first(interface, path).map(|c| sign * c);
    let (value, slope) = enclosed.point(interface, path, end);
    let ends = Ends {
        tau: end,
        decay: dense.decay,
    };
    ends.course(&c, (sign * value, sign * slope), 1.0, is_active)
}
