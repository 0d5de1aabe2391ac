//! Solutions that slide on interfaces: friction, relays, thresholds, and their intersections.

mod chains;
mod codimension;
mod friction;
mod rules;

use dmm_runtime::{Integrator, Model, ModelVisitor, System, Taylor, TransitionKind};

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

/// A model from (0, x₀) until an end time by `Taylor`, with parameters changed.
fn taylor(
    declaration: &str,
    parameters: &[(&str, f64)],
    x0: &[f64],
    t_end: f64,
) -> Result<Way, Failure> {
    struct Run<'a>(&'a [f64], f64);

    impl ModelVisitor for Run<'_> {
        type Output = Result<Way, Failure>;

        fn visit<Sys: System<N>, const N: usize>(self, system: Sys) -> Self::Output {
            let Self(x0, t_end) = self;
            let run = Integrator::new(&system, Taylor::tolerance(1e-15)).initial(0.0, x0);
            let run = run.run_until(t_end)?;
            let metadata = system.metadata();
            let passed = run.transitions().iter().map(|one| Passed {
                t: one.t,
                kind: one.kind,
                interface: metadata.interfaces[one.interface],
                to: system.of_region(one.to).name,
                x: one.x.as_slice()[..x0.len()].to_vec(),
            });
            let end = run.last().ok_or("no point")?;
            Ok(Way {
                passed: passed.collect(),
                end: end.x.as_slice()[..x0.len()].to_vec(),
            })
        }
    }

    let mut model = Model::compile(declaration)?;
    for &(name, value) in parameters {
        model.set(name, value)?;
    }
    model.visit(Run(x0, t_end))?
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
