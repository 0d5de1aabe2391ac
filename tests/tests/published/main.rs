//! Systems with events and switches of `problems/hybrid`, beside closed forms, published numbers and
//! solutions of 20 digits that another program computed.
//!
//! Where a test says *Taylor series of 40 digits*, its numbers are of a program of its own, in
//! decimal arithmetic of 40 digits: Taylor series of order 30, whose coefficients are written out
//! for the system, and a secant iteration for each zero of g. Two runs with different steps agree to
//! the 20 digits that are kept.
#![allow(
    clippy::excessive_precision,
    reason = "references have more digits than a double"
)]

mod backlash;
mod balls;
mod billiard;
mod circuits;
mod converter;
mod epidemic;
mod files;
mod maps;
mod neuron;
mod rings;
mod sphere;
mod walker;

use std::ops::ControlFlow;

use dmm_problems::method::{MethodName, Run};
use dmm_problems::problem::Problem;
use dmm_runtime::dynamic::{AnyObserver, Crossed, Record};
use dmm_runtime::{Model, TransitionKind};

type Failure = Box<dyn std::error::Error>;

/// Exact flows where the field is affine, Taylor series elsewhere; or Taylor series everywhere.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Scheme {
    Best,
    Taylor,
}

const BOTH: [Scheme; 2] = [Scheme::Best, Scheme::Taylor];

/// What is left out by a Taylor series: less than rounding errors.
const TOLERANCE: f64 = 1e-15;

/// A crossing or an event.
#[derive(Clone, PartialEq, Debug)]
struct Passage {
    t: f64,
    interface: usize,
    jumped: bool,
    before: Vec<f64>,
    after: Vec<f64>,
}

/// A trajectory.
#[derive(Clone, PartialEq, Debug)]
struct Way {
    passages: Vec<Passage>,
    t: f64,
    x: Vec<f64>,
}

impl Way {
    /// The times of the passages of an interface, by its index.
    fn times(&self, interface: usize) -> Vec<f64> {
        let there = self
            .passages
            .iter()
            .filter(|one| one.interface == interface);
        there.map(|one| one.t).collect()
    }
}

/// A trajectory of a model from (0, x₀) to a time, with a function that is told of each passage: the
/// last point.
fn follow(
    model: &Model,
    scheme: Scheme,
    (x0, t_end): (&[f64], f64),
    watch: &mut dyn FnMut(Passage) -> ControlFlow<()>,
) -> Result<(f64, Vec<f64>), Failure> {
    let problem = Problem::own(model.clone())?;
    let run = Run {
        method: match scheme {
            Scheme::Best => MethodName::Best,
            Scheme::Taylor => MethodName::Taylor,
        },
        tolerance: TOLERANCE,
        initial: x0.to_vec(),
        t_end,
        ..problem.default_run()
    };
    let end = (0.0, x0.to_vec());
    let mut observer = Watch { watch, end };
    problem.integrate(&run, &mut observer)?;
    Ok(observer.end)
}

/// Tells a function of the passages, and keeps the last point.
struct Watch<'a> {
    watch: &'a mut dyn FnMut(Passage) -> ControlFlow<()>,
    end: (f64, Vec<f64>),
}

impl AnyObserver for Watch<'_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        self.end.0 = record.t;
        self.end.1.clear();
        self.end.1.extend(record.x);
        ControlFlow::Continue(())
    }

    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        (self.watch)(Passage {
            t: crossed.t,
            interface: crossed.interface,
            jumped: crossed.kind == TransitionKind::Jumped,
            before: crossed.x.clone(),
            after: crossed.after.clone(),
        })
    }
}

/// A model with some of its parameters set.
fn model(declaration: &str, parameters: &[(&str, f64)]) -> Result<Model, Failure> {
    let mut model = Model::compile(declaration)?;
    for &(name, value) in parameters {
        model.set(name, value)?;
    }
    Ok(model)
}

/// The trajectory from (0, x₀) to t.
fn run(model: &Model, scheme: Scheme, x0: &[f64], t_end: f64) -> Result<Way, Failure> {
    let mut passages = Vec::new();
    let (t, x) = follow(model, scheme, (x0, t_end), &mut |passage| {
        passages.push(passage);
        ControlFlow::Continue(())
    })?;
    Ok(Way { passages, t, x })
}

/// The trajectory from (0, x₀) to the first event.
fn to_event(model: &Model, scheme: Scheme, x0: &[f64], latest: f64) -> Result<Passage, Failure> {
    let mut event = None;
    follow(model, scheme, (x0, latest), &mut |passage| {
        if !passage.jumped {
            return ControlFlow::Continue(());
        }
        event = Some(passage);
        ControlFlow::Break(())
    })?;
    event.ok_or_else(|| "no event".into())
}

/// Compares numbers with those of a reference, by absolute errors.
fn assert_close(name: &str, values: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(values.len(), expected.len(), "{name}: {values:?}");
    for (number, (value, expected)) in values.iter().zip(expected).enumerate() {
        let error = (value - expected).abs();
        assert!(
            error <= tolerance,
            "{name} {number}: {value} in place of {expected}, an error of {error:e}"
        );
    }
}
