//! What it costs to compile a system at run time: its time until it can be integrated, and the time
//! of a step as a multiple of that of generated code, in turn; and how many times as fast its ensembles
//! are in lanes as one trajectory at a time, on one thread.
//!
//! ```sh
//! cargo run --release -p dmm-problems --features compiled --example tape
//! ```

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use dmm_problems::problem::Description;
use dmm_problems::registry::{SystemVisitor, visit_systems};
use dmm_runtime::dynamic::{
    AnySystem, Erased, InitialValue, MethodChoice, MethodVisitor, Parallelism, Start,
};
use dmm_runtime::{Best, Model, Symmetric, System, Taylor};

/// The methods that are measured.
#[derive(Clone, Copy)]
enum Choice {
    Symmetric(f64),
    Taylor(f64),
    Best(f64),
}

impl MethodChoice for Choice {
    fn visit<V: MethodVisitor>(&self, visitor: V) -> V::Output {
        match *self {
            Self::Symmetric(step_size) => visitor.visit(Symmetric::step_size(step_size)),
            Self::Taylor(tolerance) => visitor.visit(Taylor::tolerance(tolerance)),
            Self::Best(tolerance) => visitor.visit(Best::tolerance(tolerance)),
        }
    }
}

/// Runs of each, in turn.
const ROUNDS: usize = 9;
/// Of a run of generated code, so that it is long enough to be measured.
const LEAST: Duration = Duration::from_millis(5);
/// Trajectories of an ensemble.
const MEMBERS: usize = 64;

/// Prints a row for each system.
struct Rows;

impl SystemVisitor for Rows {
    fn visit<Sys: System<N> + Default, const N: usize>(
        &mut self,
        description: &'static Description,
    ) {
        let compiled: Box<dyn AnySystem<Choice>> = Erased::boxed(Sys::default());
        let start = Instant::now();
        let model = Model::compile(compiled.declaration());
        let time = start.elapsed();
        let Some(Ok(model)) = model.ok().map(Model::into_any) else {
            println!("{:24} is not compiled", description.name);
            return;
        };
        let methods = [
            Choice::Symmetric(description.step_size),
            Choice::Taylor(1e-6),
            Choice::Taylor(1e-12),
            Choice::Best(1e-12),
        ];
        let ratios =
            methods.map(
                |method| match ratio([&*compiled, &*model], method, description) {
                    Some(ratio) => format!("{ratio:.1}"),
                    None => "-".to_owned(),
                },
            );
        let [symmetric, coarse, fine, best] = ratios;
        let lanes = gain_of_lanes(&*model, description);
        let time = time.as_secs_f64() * 1e3;
        let name = description.name;
        println!(
            "{name:24} {time:8.1} {symmetric:>10} {coarse:>10} {fine:>10} {best:>10} {lanes:>7.1}"
        );
    }
}

/// The median of the times of a model as multiples of those of generated code.
fn ratio(
    systems: [&dyn AnySystem<Choice>; 2],
    method: Choice,
    description: &Description,
) -> Option<f64> {
    let mut from = InitialValue::new(description.initial.to_vec(), 1.0);
    let time = |system: &dyn AnySystem<Choice>, from: &InitialValue| {
        let start = Instant::now();
        system.integrate_silently(&method, from).ok()?;
        Some(start.elapsed())
    };
    while time(systems[0], &from)? < LEAST {
        let longest = description.longest.unwrap_or(f64::INFINITY);
        if from.t_end >= longest {
            break;
        }
        from.t_end = (2.0 * from.t_end).min(longest);
    }
    let mut ratios = Vec::new();
    for _ in 0..ROUNDS {
        let [compiled, model] = systems.map(|system| time(system, &from));
        ratios.push(model?.as_secs_f64() / compiled?.as_secs_f64());
    }
    Some(median(ratios))
}

fn median(mut ratios: Vec<f64>) -> f64 {
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() / 2]
}

/// The median of the times of an ensemble by one trajectory at a time as multiples of those in lanes.
fn gain_of_lanes(model: &dyn AnySystem<Choice>, description: &Description) -> f64 {
    let start = Start {
        parameters: model.parameters(),
        initial: description.initial.to_vec(),
    };
    let time = |lanes| {
        let parallelism = Parallelism {
            threads: Some(1),
            lanes,
        };
        let mut starts = std::iter::repeat_n(start.clone(), MEMBERS);
        let start = Instant::now();
        model.integrate_all(
            &Choice::Taylor(1e-12),
            description.t_end,
            parallelism,
            &mut starts,
            &mut |_| ControlFlow::Continue(()),
        );
        start.elapsed().as_secs_f64()
    };
    median((0..ROUNDS).map(|_| time(false) / time(true)).collect())
}

fn main() {
    println!("time of a model as a multiple of that of generated code; ms until it is compiled\n");
    println!(
        "{:24} {:>8} {:>10} {:>10} {:>10} {:>10} {:>7}",
        "problem", "ms", "symmetric", "taylor-6", "taylor-12", "best-12", "lanes"
    );
    visit_systems(&mut Rows);
}
