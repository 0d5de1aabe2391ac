//! A segment by steps that a tolerance decides.

use crate::error::{Error, StepFailure};
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::Observer;
use crate::scheme::{Adaptive, Maps, OneStep, Pacer, Step};
use crate::system::{Flow, System, Vector};
use crate::time::Time;
use crate::transition::Locator;
use crate::walk::interfaces::{advance, is_near, readings, watches};
use crate::walk::{SegmentEnd, Walk};

/// A step is too long if at its end steps this many times shorter are asked for.
const TOO_LONG: f64 = 2.0;
/// What a rejected step is multiplied by.
const SHORTER: f64 = 0.5;
/// So many times a step is made shorter before it is given up.
const MOST_REJECTIONS: u32 = 60;
/// The remaining time is one step where it is less than this many, and halved where it is less
/// than two.
const NEARLY: f64 = 1.000_001;

/// What goes from step to step.
struct Run<T, const N: usize> {
    memory: T,
    pacer: Pacer<N>,
    /// 1/τ of the next step.
    rate: f64,
}

/// A step that was made.
struct Made<const N: usize> {
    increment: Vector<f64, N>,
    tau: f64,
    time: Time,
    /// The rate that is asked for at its end.
    rate: f64,
}

impl<Sys, Sch, Loc, Obs, const N: usize> Walk<'_, Sys, Adaptive<Sch>, Loc, Obs, N>
where
    Sys: System<N>,
    Sch: OneStep,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// Steps, until the boundary of the region or the end time is reached.
    pub(crate) fn adaptive_segment<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
    ) -> Result<SegmentEnd, Error> {
        let mut level = Level::enter(flow, self.time, &self.state);
        let mut watches = watches(flow, self.time.value, &self.state.x, self.fresh);
        let mut pacer = self.scheme.pacer();
        let mut run = Run {
            memory: self.begin(flow),
            rate: pacer.rate(flow, self.time.value, &self.state.x),
            pacer,
        };
        while Time::new(self.progress.end).since(self.time) > 0.0 {
            let made = self.shorten(flow, &mut run)?;
            let Made {
                increment,
                tau,
                time,
                rate,
            } = made;
            let x1 = self.state.x + increment;
            let values = readings::<N, M, F>(flow, time.value, &x1);
            if is_near(&watches, &values)
                && let Some(end) = self.look(flow, &level, &mut watches, tau, &increment)?
            {
                return Ok(end);
            }
            self.outputs(flow, tau, time)?;
            level.rescale(flow, time.value, &self.state);
            self.accept(flow, &level, &increment, tau, time)?;
            let values = readings::<N, M, F>(flow, time.value, &self.state.x);
            advance(&mut watches, &values, true);
            if self.tell_point().is_break() {
                return Ok(SegmentEnd::Stopped);
            }
            run.rate = rate;
        }
        Ok(SegmentEnd::Finished)
    }

    fn begin<const M: usize, F: Flow<f64, N, M>>(&self, flow: &F) -> Sch::Memory<N> {
        let map = self.scheme.map();
        map.begin(flow, self.time.value, &self.state.x)
    }

    /// A step as long as it may be: shorter, until it can be made and is not too long.
    fn shorten<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        run: &mut Run<Sch::Memory<N>, N>,
    ) -> Result<Made<N>, Error> {
        let mut wanted = 1.0 / run.rate;
        let mut failure = StepFailure::NotFinite;
        for _ in 0..=MOST_REJECTIONS {
            match self.attempt(flow, run, wanted) {
                Ok(made) if made.rate * made.tau <= TOO_LONG => {
                    self.progress.step = wanted;
                    return Ok(made);
                }
                Ok(_) => {}
                Err(found) => failure = found,
            }
            self.statistics.rejected += 1;
            wanted *= SHORTER;
            run.memory = self.begin(flow);
        }
        Err(self.failure(failure, wanted))
    }

    /// A step of about `wanted`.
    fn attempt<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        run: &mut Run<Sch::Memory<N>, N>,
        wanted: f64,
    ) -> Result<Made<N>, StepFailure> {
        let remaining = Time::new(self.progress.end).since(self.time);
        let (tau, time) = match remaining {
            left if left <= wanted * NEARLY => (left, Time::new(self.progress.end)),
            left if left <= 2.0 * wanted => self.after::<M, F>(0.5 * left),
            _ => self.after::<M, F>(wanted),
        };
        if !(tau > 0.0 && time != self.time) {
            return Err(StepFailure::NotFinite);
        }
        let step = Step {
            flow,
            t0: self.time.value,
            x0: &self.state.x,
            tau,
        };
        let map = self.scheme.map();
        let increment = map.varied_step(&step, &mut run.memory, &mut self.statistics)?;
        let x1 = self.state.x + increment;
        let rate = run.pacer.rate(flow, time.value, &x1);
        match is_finite(&x1) && rate.is_finite() {
            true => Ok(Made {
                increment,
                tau,
                time,
                rate,
            }),
            false => Err(StepFailure::NotFinite),
        }
    }

    /// The time after about `tau`, and the exact difference to it.
    fn after<const M: usize, F: Flow<f64, N, M>>(&self, tau: f64) -> (f64, Time) {
        match F::AUTONOMOUS {
            true => (tau, self.time.after(tau)),
            // the formulas are evaluated at a double
            false => {
                let time = Time::new(self.time.value + tau);
                (time.since(self.time), time)
            }
        }
    }
}
