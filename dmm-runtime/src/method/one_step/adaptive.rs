//! Steps that a tolerance decides.

use super::crossing::{Locator, NewtonLocator};
use super::map::{OneStep, Step};
use super::search::{Dense, watches};
use super::segment::Segment;
use super::step_size::{COEFFICIENTS, Expansion, StepSizeControl};
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{Scalar, State, Time};
use crate::contract::{Dynamics, Vector};
use crate::error::Error;
use crate::events::Path;
use crate::events::ends::Decay;
use crate::level::Level;
use crate::method::{
    Cursor, Ended, Failure, Method, Sink, Statistics, StepFailure, Variation, check_tolerance,
};

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
#[derive(Clone, Debug)]
struct Run<T, const N: usize> {
    memory: T,
    control: StepSizeControl<N>,
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

/// A [`OneStep`] scheme with steps that a tolerance decides; made by
/// [`Symmetric::tolerance`](crate::Symmetric::tolerance) and
/// [`Composed::tolerance`](crate::Composed::tolerance).
///
/// A step from x is as long as the Taylor coefficients of the solution at x allow: over it the
/// first neglected one, relative to the largest size that each component has had, contributes
/// about the tolerance. They come from the recurrences of [`Taylor`](crate::Taylor). Steps are
/// rejected only where they cannot be made, or end where less than half of them is asked for.
///
/// ψ is conserved whatever the steps are. Errors of phase grow no faster than the time either,
/// without the steps being reversible: on Kepler orbits of eccentricity 0.9 (a thousand of them)
/// and in the Hénon–Heiles potential, the reversible control of Hairer & Söderlind (SIAM J. Sci.
/// Comput. 26, 2005), with the exact derivative of the same step size function, had the same
/// error for the same number of steps at order 2 and 4, and lost touch with the tolerance where
/// steps were long, at order 8.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Adaptive<Map, Loc = NewtonLocator> {
    map: Map,
    tolerance: f64,
    level_correction: bool,
    locator: Loc,
}

impl<Map: OneStep> Adaptive<Map> {
    /// Each step leaves an error of about `tolerance` relative to the size of the state. Between
    /// 2.2·10⁻¹⁶ and 0.1; the integrator refuses others.
    pub fn new(map: Map, tolerance: f64) -> Self {
        Self {
            map,
            tolerance,
            level_correction: true,
            locator: NewtonLocator,
        }
    }
}

impl<Map, Loc> Adaptive<Map, Loc> {
    /// Whether the rounding errors of ψ are corrected towards the level at the entry into the
    /// region (default: yes).
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            level_correction,
            ..self
        }
    }

    /// Replaces the locator of crossings (default: [`NewtonLocator`]).
    #[must_use]
    pub fn locator<Other: Locator>(self, locator: Other) -> Adaptive<Map, Other> {
        Adaptive {
            map: self.map,
            tolerance: self.tolerance,
            level_correction: self.level_correction,
            locator,
        }
    }
}

/// What steps of varying size carry from segment to segment.
#[derive(Clone, Debug)]
pub struct Memory<T, const N: usize> {
    /// The step that was last wanted.
    step: f64,
    /// The largest size of each component so far.
    sizes: Vector<f64, N>,
    /// Of a segment that was stopped between two steps.
    stopped: Option<Run<T, N>>,
}

impl<Map: OneStep, Loc: Locator> Adaptive<Map, Loc> {
    /// What the tolerance asks for.
    fn control<const N: usize>(&self, memory: &Memory<Map::Memory<N>, N>) -> StepSizeControl<N> {
        StepSizeControl::new(self.map.order(), self.tolerance, memory.sizes.as_slice())
    }

    /// The part of the radius of convergence that a step takes.
    fn fraction(&self) -> f64 {
        self.tolerance.powf(1.0 / (self.map.order() + 1) as f64)
    }
}

impl<Map: OneStep, Loc: Locator> Method for Adaptive<Map, Loc> {
    type Memory<const N: usize> = Memory<Map::Memory<N>, N>;

    fn check(&self, _t0: f64, _t_end: f64) -> Result<(), Error> {
        check_tolerance(self.tolerance)
    }

    fn memory<const N: usize>(&self, _t0: f64, _t_end: f64) -> Self::Memory<N> {
        Memory {
            step: 0.0,
            sizes: Vector::zeros(),
            stopped: None,
        }
    }

