//! `pws conserve`

use std::io::Write;
use std::ops::ControlFlow;
use std::time::Instant;

use dmm_problems::conservation::{self, Conservation};
use dmm_problems::problem::{Problem, Run};
use dmm_problems::registry;
use serde_json::{Value, json};

use crate::directory::{self, DirectoryOptions};
use crate::failure::Failure;
use crate::input;
use crate::interrupt;
use crate::output::{self, Table};
use crate::progress::Progress;
use crate::scheme::SchemeOptions;

/// Of every problem, unless another is given.
const DEFAULT_STEP_SIZE: f64 = 1e-3;

/// What to measure.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Names of the problems, or files that declare systems [default: all].
    problems: Vec<String>,
    #[command(flatten)]
    scheme: SchemeOptions,
    /// Number of steps; a scheme that chooses its steps covers the same time.
    #[arg(long, default_value_t = 1_000_000, value_parser = input::count)]
    steps: u64,
    #[command(flatten)]
    directory: DirectoryOptions,
}

/// Measures and prints a row a problem.
pub(crate) fn conserve(arguments: &Arguments) -> Result<(), Failure> {
    let problems = match arguments.problems.as_slice() {
        [] => registry::all(),
        names => names
            .iter()
            .map(|name| input::problem(name, &[]))
            .collect::<Result<_, _>>()?,
    };
    let runs = problems.iter().map(|problem| run(problem, arguments));
    let runs = runs.collect::<Result<Vec<Run>, Failure>>()?;
    let mut out = arguments.directory.open(
        "output/conserve",
        &["conservation"],
        request(&problems, &runs),
    )?;
    interrupt::listen()?;
    let mut csv = out.csv("conservation.csv", HEADER)?;
    let mut table = Table::new(1, TITLES);
    let progress = Progress::new("");
    let weights: Vec<f64> = problems.iter().zip(&runs).map(weight).collect();
    let work: f64 = weights.iter().sum();
    let mut done = 0.0;
    let mut outcome = Ok(());
    for (number, (problem, run)) in problems.iter().zip(&runs).enumerate() {
        let name = problem.description().name;
        progress.tell(name);
        let share = weights[number] / work;
        let measured = measure(problem, run, &|part| progress.at(done + share * part));
        if interrupt::is_requested() {
            let all = problems.len();
            let text = format!("after {number} of {all} problems");
            outcome = Err(Failure::Interrupted(text));
            break;
        }
        match measured.map_err(Failure::from) {
            Ok(both) => {
                csv.row(fields(name, &both))?;
                table.row(cells(name, &both));
            }
            // the others go on
            Err(Failure::Stopped(reason)) => {
                outcome = outcome.and(Err(Failure::Stopped(format!("{name}: {reason}"))));
            }
            Err(failure) => {
                outcome = Err(failure);
                break;
            }
        }
        done += share;
    }
    progress.finish();
    table.print()?;
    writeln!(
        std::io::stdout(),
        "drift: max |ψ−ψ_ref| within segments over the size of ψ's terms; level error: max \
         |ψ_ref − exact level| where it is known"
    )?;
    out.add(csv.finish()?);
    out.finish(&outcome)?;
    outcome
}

const HEADER: [&str; 7] = [
    "problem",
    "steps",
    "transitions",
    "ulps_corrected",
    "level_error_corrected",
    "relative_drift_uncorrected",
    "level_error_uncorrected",
];
const TITLES: [&str; 7] = [
    "problem",
    "steps",
    "transitions",
    "max |ψ−ψ_ref| (ulp)",
    "level error",
    "uncorrected: drift",
    "level error",
];

/// What decides the results.
fn request(problems: &[Problem], runs: &[Run]) -> Value {
    let each = problems.iter().zip(runs);
    let each = each.map(|(problem, run)| directory::of_run(problem, run));
    json!({ "runs": each.collect::<Vec<_>>() })
}

/// The part of a run that is made to learn how long the whole takes.
const TRIAL: f64 = 1.0 / 500.0;

/// About the time of a run, in seconds.
fn weight((problem, run): (&Problem, &Run)) -> f64 {
    let trial = Run {
        t_end: run.t_end * TRIAL,
        ..run.clone()
    };
    let start = Instant::now();
    // what stops it stops the run itself, too
    let _ = problem.integrate_silently(&trial);
    start.elapsed().as_secs_f64() / TRIAL
}

/// With the correction of the level, and without.
type Both = [Conservation; 2];

fn fields(name: &str, [kept, bare]: &Both) -> [String; 7] {
    let number = |value: Option<f64>| value.map_or(String::new(), output::number);
    [
        name.to_owned(),
        kept.statistics.steps.to_string(),
        kept.statistics.transitions.to_string(),
        output::number(kept.ulps),
        number(kept.level_error),
        output::number(bare.relative()),
        number(bare.level_error),
    ]
}

fn cells(name: &str, [kept, bare]: &Both) -> [String; 7] {
    let short = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1e}"));
    [
        name.to_owned(),
        kept.statistics.steps.to_string(),
        kept.statistics.transitions.to_string(),
        format!("{:.2}", kept.ulps),
        short(kept.level_error),
        format!("{:.1e}", bare.relative()),
        short(bare.level_error),
    ]
}

/// The run of a problem.
fn run(problem: &Problem, arguments: &Arguments) -> Result<Run, Failure> {
    let run = arguments.scheme.applied(Run {
        step_size: DEFAULT_STEP_SIZE,
        ..problem.default_run()
    })?;
    let t_end = run.step_size * arguments.steps as f64;
    let longest = problem.description().longest.unwrap_or(f64::INFINITY);
    Ok(Run {
        t_end: t_end.min(longest),
        ..run
    })
}

/// Makes the run with and without the correction of the level; `progress` is told the share that is
/// done.
fn measure(
    problem: &Problem,
    run: &Run,
    progress: &dyn Fn(f64) -> ControlFlow<()>,
) -> Result<Both, dmm_runtime::Error> {
    let t_end = run.t_end;
    let bare = Run {
        level_correction: false,
        ..run.clone()
    };
    let kept = conservation::measure(problem, run, &mut |t| progress(0.5 * t / t_end))?;
    let bare = conservation::measure(problem, &bare, &mut |t| progress(0.5 + 0.5 * t / t_end))?;
    Ok([kept, bare])
}
