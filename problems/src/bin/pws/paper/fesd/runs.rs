//! Runs with detection of switches, and without.

use std::ops::ControlFlow;

use dmm_problems::method::MethodName;
use dmm_problems::problem::{AnyObserver, Crossed, Problem, Record, Run};
use dmm_problems::standard::{self, TwoRegions};
use dmm_runtime::Model;

use crate::failure::Failure;

/// Whether steps end on interfaces.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Standard,
    Detecting,
}

impl Form {
    pub(super) const ALL: [Self; 2] = [Self::Standard, Self::Detecting];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Detecting => "switch-detecting",
        }
    }
}

/// The problem of a declaration.
pub(super) fn declared(declaration: &str) -> Result<Problem, Failure> {
    let model = Model::compile(declaration).map_err(|error| Failure::Stopped(error.to_string()))?;
    Ok(Problem::own(model)?)
}

/// A run of a problem with two regions.
pub(super) struct Case<'a> {
    pub(super) problem: &'a Problem,
    pub(super) method: MethodName,
    pub(super) initial: &'a [f64],
    pub(super) t_end: f64,
}

/// What was seen of a run that detects switches.
#[derive(Default)]
pub(super) struct Seen {
    /// x(T)
    pub(super) last: Vec<f64>,
    /// Of the steps.
    pub(super) sizes: Vec<f64>,
    pub(super) transitions: Vec<Crossed>,
    t: f64,
}

impl Case<'_> {
    /// x(T) by `steps` steps.
    pub(super) fn end(&self, form: Form, steps: u32) -> Result<Vec<f64>, Failure> {
        match form {
            Form::Standard => self.standard(steps),
            Form::Detecting => Ok(self.detecting(steps)?.last),
        }
    }

    /// Steps that end on interfaces.
    pub(super) fn detecting(&self, steps: u32) -> Result<Seen, Failure> {
        let run = Run {
            method: self.method,
            step_size: self.t_end / f64::from(steps),
            // which would take off errors that the method makes
            level_correction: false,
            initial: self.initial.to_vec(),
            t_end: self.t_end,
            ..self.problem.default_run()
        };
        let mut seen = Seen::default();
        self.problem.integrate(&run, &mut seen)?;
        Ok(seen)
    }

    fn standard(&self, steps: u32) -> Result<Vec<f64>, Failure> {
        let stopped = |text: String| Failure::Stopped(text);
        let name = self.problem.system_name();
        let missing = || stopped(format!("{name}: not of two regions"));
        let [below, above] = [-1.0, 1.0].map(|side| self.problem.region_on_side(side));
        let (below, above) = below.zip(above).ok_or_else(missing)?;
        let method = self.method.runge_kutta();
        let method = method.ok_or_else(|| stopped(format!("{name}: no Runge-Kutta method")))?;
        let field =
            |region: usize| move |t: f64, x: &[f64]| self.problem.vector_field(region, t, x);
        let system = TwoRegions {
            below: &field(below),
            above: &field(above),
            switching_function: &|t, x| self.problem.switching_function(0, t, x),
        };
        standard::integrate(&system, method, self.initial, self.t_end, steps)
            .map_err(|error| stopped(format!("{name}, {}: {error}", self.method.name())))
    }
}

impl AnyObserver for Seen {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        if record.t > self.t {
            self.sizes.push(record.t - self.t);
        }
        self.t = record.t;
        self.last.clear();
        self.last.extend_from_slice(record.x);
        ControlFlow::Continue(())
    }

    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.transitions.push(crossed.clone());
        ControlFlow::Continue(())
    }
}
