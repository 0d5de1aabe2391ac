//! `pws converge PROBLEM`, `pws converge FILE`

use std::io::Write;
use std::path::{Path, PathBuf};

use dmm_picture::{Axis, Look, Panel, Picture, Scale, Stroke};
use dmm_problems::convergence::{self, Plan, Row, Study, StudyError, norms};
use dmm_problems::fit::fitted_order;
use dmm_problems::method::{Control, MethodName};
use dmm_problems::problem::Problem;
use dmm_problems::truth::Truth;
use serde_json::{Value, json};

use crate::directory::{self, Directory, DirectoryOptions};
use crate::failure::Failure;
use crate::input::{self, FormatOption};
use crate::interrupt;
use crate::output::{self, Table};
use crate::progress::Progress;
use crate::scheme;

/// What to measure.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Name of the problem (see `pws list`), or a file that declares a system.
    #[arg(value_name = "PROBLEM|FILE")]
    problem: String,
    /// The scheme, one of uniform steps: the default of other commands, `best`, has no step size.
    #[arg(long, default_value = "symmetric", value_parser = scheme::uniform_names())]
    scheme: String,
    /// Numbers of transitions after which errors are measured [default: 0,10,20,30, or fewer
    /// where there are fewer].
    #[arg(long, value_delimiter = ',')]
    after: Option<Vec<usize>>,
    /// The largest step size [default: by the order of the scheme, 1/64 for 2, 1/16 for 4, 1/8
    /// for 6 and 8].
    #[arg(long, allow_negative_numbers = true)]
    step: Option<f64>,
    /// How often it is halved.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=20))]
    halvings: u32,
    /// Time at which states are compared, where there are no transitions.
    #[arg(long, default_value_t = 10.0, allow_negative_numbers = true)]
    end: f64,
    /// A parameter; may be repeated.
    #[arg(long = "param", value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    /// The initial state; states not named keep the problem's value.
    #[arg(long, value_name = "x=1,q[0]=2", allow_hyphen_values = true)]
    initial: Option<String>,
    #[command(flatten)]
    directory: DirectoryOptions,
    /// How pictures are stored.
    #[arg(long, value_enum, default_value = "svg")]
    format: FormatOption,
}

/// Measures, prints the table, writes CSV and picture.
pub(crate) fn converge(arguments: &Arguments) -> Result<(), Failure> {
    let problem = input::problem(&arguments.problem, &arguments.parameters)?;
    let problem = &problem;
    let description = problem.description();
    let initial = input::initial(problem, arguments.initial.as_deref())?;
    let method = scheme::named(&arguments.scheme, false)?;
    let step = arguments.step.unwrap_or_else(|| largest_step(method));
    if !(step > 0.0 && step.is_finite()) {
        return Err(Failure::Request(format!(
            "step size: {} (must be positive and finite)",
            output::number(step)
        )));
    }
    let plan = Plan {
        method,
        after: arguments
            .after
            .clone()
            .map_or_else(|| default_after(problem, &initial), Ok)?,
        step_sizes: halved(step, arguments.halvings),
        t_end: if problem.interfaces().is_empty() {
            arguments.end
        } else {
            description.t_end
        },
        initial,
    };
    let mut out = arguments.directory.open(
        Path::new("output").join(description.name).join("converge"),
        &["convergence"],
        request(problem, &plan),
    )?;
    interrupt::listen()?;
    let progress = Progress::new(description.name);
    let study = convergence::study(problem, &plan, &mut |share| progress.at(share))?;
    progress.finish();
    out.add(write(&out, problem, &study)?);
    let picture = picture(problem, method, &study);
    out.picture("convergence", &picture, arguments.format.into())?;
    print(problem, &study)?;
    let outcome = match (study.stopped.first(), study.step_sizes.len()) {
        (_, done) if done < plan.step_sizes.len() => Err(Failure::Interrupted(format!(
            "after {done} of {} step sizes",
            plan.step_sizes.len()
        ))),
        (Some(stopped), _) => Err(Failure::Stopped(stopped.to_string())),
        (None, _) => Ok(()),
    };
    out.finish(&outcome)?;
    outcome
}

