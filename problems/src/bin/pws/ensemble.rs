//! `pws ensemble PROBLEM`, `pws ensemble FILE`: from many initial states and parameters to where they end.

mod cells;
mod members;
#[cfg(feature = "parquet")]
mod parquet;
mod results;
mod table;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use dmm_problems::method::MethodName;
use dmm_problems::problem::{Parallelism, Problem, Run, Start};
use serde_json::json;

use crate::directory::{self, Directory};
use crate::failure::Failure;
use crate::input;
use crate::interrupt;
use crate::output;
use crate::progress::Progress;
use crate::scheme::{self, EnsembleSchemeOptions};
use members::Members;
use results::{Results, Waiting};

/// What to integrate.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Name of the problem (see `pws list`), or a file that declares a system.
    #[arg(value_name = "PROBLEM|FILE")]
    problem: String,
    #[command(flatten)]
    scheme: EnsembleSchemeOptions,
    /// Leave the level of the conserved quantities to rounding.
    #[arg(long)]
    no_level_correction: bool,
    /// End time [default: the problem's].
    #[arg(long, allow_negative_numbers = true)]
    end: Option<f64>,
    /// Values of a parameter; may be repeated.
    #[arg(long = "param", value_name = "NAME=FROM..TO:COUNT")]
    parameters: Vec<String>,
    /// Initial states; those not named keep the problem's value.
    #[arg(long, value_name = "x=-1..1:101,y=0.5", allow_hyphen_values = true)]
    initial: Option<String>,
    /// A CSV file with a member in each row, its columns named after states and parameters.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["parameters", "initial"])]
    members: Option<PathBuf>,
    /// The file of results, .csv or, with the feature `parquet`, .parquet [default:
    /// output/PROBLEM/ensemble.csv].
    #[arg(long)]
    out: Option<PathBuf>,
    /// Overwrite other results that are there. Those of the same request, as the record beside the
    /// file (`ensemble.csv.run.json`) tells it, are overwritten anyway.
    #[arg(long)]
    force: bool,
    /// Threads [default: one for each core].
    #[arg(long, value_parser = input::count)]
    threads: Option<u64>,
    /// Integrate one trajectory at a time in each thread, not several in a register.
    #[arg(long)]
    no_lanes: bool,
    /// Measure instead: in a register against one at a time, all cores against one.
    #[arg(long, conflicts_with_all = ["threads", "no_lanes", "out", "force"])]
    bench: bool,
}

/// Integrates, writes, summarises.
pub(crate) fn ensemble(arguments: &Arguments) -> Result<(), Failure> {
    let problem = input::problem(&arguments.problem, &[])?;
    let problem = &problem;
    let run = arguments.scheme.applied(problem.default_run())?;
    let known = MethodName::OF_ENSEMBLES;
    if !known.contains(&run.method) {
        let names: Vec<&str> = known.iter().map(|method| method.name()).collect();
        return Err(Failure::Request(format!(
            "ensembles are not integrated by {}, but by {}",
            scheme::describe(&run),
            names.join(", ")
        )));
    }
    let run = Run {
        t_end: arguments.end.unwrap_or(run.t_end),
        level_correction: !arguments.no_level_correction,
        ..run
    };
    let members = match &arguments.members {
        Some(path) => members::of_file(problem, path)?,
        None => {
            members::combinations(problem, arguments.initial.as_deref(), &arguments.parameters)?
        }
    };
    if arguments.bench {
        return bench(problem, &run, members);
    }
    let default_out = || {
        Path::new("output")
            .join(problem.description().name)
            .join("ensemble.csv")
    };
    let out = arguments.out.clone().unwrap_or_else(default_out);
    let (directory, file) = place(&out)?;
    let mut request = directory::of_run(problem, &run);
    let own = json!({
        "members": arguments.members,
        "parameter values": arguments.parameters,
        "initial values": arguments.initial,
    });
    directory::add(&mut request, own);
    let record = format!("{file}.run.json");
    let files = [file.to_owned()];
    let mut directory = Directory::open(directory, &record, &files, request, arguments.force)?;
    interrupt::listen()?;
    let parallelism = Parallelism {
        threads: arguments
            .threads
            .and_then(|count| usize::try_from(count).ok()),
        lanes: !arguments.no_lanes,
    };
    let mut results = Results::create(problem, out, members.count)?;
    let start = Instant::now();
    let written = integrate(problem, &run, parallelism, members, &mut results);
    let seconds = start.elapsed().as_secs_f64();
    let (file, finished) = results.finish(problem, &run, seconds)?;
    directory.add(file);
    let outcome = written.and(finished);
    directory.finish(&outcome)?;
    outcome
}

