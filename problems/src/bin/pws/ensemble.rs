//! `pws ensemble PROBLEM`: from many initial states and parameters to where they end.

mod members;

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use dmm_problems::method::Method;
use dmm_problems::problem::{Arrival, Crew, Fate, Problem, Run, Start};
use indicatif::ProgressBar;

use crate::failure::Failure;
use crate::input;
use crate::output::{self, Csv};
use crate::progress;
use crate::scheme::{self, SchemeOptions};
use members::{Members, Row};

/// What to integrate.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Name of the problem (see `pws list`).
    problem: String,
    #[command(flatten)]
    scheme: SchemeOptions,
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
    /// The file of results [default: output/PROBLEM/ensemble.csv].
    #[arg(long)]
    out: Option<PathBuf>,
    /// Threads [default: one for each core].
    #[arg(long, value_parser = input::count)]
    threads: Option<u64>,
    /// Integrate one trajectory at a time in each thread, not several in a register.
    #[arg(long)]
    no_lanes: bool,
    /// Measure instead: in a register against one at a time, all cores against one.
    #[arg(long, conflicts_with_all = ["threads", "no_lanes", "out"])]
    bench: bool,
}

/// Integrates, writes, summarises.
pub(crate) fn ensemble(arguments: &Arguments) -> Result<(), Failure> {
    let problem = input::problem(&arguments.problem, &[])?;
    let problem = &*problem;
    let run = arguments.scheme.applied(problem.default_run())?;
    let known = Method::OF_ENSEMBLES;
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
            .join(problem.card().name)
            .join("ensemble.csv")
    };
    let out = arguments.out.clone().unwrap_or_else(default_out);
    if let Some(directory) = out.parent() {
        output::directory(directory)?;
    }
    let crew = Crew {
        threads: arguments
            .threads
            .and_then(|count| usize::try_from(count).ok()),
        lanes: !arguments.no_lanes,
    };
    let mut results = Results::create(problem, out, members.count)?;
    let start = Instant::now();
    integrate(problem, &run, crew, members, &mut results)?;
    let seconds = start.elapsed().as_secs_f64();
    results.finish(problem, &run, seconds)
}

/// Rows that are read and not yet written; a bad one has its place among the others.
type Waiting = RefCell<VecDeque<Row>>;

/// Integrates all members that are valid, and writes all.
fn integrate(
    problem: &dyn Problem,
    run: &Run,
    crew: Crew,
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
    problem.integrate_all(run, crew, &mut starts, &mut |fate| {
        written = results.take(&waiting, Some(fate));
        match written {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        }
    });
    written?;
    results.take(&waiting, None)
}

/// The file of results.
struct Results {
    csv: Csv,
    regions: Vec<&'static str>,
    bar: ProgressBar,
    members: u64,
    failures: u64,
    steps: u64,
    transitions: u64,
    /// Numbers in the columns of a member's start and of its end.
    widths: (usize, usize),
}

impl Results {
    fn create(problem: &dyn Problem, path: PathBuf, count: Option<u64>) -> Result<Self, Failure> {
        let own = |name: &&str| (*name).to_owned();
        let states = problem.states();
        let parameters = problem.parameters();
        let mut header = vec!["member".to_owned()];
        header.extend(parameters.iter().map(|(name, _)| own(name)));
        header.extend(states.iter().map(|name| format!("{name}(0)")));
        header.extend(["t", "region"].iter().map(own));
        header.extend(states.iter().map(own));
        header.extend(["steps", "transitions", "failure"].iter().map(own));
        Ok(Self {
            csv: Csv::create(path, header)?,
            regions: problem.regions(),
            bar: progress::counter(count),
            members: 0,
            failures: 0,
            steps: 0,
            transitions: 0,
            widths: (parameters.len() + states.len(), states.len()),
        })
    }

