//! `pws run PROBLEM`, `pws run FILE`

mod itinerary;
mod recorder;
mod transitions;

use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use dmm_picture::{Format, Picture};
use dmm_problems::problem::{Problem, Run};
use dmm_runtime::Statistics;
use serde_json::json;

use crate::directory::{self, Directory, DirectoryOptions};
use crate::failure::Failure;
use crate::input::{self, FormatOption};
use crate::interrupt;
use crate::output;
use crate::portrait::{self, Coordinate, Plane, Trajectory};
use crate::scheme::{self, SchemeOptions};
use crate::series;
use recorder::{Finished, Recorder};

/// What to integrate.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Name of the problem (see `pws list`), or a file that declares a system.
    #[arg(value_name = "PROBLEM|FILE")]
    problem: String,
    #[command(flatten)]
    scheme: SchemeOptions,
    /// Leave the level of the conserved quantities to rounding.
    #[arg(long)]
    no_level_correction: bool,
    /// End time [default: the problem's].
    #[arg(long, allow_negative_numbers = true)]
    end: Option<f64>,
    /// A parameter; may be repeated.
    #[arg(long = "param", value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    /// The initial state; states not named keep the problem's value.
    #[arg(long, value_name = "x=1,q[0]=2", allow_hyphen_values = true)]
    initial: Option<String>,
    /// Write every n-th step, or output, to the file of points; transitions and both ends
    /// always.
    #[arg(long, default_value_t = 1, value_parser = input::count)]
    every: u64,
    /// The two states of the phase portrait, or `t` and a state [default: the first two, or `t` and
    /// the only one].
    #[arg(long, value_name = "x,y")]
    plane: Option<String>,
    #[command(flatten)]
    directory: DirectoryOptions,
    /// How pictures are stored.
    #[arg(long, value_enum, default_value = "svg")]
    format: FormatOption,
}

/// Integrates, writes, summarises.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let problem = input::problem(&arguments.problem, &arguments.parameters)?;
    let problem = &problem;
    let run = arguments.scheme.applied(problem.default_run())?;
    let run = Run {
        initial: input::initial(problem, arguments.initial.as_deref())?,
        t_end: arguments.end.unwrap_or(run.t_end),
        level_correction: !arguments.no_level_correction,
        ..run
    };
    let plane = plane(problem, arguments.plane.as_deref())?;
    check(problem, &run)?;
    let run = scheme::with_even_output(run)?;
    let mut request = directory::of_run(problem, &run);
    directory::add(&mut request, json!({ "every": arguments.every }));
    let default = Path::new("output").join(problem.description().name);
    let mut out = arguments
        .directory
        .open(default.join("run"), &FILES, request)?;
    interrupt::listen()?;
    let mut recorder = Recorder::create(problem, &run, arguments.every, &out)?;
    let start = Instant::now();
    let result = problem.integrate(&run, &mut recorder);
    let elapsed = start.elapsed();
    // whatever happened, what was computed is stored, drawn and told
    let mut finished = recorder.finish();
    finished.files.drain(..).for_each(|file| out.add(file));
    let drawn = pictures(problem, &finished, plane, &mut out, arguments.format.into());
    let told = summarise(problem, &run, &finished);
    let outcome = match (result, finished.failure.take()) {
        (_, Some(failure)) => Err(failure),
        (Err(error), None) => Err(error.into()),
        (Ok(_), None) if finished.is_interrupted => {
            let t = output::number(finished.t);
            Err(Failure::Interrupted(format!("at t = {t}")))
        }
        (Ok(finish), None) => drawn
            .and(told)
            .and_then(|()| time(problem, &run, &finish.statistics, elapsed)),
    };
    out.finish(&outcome)?;
    outcome
}

/// What the files of a run are called.
const FILES: [&str; 5] = ["points", "transitions", "phase", "series", "conservation"];

/// Refuses what the runtime would refuse, before any file is touched.
fn check(problem: &Problem, run: &Run) -> Result<(), Failure> {
    let start = Run {
        t_end: 0.0,
        ..run.clone()
    };
    if !(run.t_end.is_finite() && run.t_end > 0.0) {
        return Err(Failure::Request(format!(
            "end time: {} (must be positive and finite)",
            output::number(run.t_end)
        )));
    }
    problem.integrate_silently(&start)?;
    Ok(())
}

