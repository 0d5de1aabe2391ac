//! Problems as objects: the same operations on every system, whatever its dimension.
//!
//! [`Problem`] hides the number of states; [`Entry`](crate::entry::Entry) implements it
//! for a system declared by `pws!` together with its [`Description`].

use std::ops::ControlFlow;

use dmm_runtime::{Error, Statistics};

use crate::method::MethodName;

/// Of a run, unless another is given.
pub const DEFAULT_TOLERANCE: f64 = 1e-12;

/// What a problem is called, where it comes from, and its initial value problem.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// Name on the command line.
    pub name: &'static str,
    /// One line on what it is.
    pub title: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// x(0)
    pub initial: &'static [f64],
    /// End time of a run unless another is given.
    pub t_end: f64,
    /// Step size of a run unless another is given.
    pub step_size: f64,
    /// Where the solution grows beyond the range of doubles (its squares included), the time
    /// until which it can be followed.
    pub longest: Option<f64>,
    /// The reference solution (JSON), where there is one.
    pub reference: Option<&'static str>,
}

/// An integration to be made from t = 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Run {
    /// The scheme.
    pub method: MethodName,
    /// τ, if the scheme has uniform steps.
    pub step_size: f64,
    /// The tolerance, if the scheme has one.
    pub tolerance: f64,
    /// Whether the level of ψ is kept (as it is meant to be) or left to rounding.
    pub level_correction: bool,
    /// Initial state.
    pub initial: Vec<f64>,
    /// End time.
    pub t_end: f64,
    /// Times of output besides the steps.
    pub output_times: OutputTimes,
}

/// Times at which [`Sink::output`] is called.
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
    pub(crate) fn get(&self, k: usize) -> Option<f64> {
        match self {
            Self::None => None,
            Self::At(times) => times.get(k).copied(),
            Self::Every(interval) => Some((k + 1) as f64 * interval),
        }
    }
}

/// A point of a run, with the conserved quantities of its region.
#[derive(Clone, Copy, Debug)]
pub struct Record<'a> {
    /// Time.
    pub t: f64,
    /// State.
    pub x: &'a [f64],
    /// Index of the region.
    pub region: usize,
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
    /// The state at the end time.
    pub x: Vec<f64>,
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
    /// Index of the region.
    pub region: usize,
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

/// A transition of a run.
#[derive(Clone, PartialEq, Debug)]
pub struct Crossed {
    /// t̂*
    pub t: f64,
    /// x̂*
    pub x: Vec<f64>,
    /// Index of the interface.
    pub interface: usize,
    /// Index of the region that is left.
    pub from: usize,
    /// Index of the region that is entered.
    pub to: usize,
    /// dg/dt under the field that is left.
    pub rate_from: f64,
    /// dg/dt under the field that is entered.
    pub rate_to: f64,
}

/// What listens to a run.
pub trait Sink {
    /// A point: the end of a step, at a transition one with each region, and each time of
    /// output.
    fn record(&mut self, _record: &Record<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// A transition.
    fn transition(&mut self, _crossed: &Crossed) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// The state at the next of [`Run::output_times`], before it is recorded.
    fn output(&mut self, _t: f64, _x: &[f64]) {}

    /// Whether [`Sink::record`] is to be called.
    fn wants_records(&self) -> bool {
        true
    }
}

/// A problem, with its system's present parameters.
pub trait Problem: Send + Sync {
    /// Name, source and initial value problem.
    fn description(&self) -> &Description;
    /// The name of the declared system.
    fn system_name(&self) -> &'static str;
    /// The declaration.
    fn declaration(&self) -> &str;
    /// The derived scheme in readable mathematics.
    fn listing(&self) -> &str;
    /// Names of the states.
    fn states(&self) -> &'static [&'static str];
    /// Names of the interfaces.
    fn interfaces(&self) -> &'static [&'static str];
    /// Names of the regions.
    fn regions(&self) -> Vec<&'static str>;
    /// Names of the quantities that a region conserves.
    fn conserved_names(&self, region: usize) -> &'static [&'static str];
    /// The region on a side (−1 or 1) of the first interface.
    fn region_on_side(&self, sign: f64) -> Option<usize>;
    /// Names and present values of the parameters.
    fn parameters(&self) -> Vec<(&'static str, f64)>;
    /// Sets a parameter; false if there is none of that name.
    fn set_parameter(&mut self, name: &str, value: f64) -> bool;
    /// Whether all parameters have their default values.
    fn has_default_parameters(&self) -> bool;
    /// f(t, x) in a region.
    fn vector_field(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64>;
    /// g(t, x) of an interface.
    fn switching_function(&self, interface: usize, t: f64, x: &[f64]) -> f64;
    /// Makes a run and tells `sink` of it.
    ///
    /// # Errors
    /// Whatever stops the integration.
    fn integrate(&self, run: &Run, sink: &mut dyn Sink) -> Result<Statistics, Error>;
    /// Makes a run that is not listened to, for its speed.
    ///
    /// # Errors
    /// Whatever stops the integration.
    fn integrate_silently(&self, run: &Run) -> Result<Finish, Error>;
    /// Makes the run from many starts instead of its own, and tells `sink` of each in order.
    fn integrate_all(
        &self,
        run: &Run,
        parallelism: Parallelism,
        starts: &mut dyn Iterator<Item = Start>,
        sink: &mut dyn FnMut(MemberOutcome) -> ControlFlow<()>,
    );
    /// A copy.
    fn duplicate(&self) -> Box<dyn Problem>;

    /// The run of the problem's description.
    fn default_run(&self) -> Run {
        let description = self.description();
        Run {
            method: MethodName::Symmetric,
            step_size: description.step_size,
            tolerance: DEFAULT_TOLERANCE,
            level_correction: true,
            initial: description.initial.to_vec(),
            t_end: description.t_end,
            output_times: OutputTimes::None,
        }
    }

    /// Whether a run from `initial` is the one that the reference solution is of.
    fn is_reference_run(&self, initial: &[f64]) -> bool {
        self.description().reference.is_some()
            && self.has_default_parameters()
            && initial == self.description().initial
    }
}