    /// Writes the next member with its fate and the bad rows before it; without a fate those that
    /// are left.
    fn take(&mut self, waiting: &Waiting, mut fate: Option<Fate>) -> Result<(), Failure> {
        let ends_with_member = fate.is_some();
        loop {
            // the members are not borrowed while the row is written
            let next = waiting.borrow_mut().pop_front();
            let Some(row) = next else { break };
            match row {
                Err(failure) => self.write(None, None, &failure)?,
                Ok(start) => {
                    let fate = fate.take();
                    let error = fate.as_ref().and_then(|fate| fate.error.as_ref());
                    let failure = error.map(ToString::to_string).unwrap_or_default();
                    let arrival = fate.as_ref().and_then(|fate| fate.arrival.as_ref());
                    self.write(Some(&start), arrival, &failure)?;
                    if ends_with_member {
                        break;
                    }
                }
            }
        }
        Ok(())
    }

    fn write(
        &mut self,
        start: Option<&Start>,
        arrival: Option<&Arrival>,
        failure: &str,
    ) -> Result<(), Failure> {
        let mut fields = vec![self.members.to_string()];
        match start {
            Some(Start {
                parameters,
                initial,
            }) => fields.extend(parameters.iter().chain(initial).map(f64::to_string)),
            None => fields.extend((0..self.widths.0).map(|_| String::new())),
        }
        match arrival {
            Some(arrival) => {
                let region = self
                    .regions
                    .get(arrival.region)
                    .copied()
                    .unwrap_or_default();
                fields.extend([arrival.t.to_string(), region.to_owned()]);
                fields.extend(arrival.x.iter().map(f64::to_string));
                let counts = arrival.statistics;
                fields.extend([counts.steps, counts.transitions].map(|count| count.to_string()));
                self.steps += counts.steps;
                self.transitions += counts.transitions;
            }
            None => fields.extend((0..self.widths.1 + 4).map(|_| String::new())),
        }
        fields.push(failure.to_owned());
        self.members += 1;
        self.failures += u64::from(!failure.is_empty());
        self.bar.inc(1);
        self.csv.row(fields)
    }

    fn finish(self, problem: &dyn Problem, run: &Run, seconds: f64) -> Result<(), Failure> {
        self.bar.finish_and_clear();
        let path = self.csv.finish()?;
        let mut out = std::io::stdout().lock();
        writeln!(out, "{}: {}", problem.card().name, problem.card().title)?;
        let members = self.members;
        writeln!(
            out,
            "{members} trajectories until t = {} by {}: {} steps, {} transitions",
            output::number(run.t_end),
            scheme::describe(run),
            self.steps,
            self.transitions
        )?;
        writeln!(out, "{:.3e} trajectories/s", members as f64 / seconds)?;
        drop(out);
        output::announce(&[path])?;
        match self.failures {
            0 => Ok(()),
            failures => Err(Failure::Stopped(format!(
                "{failures} of {members} trajectories failed: see the column `failure`"
            ))),
        }
    }
}

/// Runs of each kind that are compared.
const ROUNDS: usize = 5;

/// Trajectories per second in lanes and not, on one core and on all.
fn bench(problem: &dyn Problem, run: &Run, members: Members) -> Result<(), Failure> {
    let starts: Vec<Start> = members.rows.flatten().collect();
    let crew = |threads, lanes| Crew { threads, lanes };
    let kinds = [
        ("one core, one at a time", crew(Some(1), false)),
        ("one core, in lanes", crew(Some(1), true)),
        ("all cores, in lanes", crew(None, true)),
    ];
    // interleaved, so that a slow moment is everybody's
    let mut fastest = [f64::INFINITY; 3];
    for _ in 0..ROUNDS {
        for ((_, crew), fastest) in kinds.iter().zip(&mut fastest) {
            let start = Instant::now();
            let mut members = starts.iter().cloned();
            problem.integrate_all(run, *crew, &mut members, &mut |_| ControlFlow::Continue(()));
            *fastest = fastest.min(start.elapsed().as_secs_f64());
        }
    }
    let mut table = output::Table::new(1, ["", "trajectories/s", "ratio"]);
    let [alone, ..] = fastest;
    for ((name, _), seconds) in kinds.iter().zip(fastest) {
        let rate = format!("{:.0}", starts.len() as f64 / seconds);
        table.row([(*name).to_owned(), rate, format!("{:.2}", alone / seconds)]);
    }
    table.print()?;
    Ok(())
}
