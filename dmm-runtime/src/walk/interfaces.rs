//! The interfaces of a region over a step: watched cheaply, looked at closely where one is
//! near, and crossed at the one that comes first.

use crate::error::Error;
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::Observer;
use crate::scheme::Maps;
use crate::system::{Boundary, Flow, Side, System, Vector};
use crate::transition::watch::{Outcome, Watch};
use crate::transition::{Crossing, Located, Locator, guard, rate};
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
pub(super) fn is_near(watches: &impl AsRef<[Watch]>, readings: &impl AsRef<[f64]>) -> bool {
    let mut near = false;
    for (watch, &value) in watches.as_ref().iter().zip(readings.as_ref()) {
        near |= watch.is_near(value);
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
    /// Looks closely at every interface over a step, and moves to the one crossed first.
    #[cold]
    pub(super) fn look<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        watches: &mut Watches<F, N, M>,
        tau: f64,
        increment: &Vector<f64, N>,
    ) -> Result<Option<SegmentEnd>, Error> {
        let mut first: Option<First<N>> = None;
        for (watch, &(interface, side)) in watches.as_mut().iter_mut().zip(sides::<N, M, F>()) {
            let found = self.look_closely(flow, watch, interface, side.sign(), tau, increment)?;
            if let Some(found) = found
                && first
                    .as_ref()
                    .is_none_or(|first| found.located.elapsed < first.located.elapsed)
            {
                first = Some(found);
            }
        }
        match first {
            Some(first) => self.cross(flow, level, &first).map(Some),
            None => Ok(None),
        }
    }

    fn look_closely<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        watch: &Watch,
        interface: usize,
        sign: f64,
        tau: f64,
        increment: &Vector<f64, N>,
    ) -> Result<Option<First<N>>, Error> {
        let mut crossing = Crossing {
            scheme: self.scheme.map(),
            flow,
            interface,
            t0: self.time.value,
            state: &self.state,
            lower: 0.0,
            upper: tau,
            step_size: self.scheme.typical_step(&self.progress),
            sign,
        };
        let located = match watch.examine(&crossing, increment, &mut self.statistics) {
            Some(Outcome::Inside) => return Ok(None),
            Some(Outcome::Grazed) => {
                self.statistics.grazes += 1;
                return Ok(None);
            }
            Some(Outcome::Crossed { lower, upper }) => {
                (crossing.lower, crossing.upper) = (lower, upper);
                self.locator.locate(&crossing, &mut self.statistics)
            }
            None => None,
        };
        let valid =
            located.filter(|located| located.elapsed >= 0.0 && is_finite(&located.increment));
        // no step of the scheme may end on a guard, beyond which ψ may have another value
        let valid = valid.or_else(|| {
            guard::<Sys, N>(interface).map(|_| Located {
                elapsed: 0.0,
                increment: Vector::zeros(),
            })
        });
        let located = valid.ok_or_else(|| Error::LocationFailed {
            t: self.time.value,
            x: self.state.x.iter().copied().collect(),
            step_size: tau,
            interface: Sys::boundary_name(interface),
        })?;
        Ok(Some(First { interface, located }))
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
        Sch::leave(&mut self.progress, time.value);
        if self.tell_point().is_break() {
            return Ok(SegmentEnd::Stopped);
        }
        let rate = rate(flow, interface, time.value, &self.state.x);
        Ok(SegmentEnd::Crossed { interface, rate })
    }
}
