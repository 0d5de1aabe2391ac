//! A segment by Taylor steps: the series of the solution at each point, over as much of its
//! radius of convergence as the tolerance allows.

use crate::error::{Error, StepFailure};
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::{Observer, Point};
use crate::scalar::Scalar;
use crate::scheme::Taylor;
use crate::series::jet::{Jet, LOOK};
use crate::series::polynomial::{Roots, first_root, root};
use crate::state::State;
use crate::system::{Boundary, Flow, Side, System};
use crate::time::Time;
use crate::transition::{Locator, rate};
use crate::walk::{SegmentEnd, Walk};

/// Steps between adaptions of the level's correction to the size of the state.
const RESCALING: u64 = 256;
/// g this many rounding errors of its terms away from zero is not distinguished from it.
const NOISE: f64 = 16.0;
/// The terms of g that are only estimated count so many times.
const MARGIN: f64 = 3.0;
/// Corrections of a crossing.
const MOST_CORRECTIONS: u32 = 8;
/// A correction of the time smaller than this part of the step is made along the field.
const SMALL: f64 = 1e-8;

/// A crossing in a step.
struct Found {
    interface: usize,
    elapsed: f64,
}

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
            let increment = jet.increment(tau);
            if !sides::<N, M, F>().is_empty() {
                jet.expand_switching(flow, self.time.value);
                if let Some(found) = self.look_ahead::<P, M, F>(flow, &mut jet, tau, fresh) {
                    return self.cross_at::<P, M, F>(flow, &level, &jet, &found, tau);
                }
            }
            self.outputs_along::<P, M, F>(flow, &level, &jet, tau, time)?;
            count += 1;
            if count.is_multiple_of(RESCALING) {
                level.rescale(flow, self.time.value, &self.state);
            }
            let state = level.reached(flow, time, self.state.after(&increment), corrects);
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

    /// The first crossing of a step, if there is one.
    #[inline(always)]
    fn look_ahead<const P: usize, const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, N, M, P>,
        tau: f64,
        fresh: Option<usize>,
    ) -> Option<Found> {
        let mut once: Option<Found> = None;
        let mut near = false;
        for &(interface, side) in sides::<N, M, F>() {
            let c = jet.first_switching(interface);
            match glance(
                &c,
                side.sign(),
                tau,
                self.progress.fraction,
                fresh == Some(interface),
            ) {
                Glance::Out => {}
                Glance::Once(elapsed) => {
                    near |= once.is_some();
                    once = Some(Found { interface, elapsed });
                }
                Glance::Near => near = true,
            }
        }
        match near {
            true => self.first::<P, M, F>(flow, jet, tau, fresh),
            false => once,
        }
    }

    /// The first crossing of a step by all coefficients of every g.
    #[cold]
    fn first<const P: usize, const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        jet: &mut Jet<F, N, M, P>,
        tau: f64,
        fresh: Option<usize>,
    ) -> Option<Found> {
        jet.finish_switching(flow, self.time.value);
        let mut first: Option<Found> = None;
        for &(interface, side) in sides::<N, M, F>() {
            let sign = side.sign();
            let series = jet.switching(interface).map(|c| sign * c);
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
                });
            }
        }
        first
    }

    /// Moves to the interface: t̂* and x̂* such that g = 0 and ψ keeps its level, both to
    /// rounding.
    #[cold]
    fn cross_at<const P: usize, const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        jet: &Jet<F, N, M, P>,
        &Found { interface, elapsed }: &Found,
        tau: f64,
    ) -> Result<SegmentEnd, Error> {
        let corrects = self.scheme.corrects_level();
        let mut elapsed = elapsed;
        let mut time = self.time.after(elapsed);
        let mut state = level.reached(
            flow,
            time,
            self.state.after(&jet.increment(elapsed)),
            corrects,
        );
        let mut located = false;
        for _ in 0..MOST_CORRECTIONS {
            let delta = self.towards::<M, F>(flow, interface, time, &state);
            if !delta.is_finite() {
                break;
            }
            if delta.abs() > SMALL * tau {
                elapsed = (elapsed + delta).clamp(0.0, tau);
                time = self.time.after(elapsed);
                state = level.reached(
                    flow,
                    time,
                    self.state.after(&jet.increment(elapsed)),
                    corrects,
                );
                continue;
            }
            let field = flow.vector_field(time.value, &state.x);
            state.remainder += field * delta;
            time = time.after(delta);
            state = level.reached(flow, time, state, corrects);
            if located {
                break;
            }
            located = true;
        }
        if !located || !is_finite(&state.x) {
            return Err(Error::LocationFailed {
                t: self.time.value,
                x: self.state.x.iter().copied().collect(),
                step_size: tau,
                interface: Sys::INTERFACES[interface],
            });
        }
        self.outputs_along::<P, M, F>(flow, level, jet, elapsed, time)?;
        self.state = state;
        self.time = time;
        self.statistics.steps += 1;
        self.progress.step = tau;
        self.progress.pass(time.value, tau);
        if self.tell_point().is_break() {
            return Ok(SegmentEnd::Stopped);
        }
        let rate = rate(flow, interface, time.value, &self.state.x);
        Ok(SegmentEnd::Crossed { interface, rate })
    }

    /// −g/(dg/dt)
    fn towards<const M: usize, F: Flow<f64, N, M>>(
        &self,
        flow: &F,
        interface: usize,
        time: Time,
        state: &State<N>,
    ) -> f64 {
        let boundary = flow.boundary();
        let value = boundary.switching_function(interface, time.value, &state.x);
        let (by_time, gradient) = boundary.switching_gradient(interface, time.value, &state.x);
        let rate = by_time + gradient.dot(&flow.vector_field(time.value, &state.x));
        -(value + gradient.dot(&state.remainder) + by_time * time.remainder) / rate
    }

    /// Serves the output times up to `end`, the end of a step over `tau`.
    #[inline(always)]
    fn outputs_along<const P: usize, const M: usize, F: Flow<f64, N, M>>(
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

/// What the first coefficients of g tell of a step.
#[derive(Clone, Copy)]
enum Glance {
    /// It is not reached.
    Out,
    /// It is crossed once, about here.
    Once(f64),
    /// It may be reached.
    Near,
}

/// A glance at an interface over `tau`, from the coefficients of g, positive in the region; it
/// is `fresh` if the step starts on it, and then that root is divided off.
///
/// The Bernstein coefficients of the first terms of g bound them, and their differences the
/// slope. The other terms are estimated, with a margin, by a geometric series with the ratio
/// `fraction` of step and radius of convergence.
#[inline(always)]
fn glance(c: &[f64; LOOK], sign: f64, tau: f64, fraction: f64, fresh: bool) -> Glance {
    let h = sign * tau;
    let square = tau * tau;
    let g0 = sign * c[0];
    let (g1, g2, g3, g4) = (
        c[1] * h,
        c[2] * (h * tau),
        c[3] * (h * square),
        c[4] * (sign * square * square),
    );
    let rest = MARGIN * fraction / (1.0 - fraction) * (g4.abs() + fraction * g3.abs())
        + NOISE * f64::ROUNDING * g0.abs();
    if fresh {
        // the Bernstein coefficients of g/t on the step, times the step
        let b1 = g1 + g2 * (1.0 / 3.0);
        let b2 = g1 + (2.0 * g2 + g3) * (1.0 / 3.0);
        let b3 = g1 + (g2 + g3 + g4);
        return match g1.min(b1).min(b2).min(b3) > rest {
            true => Glance::Out,
            false => Glance::Near,
        };
    }
    let b1 = g0 + 0.25 * g1;
    let b2 = g0 + (0.5 * g1 + g2 * (1.0 / 6.0));
    let b3 = g0 + (0.75 * g1 + 0.5 * g2 + 0.25 * g3);
    let b4 = g0 + (g1 + g2 + g3 + g4);
    if g0.min(b1).min(b2).min(b3).min(b4) > rest {
        return Glance::Out;
    }
    let slowest = (g0 - b1).min(b1 - b2).min(b2 - b3).min(b3 - b4);
    if slowest > rest && g0 > 0.0 && b4 < -rest {
        return Glance::Once(tau * fall(&[g0, g1, g2, g3, g4]));
    }
    Glance::Near
}

/// About where a polynomial falls through zero in (0, 1).
#[inline]
fn fall(c: &[f64; LOOK]) -> f64 {
    let [c0, c1, c2, c3, c4] = *c;
    let value = |s: f64| c0 + s * (c1 + s * (c2 + s * (c3 + s * c4)));
    let slope = |s: f64| c1 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4)));
    let mut s = c0 / (c0 - value(1.0));
    for _ in 0..3 {
        s -= value(s) / slope(s);
    }
    s.clamp(0.0, 1.0)
}
