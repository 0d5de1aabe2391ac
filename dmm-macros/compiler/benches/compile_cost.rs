//! What declarations cost: the operations of the emitted functions, and the time of every
//! stage of the compiler, for every `pws!` in some Rust sources.
//!
//! ```text
//! cargo bench --profile dev -p dmm-compiler --bench compile_cost -- [FILE | DIRECTORY]...
//! ```
//!
//! Cargo runs it in the folder of the package, which relative paths begin at. Without arguments,
//! the problems of this repository, and then `cargo check` of them with everything that they depend
//! on already built. Users' macros run unoptimised, even in release builds, so the profile `dev` is
//! the one to measure.
//!
//! Operations are those of one evaluation of f^τ, and of f^τ with ∂f^τ/∂x₁ (for a minimal-norm
//! field, of everything that the runtime's projection is given), in the region that takes the
//! most: as trees, with equal expressions shared, and as emitted. A sum, product or sign is one
//! operation of weight 1, a division one of weight 4, a square root 6, an elementary function
//! 20; what depends on parameters alone is computed once a flow and not counted.

mod arguments;
mod declarations;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use arguments::arguments;
use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::program::optimise::Count;
use dmm_compiler::program::{Function, Functions, Program, Quantity};
use dmm_compiler::{check, emit, proofs, scheme, syntax};
use proc_macro2::TokenStream;
use quote::quote;

/// Each declaration is compiled this often; the fastest run counts.
const RUNS: usize = 5;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let mut paths: Vec<PathBuf> = arguments().map(PathBuf::from).collect();
    let own_problems = paths.is_empty();
    if own_problems {
        paths.push(declarations::problems());
    }
    let mut costs = Vec::new();
    for path in paths {
        for (file, declaration) in declarations::declarations(&path)? {
            let runs = (0..RUNS)
                .map(|_| measure(declaration.clone()))
                .collect::<Result<Vec<Cost>, String>>()
                .map_err(|error| format!("{}: {error}", file.display()))?;
            costs.extend(runs.into_iter().min_by_key(Cost::total));
        }
    }
    print_operations(&costs);
    print_times(&costs);
    if own_problems {
        let problems = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../problems");
        cargo_check(&problems)?;
        let start = Instant::now();
        fs::File::options()
            .append(true)
            .open(problems.join("src/lib.rs"))?
            .set_modified(std::time::SystemTime::now())?;
        cargo_check(&problems)?;
        println!(
            "cargo check of the problems, dependencies built: {:.1?}",
            start.elapsed()
        );
    }
    Ok(())
}

/// `cargo check` of the package at `directory`.
fn cargo_check(directory: &Path) -> Result<(), Box<dyn Error>> {
    let status = std::process::Command::new(env!("CARGO"))
        .args(["check", "--quiet", "--lib"])
        .current_dir(directory)
        .status()?;
    status
        .success()
        .then_some(())
        .ok_or_else(|| "cargo check failed".into())
}

/// The stages of the compiler.
const STAGES: [&str; 6] = ["parse", "check", "prove", "derive", "optimise", "emit"];

/// What one declaration costs.
struct Cost {
    name: String,
    states: usize,
    conserved: usize,
    nodes: usize,
    /// Of f^τ, and of f^τ with its Jacobian.
    operations: [Operation; 2],
    stages: [Duration; STAGES.len()],
}

/// The operations of a function: as trees, shared, optimised.
#[derive(Clone, Copy, Default)]
struct Operation {
    tree: Count,
    shared: Count,
    optimised: Count,
}

