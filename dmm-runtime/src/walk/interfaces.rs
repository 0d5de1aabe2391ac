//! The interfaces of a region over a step of a one-step scheme: watched cheaply, searched for
//! along the step's dense output where one is near, and crossed at the one that comes first.

use crate::error::Error;
use crate::events::cubic::Course;
use crate::events::ends::{Decay, Ends};
use crate::events::{Enclosed, Met, Path, Search, Switching};
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::Observer;
use crate::scheme::{Maps, OneStep, Step};
use crate::series::jet::FIRST;
use crate::statistics::Statistics;
use crate::system::{Boundary, Flow, Side, System, Vector};
use crate::transition::watch::Watch;
use crate::transition::{Crossing, Dip, Located, Locator, guard, rate};
use crate::walk::{SegmentEnd, Walk};

/// A watch for each interface that bounds the region of a flow.
pub(super) type Watches<F, const N: usize, const M: usize> =
    <<F as Flow<f64, N, M>>::Boundary as Boundary<f64, N>>::Each<Watch>;

/// A reading of each interface that bounds the region of a flow.
pub(super) type Readings<F, const N: usize, const M: usize> =
    <<F as Flow<f64, N, M>>::Boundary as Boundary<f64, N>>::Each<f64>;

/// The crossing of a step that comes first.
struct First<const N: usize> {
    interface: usize,
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
pub(super) fn through_ends<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    map: &impl OneStep,
    step: &Step<'_, F, N>,
    increment: &Vector<f64, N>,
) -> [[f64; 4]; N] {
    let tau = step.tau;
    let start = step.flow.vector_field(step.t0, step.x0);
    let end = match map.correction(step, increment) {
        Some(correction) => correction.velocity,
        None => step
            .flow
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

/// A watch for each interface, from (t, x); `fresh` is the one that the solution is on.
pub(super) fn watches<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
    t: f64,
    x: &Vector<f64, N>,
    fresh: Option<usize>,
) -> Watches<F, N, M> {
    let readings = readings::<N, M, F>(flow, t, x);
    <F::Boundary as Boundary<f64, N>>::each(|i| {
        let (interface, _) = sides::<N, M, F>()[i];
        Watch::new(readings.as_ref()[i], fresh == Some(interface))
    })
}

/// g of each interface at (t, x), positive in the region.
#[inline]
pub(super) fn readings<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
    t: f64,
    x: &Vector<f64, N>,
) -> Readings<F, N, M> {
    let sides = sides::<N, M, F>();
    <F::Boundary as Boundary<f64, N>>::each(|i| {
        let (interface, side) = sides[i];
        side.sign() * flow.boundary().switching_function(interface, t, x)
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

/// The interfaces that bound the region of a flow, with its sides.
#[inline]
fn sides<const N: usize, const M: usize, F: Flow<f64, N, M>>() -> &'static [(usize, Side)] {
    <F::Boundary as Boundary<f64, N>>::SIDES
}

impl<Sys, Sch, Loc, Obs, const N: usize> Walk<'_, Sys, Sch, Loc, Obs, N>
where
    Sys: System<N>,
    Sch: Maps,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// Looks at every interface over a step, and moves to the one crossed first.
    pub(super) fn look<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        watches: &mut Watches<F, N, M>,
        dense: &Dense<'_, N>,
    ) -> Result<Option<SegmentEnd>, Error> {
        let enclosed = Enclosed::new(flow.boundary());
        let mut first: Option<First<N>> = None;
        let mut end = dense.tau;
        for (watch, &(interface, side)) in watches.as_ref().iter().zip(sides::<N, M, F>()) {
            let mut search = Search {
                switching: &enclosed,
                interface,
                sign: side.sign(),
                path: &dense.path,
                end: dense.tau / dense.path.unit,
                level: 0.0,
            };
            let unit = dense.path.unit;
            let mut crossing = Crossing {
                scheme: self.scheme.map(),
                flow,
                interface,
                t0: self.time.value,
                state: &self.state,
                lower: 0.0,
                upper: dense.tau,
                step_size: self.scheme.typical_step(&self.progress),
                sign: side.sign(),
            };
            match by_ends::<N, M, F>(&enclosed, &search, dense, watch.fresh) {
                Course::Free => continue,
                Course::Falls { from, .. } => crossing.lower = from * unit,
                Course::Unknown => {
                    let statistics = &mut self.statistics;
                    let dip = match search.single_dip() {
                        Some(noise) if !watch.fresh => crossing.dip(noise, statistics),
                        _ => None,
                    };
                    search.end = end / unit;
                    let met = match dip {
                        Some(Dip::Inside) => continue,
                        Some(Dip::Touch) => {
                            statistics.grazes += 1;
                            continue;
                        }
                        Some(Dip::Crossed { lower, upper }) => Met::Crossing {
                            lower: lower / unit,
                            upper: upper / unit,
                        },
                        None => {
                            let (met, touches) = search.first(watch.fresh);
                            statistics.grazes += u64::from(touches);
                            met
                        }
                    };
                    match met {
                        Met::Nothing => continue,
                        Met::Crossing { lower, upper } => {
                            crossing.lower = lower * unit;
                            crossing.upper = (upper * unit).min(dense.tau);
                        }
                        Met::Undecided(_) => return Err(self.unknown(interface, dense.tau)),
                    }
                }
            }
            let statistics = &mut self.statistics;
            let located = locate_in(crossing, self.locator, dense.tau, watch.fresh, statistics);
            // no step of the scheme may end on a guard, beyond which ψ may have another value
            let located = located.or_else(|| {
                guard::<Sys, N>(interface)?;
                Some(Some(Located {
                    elapsed: 0.0,
                    increment: Vector::zeros(),
                }))
            });
            let failed = || Error::LocationFailed {
                t: self.time.value,
                x: self.state.x.iter().copied().collect(),
                step_size: dense.tau,
                interface: Sys::boundary_name(interface),
            };
            let Some(found) = located.ok_or_else(failed)? else {
                self.statistics.grazes += 1;
                continue;
            };
            if first.is_none() || found.elapsed < end {
                end = found.elapsed;
                first = Some(First {
                    interface,
                    located: found,
                });
            }
        }
        match first {
            Some(first) => self.cross(flow, level, &first).map(Some),
            None => Ok(None),
        }
    }

    /// Moves to the interface.
    #[cold]
    fn cross<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        &First { interface, located }: &First<N>,
    ) -> Result<SegmentEnd, Error> {
        let time = self.time.after(located.elapsed);
        self.outputs(flow, located.elapsed, time)?;
        self.accept(flow, level, &located.increment, located.elapsed, time)?;
        Sch::leave(&mut self.progress);
        if self.tell_point().is_break() {
            return Ok(SegmentEnd::Stopped);
        }
        let rate = rate(flow, interface, time.value, &self.state.x);
        Ok(SegmentEnd::Crossed { interface, rate })
    }
}

/// The crossing that the dense output of a step shows, on the one-step map: none if that comes as
/// close to the interface as the dense output is to it, and returns. Nothing if it is not found.
fn locate_in<Sch: OneStep, Loc: Locator, F: Flow<f64, N, M>, const N: usize, const M: usize>(
    mut crossing: Crossing<'_, Sch, F, N>,
    locator: &Loc,
    tau: f64,
    fresh: bool,
    statistics: &mut Statistics,
) -> Option<Option<Located<N>>> {
    if !crossing.bracket_on_map(tau, fresh, statistics)? {
        return Some(None);
    }
    let located = locator.locate(&crossing, statistics);
    let valid = located.filter(|located| located.elapsed >= 0.0 && is_finite(&located.increment));
    valid.map(Some)
}

/// What the ends of a step tell of an interface whose switching function follows the state.
fn by_ends<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    enclosed: &Enclosed<'_, F::Boundary, N>,
    search: &Search<'_, N>,
    dense: &Dense<'_, N>,
    fresh: bool,
) -> Course {
    if !<F::Boundary as Boundary<f64, N>>::FOLLOWS_STATE {
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
    ends.course(&c, (sign * value, sign * slope), 1.0, fresh)
}