/// What decides the results.
fn request(problem: &Problem, plan: &Plan) -> Value {
    let mut request = directory::of_problem(problem);
    let own = json!({
        "scheme": plan.method.name(),
        "initial state": plan.initial,
        "after": plan.after,
        "step sizes": plan.step_sizes,
        "end": plan.t_end,
    });
    directory::add(&mut request, own);
    request
}

/// p, where errors are O(τᵖ).
fn exponent(method: MethodName) -> i32 {
    match method.control() {
        Control::StepSize { order } => order,
        Control::Tolerance => 1,
    }
}

/// Where the errors of a scheme are about to fall with its order.
fn largest_step(method: MethodName) -> f64 {
    match exponent(method) {
        ..=3 => 1.0 / 64.0,
        4 | 5 => 1.0 / 16.0,
        6.. => 1.0 / 8.0,
    }
}

/// Transitions that are counted to choose after how many of them to measure: a few more than
/// the largest default.
const MOST_TRANSITIONS: usize = 31;
/// Of larger systems groups of states are measured, not each.
const MOST_STATES: usize = 12;

/// `step`, `step`/2, …
pub(crate) fn halved(step: f64, halvings: u32) -> Vec<f64> {
    (0..=halvings)
        .map(|k| step * 0.5f64.powi(k as i32))
        .collect()
}

fn default_after(problem: &Problem, initial: &[f64]) -> Result<Vec<usize>, Failure> {
    if problem.interfaces().is_empty() {
        return Ok(vec![0]);
    }
    let truth = Truth::of(
        problem,
        initial,
        MOST_TRANSITIONS,
        problem.description().t_end,
    )
    .map_err(StudyError::from)?;
    Ok(convergence::default_after(truth.nodes.len() - 1))
}

/// The measured parts of the state of a row: each state, or of a large system the norm of
/// each group of them.
fn parts(problem: &Problem, row: &Row) -> Vec<(String, Vec<f64>)> {
    let states = problem.states();
    if states.len() <= MOST_STATES {
        let components = row.components.iter().cloned();
        return states
            .iter()
            .map(|state| (*state).to_owned())
            .zip(components)
            .collect();
    }
    output::groups(states)
        .into_iter()
        .map(|(name, states)| (format!("‖{name}‖"), norms(&row.components[states])))
        .collect()
}

/// The measured quantities of a study: transitions, name, errors.
pub(crate) fn quantities(problem: &Problem, study: &Study) -> Vec<(usize, String, Vec<f64>)> {
    let mut quantities = Vec::new();
    for row in &study.rows {
        if let Some(crossing) = &row.crossing {
            let name = format!("time of crossing {}", crossing.number);
            quantities.push((row.transitions, name, crossing.errors.clone()));
        }
        for (part, errors) in parts(problem, row) {
            let name = format!("{part} at t = {:.4}", row.t);
            quantities.push((row.transitions, name, errors));
        }
    }
    quantities
}

fn write(out: &Directory, problem: &Problem, study: &Study) -> Result<PathBuf, Failure> {
    let header = ["transitions", "quantity", "step_size", "error"];
    let mut csv = out.csv("convergence.csv", header)?;
    for (transitions, name, errors) in quantities(problem, study) {
        for (tau, error) in study.step_sizes.iter().zip(errors) {
            csv.row([
                transitions.to_string(),
                name.clone(),
                output::number(*tau),
                output::number(error),
            ])?;
        }
    }
    csv.finish()
}

