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

use dmm_runtime::{
    Best, Error, Integrator, Method, Model, ModelVisitor, System, Taylor, Transition,
    TransitionKind, on_transition,
};

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

/// A trajectory of a model from (t₀, x₀) that `watch` looks at.
struct Follow<'a, W> {
    scheme: Scheme,
    from: (f64, &'a [f64]),
    t_end: f64,
    watch: W,
}

impl<W: FnMut(Passage) -> ControlFlow<()>> Follow<'_, W> {
    fn by<Sys: System<N>, Met: Method, const N: usize>(
        mut self,
        system: &Sys,
        method: Met,
    ) -> Result<(f64, Vec<f64>), Error> {
        let states = system.metadata().states.len();
        let mut observer = on_transition(|one: &Transition<Sys::Region, N>| {
            (self.watch)(Passage {
                t: one.t,
                interface: one.interface,
                jumped: one.kind == TransitionKind::Jumped,
                before: one.x.as_slice()[..states].to_vec(),
                after: one.after.as_slice()[..states].to_vec(),
            })
        });
        let (t0, x0) = self.from;
        let run = Integrator::new(system, method).initial(t0, x0);
        let end = run.observe_until(self.t_end, &mut observer)?.point;
        Ok((end.t, end.x.as_slice()[..states].to_vec()))
    }
}

impl<W: FnMut(Passage) -> ControlFlow<()>> ModelVisitor for Follow<'_, W> {
    type Output = Result<(f64, Vec<f64>), Error>;

    fn visit<Sys: System<N>, const N: usize>(self, system: Sys) -> Self::Output {
        match self.scheme {
            Scheme::Best => self.by(&system, Best::tolerance(TOLERANCE)),
            Scheme::Taylor => self.by(&system, Taylor::tolerance(TOLERANCE)),
        }
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
    let (t, x) = model.visit(Follow {
        scheme,
        from: (0.0, x0),
        t_end,
        watch: |passage: Passage| {
            passages.push(passage);
            ControlFlow::Continue(())
        },
    })??;
    Ok(Way { passages, t, x })
}

/// The trajectory from (0, x₀) to the first event.
fn to_event(model: &Model, scheme: Scheme, x0: &[f64], latest: f64) -> Result<Passage, Failure> {
    let mut event = None;
    model.visit(Follow {
        scheme,
        from: (0.0, x0),
        t_end: latest,
        watch: |passage: Passage| {
            if !passage.jumped {
                return ControlFlow::Continue(());
            }
            event = Some(passage);
            ControlFlow::Break(())
        },
    })??;
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