fn plane(problem: &Problem, given: Option<&str>) -> Result<Plane, Failure> {
    let Some(text) = given else {
        return Ok(match problem.states() {
            [_] => (Coordinate::Time, Coordinate::State(0)),
            _ => (Coordinate::State(0), Coordinate::State(1)),
        });
    };
    let coordinate = |name: &str| match name.trim() {
        "t" => Ok(Coordinate::Time),
        name => input::state(problem, name).map(Coordinate::State),
    };
    match text.split_once(',') {
        Some((x, y)) => Ok((coordinate(x)?, coordinate(y)?)),
        None => Err(Failure::Request(format!("`{text}` is not of the form x,y"))),
    }
}

fn pictures(
    problem: &Problem,
    finished: &Finished<'_>,
    plane: Plane,
    out: &mut Directory,
    format: Format,
) -> Result<(), Failure> {
    let kept = &finished.kept;
    let shown = match kept.last() {
        Some(last) if last.t < finished.t * 0.99 => format!(" (until t = {:.3})", last.t),
        _ => String::new(),
    };
    let title = problem.description().title;
    let trajectory = Trajectory {
        points: kept,
        modes: &finished.modes,
        marks: &finished.marks,
        ends_there: shown.is_empty(),
    };
    let what = match plane {
        (Coordinate::State(_), Coordinate::State(_)) => "phase portrait",
        _ => "trajectory",
    };
    let phase = portrait::phase(problem, &trajectory, plane, &format!("{what}{shown}"));
    let series = series::time_series(problem, kept, &format!("time series{shown}"));
    let errors = series::errors(&finished.errors, "ψ − ψ at entry", "conservation error");
    let wide = |panels| Picture {
        panel_size: (760.0, 330.0),
        columns: 1,
        ..Picture::row(title, panels)
    };
    let square = |panel| Picture {
        panel_size: (560.0, 500.0),
        ..Picture::row(title, vec![panel])
    };
    let mut drawn = vec![
        out.picture("phase", &square(phase), format),
        out.picture("series", &wide(series), format),
    ];
    if !finished.errors.is_empty() {
        drawn.push(out.picture("conservation", &wide(vec![errors]), format));
    }
    // one that cannot be drawn does not keep the others from it
    drawn.into_iter().collect()
}

/// What a run was and where it got to.
fn summarise(problem: &Problem, run: &Run, finished: &Finished<'_>) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{}: {}",
        problem.description().name,
        problem.description().title
    )?;
    writeln!(
        out,
        "reached t = {} by {}",
        output::number(finished.t),
        scheme::describe(run)
    )?;
    if !finished.errors.is_empty() {
        writeln!(
            out,
            "max |ψ − ψ_ref| within segments: {:.2e} ({:.2} ulp of the size of ψ's terms)",
            finished.worst.0, finished.worst.1
        )?;
    }
    finished.itinerary.print()?;
    Ok(())
}

/// About how long the run that is timed takes.
const TIMED: Duration = Duration::from_millis(50);
/// A shorter run is repeated: what is new to the processor is slow.
const LEAST_TIMED: Duration = Duration::from_millis(20);

/// Times the same run, or its beginning, without an observer.
fn time(
    problem: &Problem,
    run: &Run,
    statistics: &Statistics,
    observed: Duration,
) -> Result<(), Failure> {
    let share = TIMED.as_secs_f64() / observed.as_secs_f64();
    let timed = Run {
        t_end: run.t_end * share.min(1.0),
        ..run.clone()
    };
    let start = Instant::now();
    let mut steps = 0;
    while steps == 0 || start.elapsed() < LEAST_TIMED {
        steps += problem.integrate_silently(&timed)?.statistics.steps.max(1);
    }
    let nanoseconds = start.elapsed().as_secs_f64() * 1e9 / steps as f64;
    let per_step = statistics.newton_iterations as f64 / statistics.steps.max(1) as f64;
    writeln!(
        std::io::stdout(),
        "{} steps, {nanoseconds:.1} ns a step, {per_step:.2} Newton iterations a step",
        statistics.steps
    )?;
    Ok(())
}
