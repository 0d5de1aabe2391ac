//! Instructions of one step of every problem, counted by callgrind and compared with the
//! record in `instructions.csv`: a slowdown shows on any machine, however busy.
//!
//! ```sh
//! cargo run --release -p dmm-problems --features compiled --example instructions -- --check [PROBLEM…]
//! cargo run --release -p dmm-problems --features compiled --example instructions -- --record
//! ```
//!
//! The program runs itself under `valgrind --tool=callgrind` from a problem's initial value to
//! two end times, and divides the difference of the counts by that of the steps: what is left
//! is the cost of a step with its share of the transitions, without that of starting. Of an ensemble
//! in lanes, all of whose members are alike, it is that of one member.
//!
//! Counts depend on the compiler, whose version the record names, and on the platform's
//! mathematical library, which is told to use no instructions that not every machine has.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use clap::Parser;
use dmm_problems::method::{Control, MethodName};
use dmm_problems::problem::{Parallelism, Problem, Run};
use dmm_problems::registry;
use serde::{Deserialize, Serialize};

/// What is measured: a scheme and, if it takes one, its tolerance; by how many trajectories at once.
const MEASURED: [(MethodName, Option<f64>, usize); 5] = [
    (MethodName::Symmetric, None, 1),
    (MethodName::Taylor, Some(1e-6), 1),
    (MethodName::Taylor, Some(1e-12), 1),
    (MethodName::Best, Some(1e-12), 1),
    (MethodName::Taylor, Some(1e-12), 16),
];
/// Systems of more states are not integrated in lanes.
const MOST_STATES_IN_LANES: usize = 8;
/// More instructions than recorded by this part are a slowdown.
const ALLOWED: f64 = 0.03;
/// Steps until the two end times, if there are so many.
const STEPS: [f64; 2] = [100.0, 1100.0];
/// Of systems of more than 16 states.
const STEPS_OF_LARGE: [f64; 2] = [20.0, 120.0];

#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    task: Task,
    /// Names of the problems [default: all].
    problems: Vec<String>,
}

#[derive(clap::Args)]
#[group(required = true, multiple = false)]
struct Task {
    /// Compare with the record; the exit status is 1 if a step has become slower.
    #[arg(long)]
    check: bool,
    /// Write the record.
    #[arg(long, conflicts_with = "problems")]
    record: bool,
    /// Run a problem until this time: what callgrind is started with.
    #[arg(long, hide = true, value_name = "PLACE,T")]
    until: Option<String>,
}

/// A row of the record.
#[derive(Clone, Debug, Deserialize, Serialize)]
struct Row {
    problem: String,
    scheme: String,
    /// Empty for a scheme with uniform steps.
    tolerance: Option<f64>,
    instructions_a_step: f64,
}

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match &arguments.task.until {
        Some(place) => run_until(place, &arguments.problems),
        None => measure(&arguments),
    };
    match result {
        Ok(code) => code,
        Err(error) => {
            eprintln!("instructions: {error}");
            ExitCode::from(2)
        }
    }
}