/// The directory of a file of results, and its name.
fn place(out: &Path) -> Result<(&Path, &str), Failure> {
    let refused = |why: &str| Failure::Request(format!("{}: {why}", out.display()));
    let ending = out.extension().and_then(|ending| ending.to_str());
    match ending {
        Some("csv" | "parquet") => {}
        Some(other) => {
            let text = format!("unknown ending `.{other}`; name a .csv or a .parquet file");
            return Err(refused(&text));
        }
        None => return Err(refused("has no ending; name a .csv or a .parquet file")),
    }
    let name = out.file_name().and_then(|name| name.to_str());
    let directory = out.parent().filter(|path| !path.as_os_str().is_empty());
    match name {
        Some(name) => Ok((directory.unwrap_or(Path::new(".")), name)),
        None => Err(refused("is no name of a file")),
    }
}

/// Integrates all members that are valid, and writes all.
fn integrate(
    problem: &Problem,
    run: &Run,
    parallelism: Parallelism,
    members: Members,
    results: &mut Results,
) -> Result<(), Failure> {
    let waiting = Waiting::default();
    let mut starts = members.rows.filter_map(|row| {
        let start = row.as_ref().ok().cloned();
        waiting.borrow_mut().push_back(row);
        start
    });
    let mut written = Ok(());
    problem.integrate_all(run, parallelism, &mut starts, &mut |outcome| {
        written = results.take(&waiting, Some(outcome));
        match written {
            Ok(()) => results.goes_on(),
            Err(_) => ControlFlow::Break(()),
        }
    });
    written?;
    if interrupt::is_requested() {
        return Err(Failure::Interrupted(format!(
            "after {} trajectories",
            results.members()
        )));
    }
    results.take(&waiting, None)
}

/// Runs of each kind that are compared.
const ROUNDS: usize = 5;
/// About the share of a round that comes before each kind.
const BEFORE: [f64; 3] = [0.0, 0.55, 0.85];

/// Trajectories per second in lanes and not, on one core and on all.
fn bench(problem: &Problem, run: &Run, members: Members) -> Result<(), Failure> {
    let starts: Vec<Start> = members.rows.flatten().collect();
    let parallelism = |threads, lanes| Parallelism { threads, lanes };
    let kinds = [
        ("one core, one at a time", parallelism(Some(1), false)),
        ("one core, in lanes", parallelism(Some(1), true)),
        ("all cores, in lanes", parallelism(None, true)),
    ];
    // interleaved, so that a slow moment is everybody's
    let mut fastest = [f64::INFINITY; 3];
    interrupt::listen()?;
    let progress = Progress::new(problem.description().name);
    for round in 0..ROUNDS {
        for (((_, parallelism), before), fastest) in kinds.iter().zip(BEFORE).zip(&mut fastest) {
            let share = (round as f64 + before) / ROUNDS as f64;
            if progress.at(share).is_break() {
                let text = format!("in round {} of {ROUNDS}", round + 1);
                return Err(Failure::Interrupted(text));
            }
            let start = Instant::now();
            let mut members = starts.iter().cloned();
            problem.integrate_all(run, *parallelism, &mut members, &mut |_| {
                ControlFlow::Continue(())
            });
            *fastest = fastest.min(start.elapsed().as_secs_f64());
        }
    }
    progress.finish();
    let mut table = output::Table::new(1, ["", "trajectories/s", "ratio"]);
    let [alone, ..] = fastest;
    for ((name, _), seconds) in kinds.iter().zip(fastest) {
        let rate = format!("{:.0}", starts.len() as f64 / seconds);
        table.row([(*name).to_owned(), rate, format!("{:.2}", alone / seconds)]);
    }
    table.print()?;
    Ok(())
}
