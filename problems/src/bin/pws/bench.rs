//! `pws bench`

use std::io::Write;
use std::time::Duration;

use dmm_picture::{Axis, Look, Panel, Picture, Scale, Stroke};
use dmm_problems::method::{Control, MethodName};
use dmm_problems::problem::Problem;
use dmm_problems::registry;
use dmm_problems::work_precision::{Goal, Setting, fastest};
use serde_json::{Value, json};

use crate::directory::{self, DirectoryOptions};
use crate::failure::Failure;
use crate::input::{self, FormatOption};
use crate::interrupt;
use crate::output::{self, Csv, Table};
use crate::progress::Progress;
use crate::scheme;

/// What to measure.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Names of the problems, or files that declare systems [default: all with a reference solution].
    problems: Vec<String>,
    /// Time at which states are compared [default: 100, or the reference's last sample before
    /// it; 10 without a reference].
    #[arg(long, allow_negative_numbers = true)]
    end: Option<f64>,
    /// How often each setting is timed.
    #[arg(long, default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// The schemes that are measured, by comma [default: all].
    #[arg(long, value_delimiter = ',', value_parser = scheme::names())]
    scheme: Vec<String>,
    /// A scheme is not measured with finer settings than the first that takes so many seconds.
    #[arg(long, default_value_t = 0.2, allow_negative_numbers = true)]
    longest: f64,
    #[command(flatten)]
    directory: DirectoryOptions,
    /// How the picture is stored.
    #[arg(long, value_enum, default_value = "svg")]
    format: FormatOption,
}

/// Errors for which the table tells the time.
const LEVELS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];
/// Panels in a row of the picture.
const COLUMNS: usize = 3;

/// Measures, prints the table, writes CSV and picture.
pub(crate) fn bench(arguments: &Arguments) -> Result<(), Failure> {
    let longest = Duration::try_from_secs_f64(arguments.longest).map_err(|_| {
        let seconds = output::number(arguments.longest);
        Failure::Request(format!(
            "longest run: {seconds} (must be a time in seconds)"
        ))
    })?;
    let wanted = |method: &MethodName| {
        let names = &arguments.scheme;
        names.is_empty() || names.iter().any(|name| name == method.name())
    };
    let methods: Vec<MethodName> = MethodName::all().filter(wanted).collect();
    let problems = problems(arguments)?;
    let goals = problems
        .iter()
        .map(|problem| Goal::of(problem, arguments.end).map_err(Failure::from))
        .collect::<Result<Vec<_>, _>>()?;
    let mut out = arguments.directory.open(
        "output/bench",
        &["work_precision"],
        request(arguments, &problems, &goals),
    )?;
    interrupt::listen()?;
    let mut csv = out.csv("work_precision.csv", HEADER)?;
    let mut table = Table::new(2, header());
    let mut panels = Vec::new();
    let progress = Progress::new("");
    let mut outcome = Ok(());
    for (number, (problem, goal)) in problems.iter().zip(&goals).enumerate() {
        let count = problems.len() as f64;
        progress.tell(problem.description().name);
        let settings = goal.measure(problem, &methods, arguments.rounds, longest, &mut |share| {
            progress.at((number as f64 + share) / count)
        });
        write(&mut csv, problem, goal, &settings)?;
        add(&mut table, problem, goal, &settings);
        panels.push(panel(problem, goal, &settings));
        if interrupt::is_requested() {
            let text = format!("in problem {} of {count}", number + 1);
            outcome = Err(Failure::Interrupted(text));
            break;
        }
    }
    progress.finish();
    table.print()?;
    writeln!(
        std::io::stdout(),
        "milliseconds until the final error is at most that: minimum, median and maximum of {} runs \
         in turn",
        arguments.rounds
    )?;
    if !cfg!(feature = "compiled") {
        writeln!(
            std::io::stdout(),
            "the systems are compiled at run time, at some times the cost of generated code, which \
             runs if the program is built with `--features compiled`"
        )?;
    }
    out.add(csv.finish()?);
    out.picture("work_precision", &picture(panels), arguments.format.into())?;
    out.finish(&outcome)?;
    outcome
}