/// What runs under callgrind.
fn run_until(place: &str, problems: &[String]) -> Outcome<ExitCode> {
    let (place, t_end) = place.split_once(',').ok_or("no end time")?;
    let (name, measured) = (problems.first(), MEASURED.get(place.parse::<usize>()?));
    let (name, measured) = name.zip(measured).ok_or("nothing to run")?;
    let problem = registry::find(name)?;
    let (method, tolerance, trajectories) = *measured;
    let run = run_of(&problem, (method, tolerance), t_end.parse()?);
    if trajectories == 1 {
        problem.integrate_silently(&run)?;
    } else {
        integrate_together(&problem, &run, trajectories)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// So many trajectories from the same start, in lanes.
fn integrate_together(problem: &Problem, run: &Run, trajectories: usize) -> Outcome<()> {
    let parallelism = Parallelism {
        threads: Some(1),
        lanes: true,
    };
    let mut starts = std::iter::repeat_n(problem.default_start(), trajectories);
    let mut error = None;
    problem.integrate_all(run, parallelism, &mut starts, &mut |outcome| {
        error = error.take().or(outcome.error);
        ControlFlow::Continue(())
    });
    error.map_or(Ok(()), |error| Err(error.into()))
}

fn run_of(problem: &Problem, (method, tolerance): (MethodName, Option<f64>), t_end: f64) -> Run {
    let default = problem.default_run();
    Run {
        method,
        tolerance: tolerance.unwrap_or(default.tolerance),
        t_end,
        ..default
    }
}

fn record_path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("instructions.csv")
}

fn measure(arguments: &Arguments) -> Outcome<ExitCode> {
    if cfg!(target_feature = "avx") {
        return Err(
            "built for this processor: counts are those of a build without \
                    `-C target-cpu` and `-C target-feature`"
                .into(),
        );
    }
    let compiler = compiler()?;
    let problems = match arguments.problems.as_slice() {
        [] => registry::all(),
        names => names
            .iter()
            .map(|name| registry::find(name))
            .collect::<Result<_, _>>()?,
    };
    let recorded = if arguments.task.record {
        Vec::new()
    } else {
        read_record(&compiler)?
    };
    println!(
        "{:<24} {:<16} {:>9} {:>10} {:>10} {:>7}",
        "problem", "scheme", "tolerance", "recorded", "now", "ratio"
    );
    let mut rows = Vec::new();
    let mut slower = 0;
    for problem in &problems {
        for (place, (.., trajectories)) in MEASURED.iter().enumerate() {
            if *trajectories > 1 && problem.states().len() > MOST_STATES_IN_LANES {
                continue;
            }
            let row = row(problem, place)?;
            slower += u32::from(print(&row, &recorded));
            rows.push(row);
        }
    }
    if arguments.task.record {
        write_record(&compiler, &rows)?;
        println!("wrote {}", record_path().display());
    }
    if slower > 0 {
        eprintln!(
            "instructions: {slower} steps take over {:.0} % more than recorded",
            100.0 * ALLOWED
        );
    }
    Ok(ExitCode::from(u8::from(slower > 0)))
}

/// Prints a row beside the recorded one; whether it is slower.
fn print(row: &Row, recorded: &[Row]) -> bool {
    let same = |other: &&Row| {
        (&other.problem, &other.scheme) == (&row.problem, &row.scheme)
            && other.tolerance == row.tolerance
    };
    let before = recorded
        .iter()
        .find(same)
        .map(|row| row.instructions_a_step);
    let now = row.instructions_a_step;
    let (text, ratio) = match before {
        Some(before) => (format!("{before:.1}"), format!("{:.3}", now / before)),
        None => ("-".to_owned(), "-".to_owned()),
    };
    let is_slower = before.is_some_and(|before| now > before * (1.0 + ALLOWED));
    println!(
        "{:<24} {:<16} {:>9} {text:>10} {now:>10.1} {ratio:>7}{}",
        row.problem,
        row.scheme,
        row.tolerance
            .map_or_else(String::new, |tolerance| format!("{tolerance:e}")),
        if is_slower { "  slower" } else { "" }
    );
    is_slower
}

/// Counts the instructions of a step.
fn row(problem: &Problem, place: usize) -> Outcome<Row> {
    let (method, tolerance, trajectories) = MEASURED[place];
    let description = problem.description();
    let whole = run_of(problem, (method, tolerance), description.t_end);
    let all = problem.integrate_silently(&whole)?.statistics.steps as f64;
    let wanted = match problem.states().len() {
        ..=16 => STEPS,
        _ => STEPS_OF_LARGE,
    };
    let shrink = (all / wanted[1]).min(1.0);
    let [first, second] = wanted.map(|steps| {
        let t_end = description.t_end * shrink * steps / all;
        let run = run_of(problem, (method, tolerance), t_end);
        let steps = problem.integrate_silently(&run)?.statistics.steps;
        let instructions = instructions(description.name, place, t_end)?;
        Outcome::Ok((steps as f64, instructions))
    });
    let ((steps, instructions), (more_steps, more_instructions)) = (first?, second?);
    let more_steps = (more_steps - steps) * trajectories as f64;
    let a_step = (more_instructions - instructions) / more_steps;
    Ok(Row {
        problem: description.name.to_owned(),
        scheme: match trajectories {
            1 => method.name().to_owned(),
            _ => format!("{} in lanes", method.name()),
        },
        tolerance: match method.control() {
            Control::Tolerance => tolerance,
            Control::StepSize { .. } => None,
        },
        instructions_a_step: (a_step * 10.0).round() / 10.0,
    })
}

/// What the mathematical library is not to use, so that every machine takes the same path.
const PLAIN: &str = "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F,-AVX512VL";

/// The instructions of a run.
fn instructions(problem: &str, place: usize, t_end: f64) -> Outcome<f64> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe()?)
        .args(["--until", &format!("{place},{t_end:?}"), problem])
        .env("GLIBC_TUNABLES", PLAIN)
        .output()
        .map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => {
                "valgrind is not installed: it is Debian's package `valgrind`".into()
            }
            _ => format!("cannot start valgrind: {error}"),
        })?;
    let said = String::from_utf8_lossy(&output.stderr);
    let count = said
        .lines()
        .find_map(|line| line.split("Collected :").nth(1));
    match count {
        Some(count) if output.status.success() => Ok(count.trim().parse()?),
        _ => Err(format!("valgrind failed on {problem}:\n{said}").into()),
    }
}

/// The version of the compiler.
fn compiler() -> Outcome<String> {
    let output = Command::new("rustc").arg("--version").output()?;
    let version = String::from_utf8(output.stdout)?;
    Ok(version.trim().to_owned())
}

fn read_record(compiler: &str) -> Outcome<Vec<Row>> {
    let path = record_path();
    let text = std::fs::read_to_string(&path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let by = text.lines().next().and_then(|line| line.strip_prefix("# "));
    if by != Some(compiler) {
        println!(
            "recorded with {}, this is {compiler}: some difference is the compiler's",
            by.unwrap_or("an unknown compiler")
        );
    }
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    Ok(reader.deserialize().collect::<Result<_, _>>()?)
}

fn write_record(compiler: &str, rows: &[Row]) -> Outcome<()> {
    let mut writer = csv::Writer::from_writer(format!("# {compiler}\n").into_bytes());
    for row in rows {
        writer.serialize(row)?;
    }
    std::fs::write(record_path(), writer.into_inner()?)?;
    Ok(())
}
