//! `pws conserve`

use std::io::Write;
use std::path::PathBuf;

use dmm_problems::conservation::{self, Conservation};
use dmm_problems::problem::{Problem, Run};
use dmm_problems::registry;

use crate::failure::Failure;
use crate::input;
use crate::output::{self, Csv, Table};
use crate::progress;
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
    /// Directory of the results.
    #[arg(long, default_value = "output")]
    out: PathBuf,
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
    output::directory(&arguments.out)?;
    let mut csv = Csv::create(
        arguments.out.join("conservation.csv"),
        [
            "problem",
            "steps",
            "transitions",
            "ulps_corrected",
            "level_error_corrected",
            "relative_drift_uncorrected",
            "level_error_uncorrected",
        ],
    )?;
    let mut table = Table::new(
        1,
        [
            "problem",
            "steps",
            "transitions",
            "max |ψ−ψ_ref| (ulp)",
            "level error",
            "uncorrected: drift",
            "level error",
        ],
    );
    let mut stopped = None;
    for problem in &problems {
        let row = match row(problem, arguments) {
            Ok(row) => row,
            Err(Failure::Stopped(reason)) => {
                // the others go on
                stopped.get_or_insert(format!("{}: {reason}", problem.description().name));
                continue;
            }
            Err(failure) => return Err(failure),
        };
        let (kept, bare) = row;
        let steps = kept.statistics.steps.to_string();
        let transitions = kept.statistics.transitions.to_string();
        let name = problem.description().name.to_owned();
        let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
        csv.row([
            name.clone(),
            steps.clone(),
            transitions.clone(),
            kept.ulps.to_string(),
            number(kept.level_error),
            bare.relative().to_string(),
            number(bare.level_error),
        ])?;
        let short =
            |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1e}"));
        table.row([
            name,
            steps,
            transitions,
            format!("{:.2}", kept.ulps),
            short(kept.level_error),
            format!("{:.1e}", bare.relative()),
            short(bare.level_error),
        ]);
    }
    table.print()?;
    writeln!(
        std::io::stdout(),
        "drift: max |ψ−ψ_ref| within segments over the size of ψ's terms; level error: max \
         |ψ_ref − exact level| where it is known"
    )?;
    output::announce(&[csv.finish()?])?;
    match stopped {
        Some(reason) => Err(Failure::Stopped(reason)),
        None => Ok(()),
    }
}

/// With and without the correction of the level.
fn row(problem: &Problem, arguments: &Arguments) -> Result<(Conservation, Conservation), Failure> {
    let run = arguments.scheme.applied(Run {
        step_size: DEFAULT_STEP_SIZE,
        ..problem.default_run()
    })?;
    let t_end = run.step_size * arguments.steps as f64;
    let run = Run {
        t_end: problem
            .description()
            .longest
            .map_or(t_end, |longest| t_end.min(longest)),
        ..run
    };
    let bare = Run {
        level_correction: false,
        ..run.clone()
    };
    let bar = progress::bar((2.0 * run.t_end) as u64, 2.0 * arguments.steps as f64);
    bar.set_message(problem.description().name);
    let kept = conservation::measure(problem, &run, &mut |t| bar.set_position(t as u64))?;
    let offset = run.t_end;
    let bare = conservation::measure(problem, &bare, &mut |t| {
        bar.set_position((offset + t) as u64)
    })?;
    bar.finish_and_clear();
    Ok((kept, bare))
}