    fn segment<D, S, const N: usize, const M: usize>(
        &self,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        until: f64,
        memory: &mut Self::Memory<N>,
        sink: &mut S,
    ) -> Result<Ended, Failure>
    where
        D: Dynamics<f64, N, M>,
        S: Sink<N>,
    {
        let Cursor { time, state, .. } = cursor;
        let mut level = Level::enter(dynamics, *time, state, cursor.level.as_deref());
        let mut watches = watches(dynamics, time.value, &state.x, &cursor.active);
        let until = Time::new(until);
        let stopped = memory.stopped.take().filter(|_| cursor.level.is_some());
        let mut run = stopped.unwrap_or_else(|| {
            let mut control = self.control(memory);
            Run {
                memory: self.map.begin(dynamics, None),
                expansion: control.expand(dynamics, time.value, &state.x, memory.step),
                control,
            }
        });
        let decay = Decay::new(self.fraction());
        let mut segment = Segment {
            map: &self.map,
            locator: &self.locator,
            corrects_level: self.level_correction,
            cursor,
            sink: &mut sink.erased(),
        };
        while until.since(segment.cursor.time) > 0.0 {
            let made = segment.shorten(dynamics, &mut run, until)?;
            let Made {
                increment,
                tau,
                time,
                expansion,
            } = made;
            memory.step = tau;
            memory.sizes.copy_from_slice(run.control.sizes());
            if !watches.as_ref().is_empty() {
                let coefficients = dense(&run.expansion, self.map.order(), &increment, tau);
                let dense = Dense {
                    path: Path {
                        t0: segment.cursor.time.value,
                        unit: run.expansion.unit,
                        coefficients: std::array::from_fn(|i| &coefficients[i][..]),
                    },
                    tau,
                    decay,
                };
                if let Some(end) = segment.look(dynamics, &level, &watches, &dense, tau)? {
                    return Ok(end);
                }
            }
            level.rescale(dynamics, time.value, &segment.cursor.state);
            let end = (tau, time);
            let stops = segment.conclude(dynamics, &level, &mut watches, &increment, end)?;
            run.expansion = expansion;
            if stops {
                segment.keep(dynamics, &level, &watches);
                memory.stopped = Some(run);
                return Ok(Ended::Stopped);
            }
        }
        Ok(Ended::Finished)
    }

    fn reach<D, const N: usize, const M: usize>(
        &self,
        memory: &Self::Memory<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure>
    where
        D: Dynamics<f64, N, M>,
    {
        let mut control = self.control(memory);
        let (mut t, mut x) = (cursor.time.value, cursor.state.rounded());
        let mut before = 0.0;
        while t < to {
            let wanted = 1.0 / control.expand(dynamics, t, &x, before).rate;
            // NaN too ends there: the step then fails
            let end = if t + wanted < to { t + wanted } else { to };
            let tau = end - t;
            let step = Step {
                dynamics,
                t0: t,
                x0: &x,
                tau,
            };
            let increment = self.map.step(&step, &mut Statistics::default());
            let increment = increment.map_err(|failure| failure.over(tau))?;
            if !(tau > 0.0 && is_finite(&increment)) {
                return Err(StepFailure::NotFinite.over(tau));
            }
            x += increment;
            t = end;
            before = tau;
            (cursor.time, cursor.state) = (Time::new(t), State::new(x));
        }
        Ok(())
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        self.map.differentiate::<D, S, N, M>(step)
    }
}

impl<Map: OneStep, Loc: Locator, S: Sink<N>, const N: usize> Segment<'_, Map, Loc, S, N> {
    /// A step as long as it may be: shorter, until it can be made and is not too long.
    fn shorten<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        run: &mut Run<Map::Memory<N>, N>,
        until: Time,
    ) -> Result<Made<N>, Failure> {
        let mut wanted = 1.0 / run.expansion.rate;
        let mut failure = StepFailure::NotFinite;
        for _ in 0..=MOST_REJECTIONS {
            match self.attempt(dynamics, run, (wanted, until)) {
                Ok(made) if made.expansion.rate * made.tau <= TOO_LONG => return Ok(made),
                Ok(_) => {}
                Err(found) => failure = found,
            }
            self.sink.statistics().rejected += 1;
            wanted = wanted.min(until.since(self.cursor.time)) * SHORTER;
            run.memory = self.map.begin(dynamics, None);
        }
        Err(failure.over(wanted))
    }

    /// A step of about `wanted`.
    fn attempt<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        run: &mut Run<Map::Memory<N>, N>,
        (wanted, until): (f64, Time),
    ) -> Result<Made<N>, StepFailure> {
        let (start, x0) = (self.cursor.time, self.cursor.state.x);
        let remaining = until.since(start);
        let (tau, time) = match remaining {
            left if left <= wanted * NEARLY => (left, until),
            left if left <= 2.0 * wanted => step_from(dynamics, start, 0.5 * left),
            _ => step_from(dynamics, start, wanted),
        };
        if !(tau > 0.0 && time != start) {
            return Err(StepFailure::NotFinite);
        }
        let increment = if run.expansion.is_at_rest {
            Vector::zeros()
        } else {
            let step = Step {
                dynamics,
                t0: start.value,
                x0: &x0,
                tau,
            };
            let statistics = self.sink.statistics();
            self.map.varied_step(&step, &mut run.memory, statistics)?
        };
        let x1 = x0 + increment;
        let expansion = run.control.expand(dynamics, time.value, &x1, tau);
        if is_finite(&x1) && expansion.rate.is_finite() {
            Ok(Made {
                increment,
                tau,
                time,
                expansion,
            })
        } else {
            Err(StepFailure::NotFinite)
        }
    }
}

/// The size and the end of a step of about `tau` from `start`.
fn step_from<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
    dynamics: &D,
    start: Time,
    tau: f64,
) -> (f64, Time) {
    if dynamics.is_autonomous() {
        return (tau, start.after(tau));
    }
    // the formulas are evaluated at a double
    let time = Time::new(start.value + tau);
    (time.since(start), time)
}
