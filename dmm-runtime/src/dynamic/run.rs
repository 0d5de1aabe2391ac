//! What a run of a system of any dimension is given, tells and gives.

use std::ops::ControlFlow;

use crate::contract::Side;
use crate::error::Error;
use crate::method::Statistics;
use crate::output::TransitionKind;

/// An initial value problem, x(0) = x₀ until an end time.
#[derive(Clone, PartialEq, Debug)]
pub struct InitialValue {
    /// x(0)
    pub initial: Vec<f64>,
    /// End time.
    pub t_end: f64,
    /// Times of output besides the steps.
    pub output_times: OutputTimes,
}

impl InitialValue {
    /// Without times of output.
    pub fn new(initial: Vec<f64>, t_end: f64) -> Self {
        Self {
            initial,
            t_end,
            output_times: OutputTimes::None,
        }
    }
}

/// Times at which [`AnyObserver::output`] is called.
#[derive(Clone, PartialEq, Debug, Default)]
pub enum OutputTimes {
    /// None.
    #[default]
    None,
    /// These, in ascending order.
    At(Vec<f64>),
    /// The multiples of an interval.
    Every(f64),
}

impl OutputTimes {
    /// The `k`-th, from 0.
    pub(super) fn get(&self, k: usize) -> Option<f64> {
        match self {
            Self::None => None,
            Self::At(times) => times.get(k).copied(),
            Self::Every(interval) => Some((k + 1) as f64 * interval),
        }
    }
}

/// What a run is in: a region, with what is constant between events.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct AnyMode {
    /// Index of the region.
    pub region: usize,
    /// The discrete states, in the order of [`Metadata::discrete`](crate::Metadata::discrete).
    pub discrete: Vec<f64>,
    /// The sides of the interfaces in [`Metadata::free`](crate::Metadata::free); nothing for those that
    /// it slides on.
    pub sides: Vec<Option<Side>>,
}

/// A point of a run, with the conserved quantities of its region.
#[derive(Clone, Copy, Debug)]
pub struct Record<'a> {
    /// Time.
    pub t: f64,
    /// State.
    pub x: &'a [f64],
    /// Mode.
    pub mode: &'a AnyMode,
    /// ψ(t, x)
    pub psi: &'a [f64],
    /// The largest Σ|terms of ψ(t, x)| since the entry to the region. (At a single point the
    /// terms may all vanish, as u L and μ y/r do at an apex of a Kepler orbit.)
    pub size: &'a [f64],
    /// ψ on entry to the region.
    pub level: &'a [f64],
    /// Whether it is a time of output, rather than the end of a step.
    pub is_output: bool,
}

impl Record<'_> {
    /// ψ − ψ_ref, in units of ε·Σ|terms of ψ|, ε = 2⁻⁵²; the largest over the quantities.
    pub fn error_ulps(&self) -> f64 {
        self.worst(|error, size| error / (f64::EPSILON * size))
    }

    /// |ψ − ψ_ref|, the largest over the quantities.
    pub fn error(&self) -> f64 {
        self.worst(|error, _| error)
    }

    fn worst(&self, measure: impl Fn(f64, f64) -> f64) -> f64 {
        let errors = self.psi.iter().zip(self.level).zip(self.size);
        errors.fold(0.0, |worst, ((psi, level), size)| {
            let error = (psi - level).abs();
            // a NaN must not be lost
            let value = if error == 0.0 {
                0.0
            } else {
                measure(error, *size)
            };
            if value > worst || value.is_nan() {
                value
            } else {
                worst
            }
        })
    }
}

/// How a run ended.
#[derive(Clone, PartialEq, Debug)]
pub struct Finish {
    /// The state at the end time, or where the observer stopped the run.
    pub x: Vec<f64>,
    /// What of the state a double cannot hold.
    pub remainder: Vec<f64>,
    /// Counters of the run.
    pub statistics: Statistics,
}

/// Where a member of an ensemble starts: all parameters and states, in their order.
#[derive(Clone, PartialEq, Debug)]
pub struct Start {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// x(0)
    pub initial: Vec<f64>,
}

/// Where a member of an ensemble ended.
#[derive(Clone, PartialEq, Debug)]
pub struct Arrival {
    /// Time.
    pub t: f64,
    /// State.
    pub x: Vec<f64>,
    /// Mode.
    pub mode: AnyMode,
    /// Counters.
    pub statistics: Statistics,
}

/// What became of a member of an ensemble: where it came to, if it started at all, and what
/// stopped it, if anything did.
#[derive(Clone, PartialEq, Debug)]
pub struct MemberOutcome {
    /// Where it came to.
    pub arrival: Option<Arrival>,
    /// What stopped it.
    pub error: Option<Error>,
}

/// How an ensemble is computed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Parallelism {
    /// Threads, or one for each core.
    pub threads: Option<usize>,
    /// Whether several trajectories are integrated in a register.
    pub lanes: bool,
}

/// A transition of a run; see [`Transition`](crate::Transition).
#[derive(Clone, PartialEq, Debug)]
pub struct Crossed {
    /// t̂*
    pub t: f64,
    /// x̂*, the state in front of the transition.
    pub x: Vec<f64>,
    /// The state behind it.
    pub after: Vec<f64>,
    /// What happened.
    pub kind: TransitionKind,
    /// Index of the interface.
    pub interface: usize,
    /// The mode that is left.
    pub from: AnyMode,
    /// The mode that is entered.
    pub to: AnyMode,
    /// dg/dt under the field that is left.
    pub rate_from: f64,
    /// dg/dt under the field that is entered.
    pub rate_to: f64,
}

/// What listens to a run.
pub trait AnyObserver {
    /// A point: the end of a step, at a transition one with each region, and each time of
    /// output.
    fn record(&mut self, _record: &Record<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// A transition.
    fn transition(&mut self, _crossed: &Crossed) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// The state at the next of [`InitialValue::output_times`], before it is recorded.
    fn output(&mut self, _t: f64, _x: &[f64]) {}

    /// [`AnyObserver::record`] is called at every so many points, at the first of each region and at
    /// times of output; never, if it is 0.
    fn record_every(&self) -> u64 {
        1
    }
}

/// Listens to nothing.
#[derive(Clone, Copy, Debug)]
pub struct Unobserved;

impl AnyObserver for Unobserved {
    fn record_every(&self) -> u64 {
        0
    }
}