fn print(problem: &Problem, study: &Study) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{}: errors against {}",
        problem.description().name,
        study.origin.describe()
    )?;
    let (first, last) = (study.step_sizes.first(), study.step_sizes.last());
    let (Some(first), Some(last)) = (first, last) else {
        return Ok(());
    };
    let mut table = Table::new(
        0,
        [
            "transitions".to_owned(),
            "quantity".to_owned(),
            format!("error, τ = {}", output::number(*first)),
            format!("error, τ = {last:.3e}"),
            "order".to_owned(),
        ],
    );
    for (transitions, name, errors) in quantities(problem, study) {
        let at = |error: Option<&f64>| match error {
            Some(error) if !error.is_nan() => format!("{error:.3e}"),
            _ => "unknown".to_owned(),
        };
        table.row([
            transitions.to_string(),
            name,
            at(errors.first()),
            at(errors.last()),
            order(study, &errors),
        ]);
    }
    table.print()?;
    if quantities(problem, study)
        .iter()
        .any(|(.., errors)| known(errors) < errors.len())
    {
        writeln!(
            out,
            "k of n: fitted to the k step sizes of n whose error is known and above rounding"
        )?;
    }
    Ok(())
}

/// How many errors have an order fitted to them.
fn known(errors: &[f64]) -> usize {
    errors.iter().filter(|error| **error > FLOOR).count()
}

/// Errors below this are rounding: the quantity is exact, and there is no order to fit.
const ROUNDING: f64 = 1e-13;
/// An order is fitted to errors above this, which rounding has no part in.
const FLOOR: f64 = 10.0 * ROUNDING;

/// The fitted order, and to how many of the errors it is fitted if not to all.
pub(crate) fn order(study: &Study, errors: &[f64]) -> String {
    if errors.iter().all(|error| *error < ROUNDING) {
        return "exact".to_owned();
    }
    let pairs = study.step_sizes.iter().zip(errors);
    let (step_sizes, above): (Vec<f64>, Vec<f64>) =
        pairs.filter(|(_, error)| **error > FLOOR).unzip();
    let order = fitted_order(&step_sizes, &above);
    match known(errors) {
        known if known == errors.len() => format!("{order:.3}"),
        known @ (0 | 1) => format!("none ({known} of {})", errors.len()),
        known => format!("{order:.3} ({known} of {})", errors.len()),
    }
}

/// The axes of errors, `what` they are of, over step sizes.
pub(crate) fn axes(what: &str) -> (Axis, Axis) {
    (
        Axis::new("step size τ", Scale::Octaves),
        Axis::new(what, Scale::Decades),
    )
}

/// The errors over the step sizes.
pub(crate) fn curve(study: &Study, errors: &[f64]) -> Vec<(f64, f64)> {
    let step_sizes = study.step_sizes.iter().copied();
    step_sizes.zip(errors.iter().copied()).collect()
}

fn picture(problem: &Problem, method: MethodName, study: &Study) -> Picture {
    let order = exponent(method);
    let mut panels = Vec::new();
    if study.rows.iter().any(|row| row.crossing.is_some()) {
        let (x, y) = axes("|crossing time − exact|");
        let mut panel = Panel::new("crossing time", x, y);
        for (k, row) in study.rows.iter().enumerate() {
            if let Some(crossing) = &row.crossing {
                let label = Some(format!("crossing {}", crossing.number));
                panel.curve(
                    label,
                    curve(study, &crossing.errors),
                    Stroke::Marked,
                    Look::nth(k),
                );
            }
        }
        panel.slope(order, 0);
        panels.push(panel);
    }
    let rows: Vec<_> = study.rows.iter().map(|row| parts(problem, row)).collect();
    let names = rows.first().map(Vec::as_slice).unwrap_or_default();
    for (part, (name, _)) in names.iter().enumerate() {
        let (x, y) = axes(&format!("|{name} − exact|"));
        let mut panel = Panel::new(format!("{name} before and after transitions"), x, y);
        for (k, row) in study.rows.iter().enumerate() {
            let label = Some(match row.transitions {
                0 if problem.interfaces().is_empty() => format!("t = {}", row.t),
                0 => "before".to_owned(),
                many => format!("after {many}"),
            });
            panel.curve(
                label,
                curve(study, &rows[k][part].1),
                Stroke::Marked,
                Look::nth(k),
            );
        }
        panel.slope(order, 0);
        panels.push(panel);
    }
    Picture {
        columns: panels.len().min(3),
        ..Picture::row(problem.description().title, panels)
    }
}
