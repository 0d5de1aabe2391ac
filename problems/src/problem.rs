//! Problems as objects: the same operations on every system, whatever its dimension.
//!
//! A [`Problem`] is a system of any dimension, compiled with the program or at run time, with its
//! [`Description`].

use std::ops::ControlFlow;

use dmm_runtime::dynamic;
pub use dmm_runtime::dynamic::{
    AnyMode, AnyObserver, Arrival, Crossed, Finish, InitialValue, MemberOutcome, OutputTimes,
    Parallelism, Record, Start,
};
use dmm_runtime::{Error, Metadata, Model};

use crate::method::MethodName;
pub use crate::method::Run;

/// Of a run, unless another is given.
pub const DEFAULT_METHOD: MethodName = MethodName::Best;
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

/// A system whose methods are those of a [`Run`].
pub type AnySystem = dyn dynamic::AnySystem<Run>;

/// A problem, with its system's present parameters.
#[derive(Debug)]
pub struct Problem {
    description: Description,
    system: Box<AnySystem>,
}

impl Clone for Problem {
    fn clone(&self) -> Self {
        Self {
            description: self.description,
            system: self.system.duplicate(),
        }
    }
}

impl Problem {
    /// An initial value problem of a system.
    pub fn new(description: Description, system: Box<AnySystem>) -> Self {
        Self {
            description,
            system,
        }
    }

    /// A system that was compiled at run time and has no description: it starts at the origin.
    ///
    /// # Errors
    /// One that is too large.
    pub fn own(model: Model) -> Result<Self, Error> {
        let metadata = model.metadata();
        let system = model.into_any()?;
        let description = Description {
            name: metadata.name,
            title: "a system of your own",
            source: "",
            // kept like the names
            initial: Vec::leak(vec![0.0; metadata.states.len()]),
            t_end: 10.0,
            step_size: 1e-2,
            longest: None,
            reference: None,
        };
        Ok(Self::new(description, system))
    }

    /// Name, source and initial value problem.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Names, and where the regions lie.
    pub fn metadata(&self) -> &'static Metadata {
        self.system.metadata()
    }

    /// The name of the declared system.
    pub fn system_name(&self) -> &'static str {
        self.metadata().name
    }

    /// The declaration.
    pub fn declaration(&self) -> &str {
        self.system.declaration()
    }

    /// The derived scheme in readable mathematics.
    pub fn listing(&self) -> &str {
        self.system.listing()
    }

    /// Names of the states.
    pub fn states(&self) -> &'static [&'static str] {
        self.metadata().states
    }

    /// Names of the interfaces.
    pub fn interfaces(&self) -> &'static [&'static str] {
        self.metadata().interfaces
    }

    /// Names of the regions.
    pub fn regions(&self) -> Vec<&'static str> {
        let regions = self.metadata().regions.iter();
        regions.map(|region| region.name).collect()
    }

    /// Names of the quantities that a region conserves.
    pub fn conserved_names(&self, region: usize) -> &'static [&'static str] {
        let region = self.metadata().regions.get(region);
        region.map_or(&[], |region| region.conserved)
    }

    /// The region on a side (−1 or 1) of the first interface.
    pub fn region_on_side(&self, sign: f64) -> Option<usize> {
        let mut regions = self.metadata().regions.iter();
        regions.position(|region| {
            let side = region.sides.first().copied().flatten();
            side.is_some_and(|side| side.sign() == sign)
        })
    }

    /// Names and present values of the parameters.
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        let names = self.metadata().parameters.iter().copied();
        names.zip(self.system.parameters()).collect()
    }

    /// Sets a parameter; false if there is none of that name.
    pub fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        self.system.set_parameter(name, value)
    }

    /// Whether all parameters have their default values.
    pub fn has_default_parameters(&self) -> bool {
        self.system.parameters() == self.system.defaults()
    }

    /// f(t, x) in a region.
    pub fn vector_field(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64> {
        self.system.vector_field(region, t, x)
    }

    /// ψ(t, x) of a region.
    pub fn conserved(&self, region: usize, t: f64, x: &[f64]) -> Vec<f64> {
        self.system.conserved(region, t, x)
    }

    /// g(t, x) of an interface.
    pub fn switching_function(&self, interface: usize, t: f64, x: &[f64]) -> f64 {
        self.system.switching_function(interface, t, x)
    }

    /// Makes a run and tells `sink` of it.
    ///
    /// # Errors
    /// Whatever stops the integration.
    pub fn integrate(&self, run: &Run, sink: &mut dyn AnyObserver) -> Result<Finish, Error> {
        self.system.integrate(run, &run.from(), sink)
    }

    /// Makes a run that is not listened to, for its speed.
    ///
    /// # Errors
    /// Whatever stops the integration.
    pub fn integrate_silently(&self, run: &Run) -> Result<Finish, Error> {
        self.system.integrate_silently(run, &run.from())
    }

    /// Makes the run from many starts instead of its own, and tells `sink` of each in order.
    pub fn integrate_all(
        &self,
        run: &Run,
        parallelism: Parallelism,
        starts: &mut dyn Iterator<Item = Start>,
        sink: &mut dyn FnMut(MemberOutcome) -> ControlFlow<()>,
    ) {
        let t_end = run.t_end;
        self.system
            .integrate_all(run, t_end, parallelism, starts, sink);
    }

    /// The run of the problem's description.
    pub fn default_run(&self) -> Run {
        let description = self.description();
        Run {
            method: DEFAULT_METHOD,
            step_size: description.step_size,
            tolerance: DEFAULT_TOLERANCE,
            level_correction: true,
            initial: description.initial.to_vec(),
            t_end: description.t_end,
            output_times: OutputTimes::None,
        }
    }

    /// The start of the problem's description, with the parameters as they are.
    pub fn default_start(&self) -> Start {
        let parameters = self.parameters();
        Start {
            parameters: parameters.iter().map(|(_, value)| *value).collect(),
            initial: self.description().initial.to_vec(),
        }
    }

    /// Whether a run from `initial` is the one that the reference solution is of.
    pub fn is_reference_run(&self, initial: &[f64]) -> bool {
        self.description().reference.is_some()
            && self.has_default_parameters()
            && initial == self.description().initial
    }
}