impl Operation {
    /// Those of the function for `quantity` in the region that takes the most.
    fn dearest(programs: [&Program<'_>; 2], quantity: Quantity) -> Self {
        let of = |functions: &Functions, count: fn(&Functions, &Function) -> Count| {
            let function = functions.get(quantity);
            function.map_or_else(Count::default, |function| count(functions, function))
        };
        let [written, optimised] = programs.map(|program| program.dynamics.iter());
        written
            .zip(optimised)
            .map(|(written, optimised)| Self {
                tree: of(&written.functions, Functions::count_as_tree),
                shared: of(&written.functions, Functions::count),
                optimised: of(&optimised.functions, Functions::count),
            })
            .max_by_key(|operation| operation.shared.weighted)
            .unwrap_or_default()
    }
}

impl Cost {
    fn total(&self) -> Duration {
        self.stages.iter().sum()
    }
}

/// The table of operations.
fn print_operations(costs: &[Cost]) {
    let groups = ["f^τ", "f^τ, weighted", "f^τ and ∂f^τ/∂x₁", "both, weighted"];
    print!("{:<24}", "operations");
    for group in groups {
        print!(" | {group:^22}");
    }
    print!("\n{:<24}", "");
    for _ in groups {
        print!(" | {:>8} {:>6} {:>6}", "tree", "shared", "now");
    }
    println!();
    for cost in costs {
        print!("{:<24}", cost.name);
        for Operation {
            tree,
            shared,
            optimised,
        } in cost.operations
        {
            let counts = [tree, shared, optimised];
            let [a, b, c] = counts.map(|count| count.operations);
            print!(" | {a:>8} {b:>6} {c:>6}");
            let [a, b, c] = counts.map(|count| count.weighted);
            print!(" | {a:>8} {b:>6} {c:>6}");
        }
        println!();
    }
    println!();
}

/// The table of times.
fn print_times(costs: &[Cost]) {
    print!(
        "{:<24} {:>6} {:>4} {:>6}",
        "time [ms]", "states", "ψ", "nodes"
    );
    for stage in STAGES.iter().chain(&["total"]) {
        print!(" {stage:>8}");
    }
    println!();
    for cost in costs {
        let Cost {
            name,
            states,
            conserved,
            nodes,
            stages,
            ..
        } = cost;
        print!("{name:<24} {states:>6} {conserved:>4} {nodes:>6}");
        for time in stages.iter().chain([&cost.total()]) {
            print!(" {:>8.2}", 1e3 * time.as_secs_f64());
        }
        println!();
    }
    println!("the fastest of {RUNS} runs");
}

fn measure(input: TokenStream) -> Result<Cost, String> {
    let mut diagnostics = Diagnostics::new();
    let mut clock = Clock::new();
    let declaration = syntax::parse(input, &mut diagnostics);
    clock.lap(0);
    let model = declaration
        .filter(|_| diagnostics.is_empty())
        .and_then(|declaration| check::resolve(declaration, &mut diagnostics));
    clock.lap(1);
    let proved = model.and_then(|model| proofs::prove(model, &mut diagnostics));
    clock.lap(2);
    let scheme = proved.and_then(|proved| scheme::derive(proved, &mut diagnostics));
    clock.lap(3);
    let program = scheme.as_ref().map(Program::new);
    clock.lap(4);
    let tokens = program
        .as_ref()
        .map(|program| emit::rust(program, &quote!(::dmm_runtime)));
    clock.lap(5);
    match (&scheme, &program, tokens) {
        (Some(scheme), Some(program), Some(_)) => Ok(Cost {
            operations: [Quantity::DiscreteVectorField, Quantity::Linearised].map(|quantity| {
                Operation::dearest([&Program::as_written(scheme), program], quantity)
            }),
            name: scheme.model.name.to_string(),
            states: scheme.model.states.len(),
            conserved: scheme
                .regions
                .iter()
                .map(|region| region.proved.multiplier.len())
                .sum(),
            nodes: scheme.dag().len(),
            stages: clock.laps,
        }),
        _ => Err(diagnostics.messages().join("\n")),
    }
}

/// Times of stages that follow each other.
struct Clock {
    last: Instant,
    laps: [Duration; STAGES.len()],
}

impl Clock {
    fn new() -> Self {
        Self {
            last: Instant::now(),
            laps: [Duration::ZERO; STAGES.len()],
        }
    }

    fn lap(&mut self, stage: usize) {
        let now = Instant::now();
        self.laps[stage] = now - self.last;
        self.last = now;
    }
}
