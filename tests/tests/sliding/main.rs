//! Solutions that slide on interfaces: friction, relays, thresholds, and their intersections.

mod chains;
mod codimension;
mod friction;
mod rules;

use std::ops::ControlFlow;

use dmm_problems::method::{MethodName, Run};
use dmm_problems::problem::Problem;
use dmm_runtime::dynamic::{AnyObserver, Crossed, Record};
use dmm_runtime::{Metadata, Model, TransitionKind};

type Failure = Box<dyn std::error::Error>;

/// A transition by the names of the declaration.
#[derive(Clone, PartialEq, Debug)]
struct Passed {
    t: f64,
    kind: TransitionKind,
    interface: &'static str,
    to: &'static str,
    x: Vec<f64>,
}

/// A trajectory.
#[derive(Clone, PartialEq, Debug)]
struct Way {
    passed: Vec<Passed>,
    end: Vec<f64>,
}

/// A system compiled at run time from (0, x₀) until an end time by `Taylor`, with parameters changed.
fn taylor(
    declaration: &str,
    parameters: &[(&str, f64)],
    x0: &[f64],
    t_end: f64,
) -> Result<Way, Failure> {
    let mut model = Model::compile(declaration)?;
    for &(name, value) in parameters {
        model.set(name, value)?;
    }
    let problem = Problem::own(model)?;
    let run = Run {
        method: MethodName::Taylor,
        tolerance: 1e-15,
        initial: x0.to_vec(),
        t_end,
        ..problem.default_run()
    };
    let mut watch = Watch {
        metadata: problem.metadata(),
        way: Way {
            passed: Vec::new(),
            end: x0.to_vec(),
        },
    };
    problem.integrate(&run, &mut watch)?;
    Ok(watch.way)
}

/// Keeps the transitions and the last point.
struct Watch {
    metadata: &'static Metadata,
    way: Way,
}

impl AnyObserver for Watch {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        self.way.end = record.x.to_vec();
        ControlFlow::Continue(())
    }

    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.way.passed.push(Passed {
            t: crossed.t,
            kind: crossed.kind,
            interface: self.metadata.interfaces[crossed.interface],
            to: self.metadata.regions[crossed.to.region].name,
            x: crossed.x.clone(),
        });
        ControlFlow::Continue(())
    }
}

/// What happened and where, as in `slid x`.
fn story(way: &Way) -> Vec<String> {
    let word = |kind| match kind {
        TransitionKind::BeganToSlide => "slides on",
        TransitionKind::LeftSlide => "leaves",
        TransitionKind::Jumped => "jumps at",
        _ => "crosses",
    };
    let passed = way.passed.iter();
    let told = passed.map(|one| format!("{} {}", word(one.kind), one.interface));
    told.collect()
}

/// Asserts that two numbers agree to some part of 1 + |expected|.
#[track_caller]
fn assert_close(value: f64, expected: f64, part: f64) {
    let error = (value - expected).abs() / (1.0 + expected.abs());
    assert!(error <= part, "{value} instead of {expected}: {error:e}");
}