/// What decides the results.
fn request(arguments: &Arguments, problems: &[Problem], goals: &[Goal]) -> Value {
    let end = |goal: &Goal| json!({ "end": goal.t });
    let each = problems.iter().zip(goals).map(|(problem, goal)| {
        let mut request = directory::of_problem(problem);
        directory::add(&mut request, end(goal));
        request
    });
    json!({
        "problems": each.collect::<Vec<_>>(),
        "rounds": arguments.rounds,
        "schemes": arguments.scheme,
        "longest": arguments.longest,
    })
}

fn problems(arguments: &Arguments) -> Result<Vec<Problem>, Failure> {
    if arguments.problems.is_empty() {
        let mut all = registry::all();
        all.retain(|problem| problem.description().reference.is_some());
        return Ok(all);
    }
    let names = arguments.problems.iter();
    names.map(|name| input::problem(name, &[])).collect()
}

const HEADER: [&str; 12] = [
    "problem",
    "t_end",
    "exact",
    "scheme",
    "control",
    "value",
    "error",
    "steps",
    "transitions",
    "seconds_min",
    "seconds_median",
    "seconds_max",
];

/// What decides the steps of a scheme, in a word.
fn control(method: MethodName) -> &'static str {
    match method.control() {
        Control::StepSize { .. } => "step size",
        Control::Tolerance => "tolerance",
    }
}

fn write(
    csv: &mut Csv,
    problem: &Problem,
    goal: &Goal,
    settings: &[Setting],
) -> Result<(), Failure> {
    for setting in settings {
        let mut row = vec![
            problem.description().name.to_owned(),
            output::number(goal.t),
            goal.origin.describe().to_owned(),
            setting.method.name().to_owned(),
            control(setting.method).to_owned(),
            output::number(setting.control),
            output::number(setting.error),
            setting.statistics.steps.to_string(),
            setting.statistics.transitions.to_string(),
        ];
        row.extend(setting.spread().map(output::number));
        csv.row(row)?;
    }
    Ok(())
}

fn header() -> Vec<String> {
    let levels = LEVELS.map(|level| format!("error ≤ {level:e}"));
    ["problem".to_owned(), "scheme".to_owned()]
        .into_iter()
        .chain(levels)
        .collect()
}

/// A row a scheme.
fn add(table: &mut Table, problem: &Problem, goal: &Goal, settings: &[Setting]) {
    for method in MethodName::all() {
        let name = format!("{}, t = {}", problem.description().name, short(goal.t));
        let cells = LEVELS.map(|level| match fastest(settings, method, level) {
            Some(setting) => {
                let [least, median, most] = setting.spread().map(|seconds| 1e3 * seconds);
                format!("{least:.3} {median:.3} {most:.3}")
            }
            None => "–".to_owned(),
        });
        table.row([name, label(method)].into_iter().chain(cells));
    }
}

/// A time of comparison: whole, but for those at which something happens.
fn short(t: f64) -> String {
    if t.fract() == 0.0 {
        output::number(t)
    } else {
        format!("{t:.3}")
    }
}

/// A scheme, apart from its other form of the same name.
fn label(method: MethodName) -> String {
    let other = MethodName::find(method.name(), method.control() != Control::Tolerance);
    if other == Some(method) {
        method.name().to_owned()
    } else {
        format!("{}, by {}", method.name(), control(method))
    }
}

fn panel(problem: &Problem, goal: &Goal, settings: &[Setting]) -> Panel {
    let title = format!("{}, t = {}", problem.description().name, short(goal.t));
    let mut panel = Panel::new(
        title,
        Axis::new("final error", Scale::Decades),
        Axis::new("time (s)", Scale::Decades),
    );
    for (k, method) in MethodName::all().enumerate() {
        let own = settings.iter().filter(|setting| setting.method == method);
        let points = own
            .map(|setting| (setting.error, setting.spread()[0]))
            .collect();
        let look = Look::nth(k);
        panel.curve(Some(label(method)), points, Stroke::Marked, look);
    }
    panel
}

fn picture(panels: Vec<Panel>) -> Picture {
    Picture {
        columns: panels.len().clamp(1, COLUMNS),
        ..Picture::row("time against final error", panels)
    }
}
