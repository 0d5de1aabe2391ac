//! A segment by steps that a tolerance decides.

use crate::error::{Error, StepFailure};
use crate::events::Path;
use crate::events::ends::Decay;
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::Observer;
use crate::scheme::{Adaptive, COEFFICIENTS, Expansion, Maps, OneStep, Pacer, Step};
use crate::system::{Flow, System, Vector};
use crate::time::Time;
use crate::transition::Locator;
use crate::walk::interfaces::{Dense, advance, readings, watches};
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
    /// The solution at the start of the next step.
    expansion: Expansion<N>,
}

/// A step that was made.
struct Made<const N: usize> {
    increment: Vector<f64, N>,
    tau: f64,
    time: Time,
    /// The solution at its end.
    expansion: Expansion<N>,
}

/// Coefficients of the dense output of a step.
const DENSE: usize = COEFFICIENTS + 1;

/// The dense output of a step of order p: the Taylor polynomial of order p + 1 at its start, and a
/// term of the next order that leads to the end of the step.
fn dense<const N: usize>(
    expansion: &Expansion<N>,
    order: usize,
    increment: &Vector<f64, N>,
    tau: f64,
) -> [[f64; DENSE]; N] {
    let s = tau / expansion.unit;
    let last = order + 2;
    std::array::from_fn(|i| {
        let mut dense = [0.0; DENSE];
        dense[..last].copy_from_slice(&expansion.coefficients[i][..last]);
        let reached = dense[1..last].iter().rev().fold(0.0, |sum, c| sum * s + c) * s;
        let power = s.powi(last as i32);
        let rest = (increment[i] - reached) / power;
        dense[last] = if rest.is_finite() { rest } else { 0.0 };
        dense
    })
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
        let mut pacer = self.scheme.pacer(&self.progress);
        let (t, before) = (self.time.value, self.progress.step);
        let mut run = Run {
            memory: self.begin(flow),
            expansion: pacer.expand(flow, t, &self.state.x, before),
            pacer,
        };
        let decay = Decay::new(self.scheme.fraction());
        while Time::new(self.progress.end).since(self.time) > 0.0 {
            let made = self.shorten(flow, &mut run)?;
            let Made {
                increment,
                tau,
                time,
                expansion,
            } = made;
            self.progress.sizes.clear();
            self.progress.sizes.extend_from_slice(run.pacer.sizes());
            if !watches.as_ref().is_empty() {
                let coefficients = dense(&run.expansion, Sch::ORDER, &increment, tau);
                let dense = Dense {
                    path: Path {
                        t0: self.time.value,
                        unit: run.expansion.unit,
                        coefficients: std::array::from_fn(|i| &coefficients[i][..]),
                    },
                    tau,
                    decay,
                };
                if let Some(end) = self.look(flow, &level, &mut watches, &dense)? {
                    return Ok(end);
                }
            }
            self.outputs(flow, tau, time)?;
            level.rescale(flow, time.value, &self.state);
            self.accept(flow, &level, &increment, tau, time)?;
            let values = readings::<N, M, F>(flow, time.value, &self.state.x);
            advance(&mut watches, &values, true);
            if self.tell_point().is_break() {
                return Ok(SegmentEnd::Stopped);
            }
            run.expansion = expansion;
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
        let mut wanted = 1.0 / run.expansion.rate;
        let mut failure = StepFailure::NotFinite;
        for _ in 0..=MOST_REJECTIONS {
            match self.attempt(flow, run, wanted) {
                Ok(made) if made.expansion.rate * made.tau <= TOO_LONG => {
                    self.progress.step = made.tau;
                    return Ok(made);
                }
                Ok(_) => {}
                Err(found) => failure = found,
            }
            self.statistics.rejected += 1;
            wanted = wanted.min(Time::new(self.progress.end).since(self.time)) * SHORTER;
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
        let increment = if run.expansion.is_at_rest {
            Vector::zeros()
        } else {
            map.varied_step(&step, &mut run.memory, &mut self.statistics)?
        };
        let x1 = self.state.x + increment;
        let expansion = run.pacer.expand(flow, time.value, &x1, tau);
        match is_finite(&x1) && expansion.rate.is_finite() {
            true => Ok(Made {
                increment,
                tau,
                time,
                expansion,
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
