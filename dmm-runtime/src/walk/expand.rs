//! A segment by Taylor steps: the series of the solution at each point, over as much of its
//! radius of convergence as the tolerance allows.

use crate::error::{Error, StepFailure};
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::{Observer, Point};
use crate::scalar::Scalar;
use crate::scheme::Taylor;
use crate::series::jet::Jet;
use crate::series::polynomial::{Roots, first_root, root};
use crate::state::State;
use crate::system::{Boundary, Flow, Side, System};
use crate::time::Time;
use crate::transition::Locator;
use crate::walk::arrive::Found;
use crate::walk::glance::{Glance, Glimpse, NOISE};
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
    pub(crate) fn expand<const P: usize, const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
    ) -> Result<SegmentEnd, Error> {
        let end = Time::new(self.progress.end);
        let mut level = Level::enter(flow, self.time, &self.state);
        let mut jet = Jet::<F, N, M, P>::new(self.scheme.order());
        let mut fresh = self.fresh;
        let mut count = 0u64;
        let fraction = self.progress.fraction;
        let corrects = self.scheme.corrects_level();
        loop {
            let remaining = end.since(self.time);
            if remaining <= 0.0 {
                return Ok(SegmentEnd::Finished);
            }
            jet.expand(flow, self.time.value, &self.state.x);
            let wanted = jet.step(fraction, self.progress.step);
            let (tau, time) = self.step_to::<M, F>(wanted, remaining)?;
            let state = self.state.after(&jet.increment(tau));
            if !sides::<N, M, F>().is_empty() {
                let step = (tau, time, &state);
                if let Some(found) = self.look_ahead::<P, M, F>(flow, &mut jet, step, fresh) {
                    return self.arrive::<P, M, F>(flow, &level, &jet, &found, tau);
                }
            }
            self.outputs_along::<P, M, F>(flow, &level, &jet, tau, time)?;
            count += 1;
            if count.is_multiple_of(RESCALING) {
                level.rescale(flow, self.time.value, &self.state);
            }
            let state = level.reached(flow, time, state, corrects);
            if !is_finite(&state.x) {
                return Err(self.failure(StepFailure::NotFinite, tau));
            }
            self.state = state;
            self.time = time;
            self.progress.step = wanted;
            self.statistics.steps += 1;
            fresh = None;
            if self.tell_point().is_break() {
                return Ok(SegmentEnd::Stopped);
            }
        }
    }

    /// The size and the end of a step of about `wanted`.
    #[inline(always)]
    fn step_to<const M: usize, F: Flow<f64, N, M>>(
        &self,
        wanted: f64,
        remaining: f64,
    ) -> Result<(f64, Time), Error> {
        if wanted >= remaining {
            return Ok((remaining, Time::new(self.progress.end)));
        }
        let time = match F::AUTONOMOUS {
            true => self.time.after(wanted),
            // the formulas are evaluated at a double
            false => Time::new(self.time.value + wanted),
        };
        let tau = match F::AUTONOMOUS {
            true => wanted,
            false => time.since(self.time),
        };
        if tau > 0.0 && time != self.time {
            Ok((tau, time))
        } else {
            Err(self.failure(StepFailure::NotFinite, wanted))
        }
    }

    /// The first crossing of a step that ends at `state`, if there is one.
    #[inline(always)]
    fn look_ahead<const P: usize, const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, N, M, P>,
        (tau, time, state): (f64, Time, &State<N>),
        fresh: Option<usize>,
    ) -> Option<Found> {
        let field = flow.vector_field(time.value, &state.x);
        let glimpse = Glimpse {
            tau,
            decay: self.progress.decay,
        };
        let mut once: Option<Found> = None;
        let mut near = false;
        jet.first_switching(flow, self.time.value, |series| {
            for &(interface, side) in sides::<N, M, F>() {
                let c = &series[interface];
                let boundary = flow.boundary();
                let value = boundary.switching_function(interface, time.value, &state.x);
                let (by_time, gradient) =
                    boundary.switching_gradient(interface, time.value, &state.x);
                let slope = by_time + gradient.dot(&field);
                let fresh = fresh == Some(interface);
                match glimpse.at(c, (value, slope), side.sign(), fresh) {
                    Glance::Out => {}
                    Glance::Once(elapsed) => {
                        near |= once.is_some();
                        once = Some(Found {
                            interface,
                            elapsed,
                            start: Some((c[0], c[1])),
                        });
                    }
                    Glance::Near => near = true,
                }
            }
        });
        match near {
            true => self.first::<P, M, F>(flow, jet, tau, fresh),
            false => once,
        }
    }

    /// The first crossing of a step by all coefficients of every g.
    #[cold]
    #[inline(never)]
    fn first<const P: usize, const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, N, M, P>,
        tau: f64,
        fresh: Option<usize>,
    ) -> Option<Found> {
        jet.expand_switching(flow, self.time.value);
        let mut first: Option<Found> = None;
        for &(interface, side) in sides::<N, M, F>() {
            let sign = side.sign();
            let series = jet.switching(interface).map(|c| sign * c);
            if !series.iter().all(|c| c.is_finite()) {
                return None;
            }
            let size = flow
                .boundary()
                .switching_size(interface, self.time.value, &self.state.x);
            let noise = NOISE * f64::ROUNDING * size;
            let on_it = fresh == Some(interface) || (series[0] <= noise && series[1] > 0.0);
            // on the interface zero is a root, which is divided off
            let (series, noise) = match on_it {
                true => (&series[1..], noise / tau),
                false => (&series[..], noise),
            };
            let horizon = first.as_ref().map_or(tau, |first| first.elapsed);
            let Roots {
                first: found,
                touches,
            } = first_root(series, horizon, noise);
            self.statistics.grazes += u64::from(touches);
            if let Some((lower, upper)) = found {
                first = Some(Found {
                    interface,
                    elapsed: root(series, lower, upper),
                    start: None,
                });
            }
        }
        first
    }

    /// Serves the output times up to `end`, the end of a step over `tau`.
    #[inline(always)]
    pub(super) fn outputs_along<const P: usize, const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        jet: &Jet<F, N, M, P>,
        tau: f64,
        end: Time,
    ) -> Result<(), Error> {
        while let Some(t) = self.observer.next_output()
            && t <= end.value
        {
            let elapsed = Time::new(t).since(self.time).max(0.0).min(tau);
            let corrects = self.scheme.corrects_level();
            let state = self.state.after(&jet.increment(elapsed));
            let state = level.reached(flow, Time::new(t), state, corrects);
            let point = Point {
                t,
                time: Time::new(t),
                x: state.rounded(),
                region: self.region,
            };
            self.observer.output(&point);
        }
        Ok(())
    }
}

/// The interfaces that bound the region of a flow, with its sides.
#[inline(always)]
fn sides<const N: usize, const M: usize, F: Flow<f64, N, M>>() -> &'static [(usize, Side)] {
    <F::Boundary as Boundary<f64, N>>::SIDES
}
