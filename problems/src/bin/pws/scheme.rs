//! The options that choose a scheme and what decides its steps.

use clap::builder::{PossibleValue, PossibleValuesParser};
use dmm_problems::method::{Control, MethodName};
use dmm_problems::problem::{DEFAULT_TOLERANCE, OutputTimes, Run};

use crate::failure::Failure;
use crate::output;

/// A scheme, with its step size or tolerance.
#[derive(clap::Args)]
pub(crate) struct SchemeOptions {
    /// The scheme [default: best].
    #[arg(long, value_parser = names())]
    scheme: Option<String>,
    #[command(flatten)]
    control: ControlOptions,
}

/// The same of an ensemble.
#[derive(clap::Args)]
pub(crate) struct EnsembleSchemeOptions {
    /// The scheme [default: best].
    #[arg(long, value_parser = ensemble_names())]
    scheme: Option<String>,
    #[command(flatten)]
    control: ControlOptions,
}

/// What decides the steps of a scheme.
#[derive(clap::Args)]
struct ControlOptions {
    /// Step size; of a scheme that chooses its steps (best, taylor, or with `--tolerance`), the
    /// distance of output points [default: the problem's, or 1e-3 where all are compared].
    #[arg(long, allow_negative_numbers = true)]
    step: Option<f64>,
    /// Tolerance, for steps of the scheme's own choice [default of best and taylor: 1e-12].
    #[arg(long, allow_negative_numbers = true)]
    tolerance: Option<f64>,
}

/// The names of the schemes, with what they are.
pub(crate) fn names() -> PossibleValuesParser {
    parser(MethodName::all())
}

/// The names of the schemes with uniform steps.
pub(crate) fn uniform_names() -> PossibleValuesParser {
    parser(MethodName::all().filter(|method| method.control() != Control::Tolerance))
}

fn parser(methods: impl Iterator<Item = MethodName>) -> PossibleValuesParser {
    let methods: Vec<MethodName> = methods.collect();
    let named = |name| methods.iter().filter(move |method| method.name() == name);
    let mut values: Vec<PossibleValue> = Vec::new();
    for method in &methods {
        let name = method.name();
        if values.iter().any(|value| value.get_name() == name) {
            continue;
        }
        // the form with steps by a tolerance has the same name
        let help = if named(name).count() > 1 {
            format!("{}; with `--tolerance`, steps by it", method.summary())
        } else {
            method.summary().to_owned()
        };
        values.push(PossibleValue::new(name).help(help));
    }
    PossibleValuesParser::new(values)
}

/// The names of the schemes that ensembles are integrated by.
fn ensemble_names() -> PossibleValuesParser {
    parser(MethodName::OF_ENSEMBLES.iter().copied())
}

impl SchemeOptions {
    /// The run with these options instead of its own.
    pub(crate) fn applied(&self, run: Run) -> Result<Run, Failure> {
        self.control.applied(self.scheme.as_deref(), run)
    }
}

impl EnsembleSchemeOptions {
    /// The run with these options instead of its own.
    pub(crate) fn applied(&self, run: Run) -> Result<Run, Failure> {
        self.control.applied(self.scheme.as_deref(), run)
    }
}

impl ControlOptions {
    /// The scheme of that name.
    fn method(&self, name: &str) -> Result<MethodName, Failure> {
        let method = named(name, self.tolerance.is_some())?;
        match (method.control(), self.tolerance) {
            (Control::StepSize { .. }, Some(_)) => Err(Failure::Request(format!(
                "the scheme `{name}` takes a step size, not a tolerance",
            ))),
            _ => Ok(method),
        }
    }

    fn applied(&self, scheme: Option<&str>, run: Run) -> Result<Run, Failure> {
        let method = self.method(scheme.unwrap_or(run.method.name()))?;
        let step_size = self.step.unwrap_or(run.step_size);
        Ok(Run {
            method,
            step_size,
            tolerance: self.tolerance.unwrap_or(DEFAULT_TOLERANCE),
            ..run
        })
    }
}

/// The scheme of that name.
pub(crate) fn named(name: &str, adaptive: bool) -> Result<MethodName, Failure> {
    MethodName::find(name, adaptive)
        .ok_or_else(|| Failure::Request(format!("unknown scheme `{name}`")))
}

/// The run with output at the multiples of its step size, if the scheme chooses its steps.
pub(crate) fn with_even_output(run: Run) -> Result<Run, Failure> {
    if run.method.control() != Control::Tolerance {
        return Ok(run);
    }
    let interval = run.step_size;
    let requirement = match interval {
        _ if !(interval > 0.0 && interval.is_finite()) => "must be positive and finite",
        _ if interval <= f64::EPSILON * run.t_end => "is below the rounding error of the time",
        _ => {
            return Ok(Run {
                output_times: OutputTimes::Every(interval),
                ..run
            });
        }
    };
    Err(Failure::Request(format!(
        "step size: {} ({requirement})",
        output::number(interval)
    )))
}

/// The scheme of a run and what decides its steps, in words.
pub(crate) fn describe(run: &Run) -> String {
    let name = run.method.name();
    match run.method.control() {
        Control::StepSize { .. } => {
            format!("{name} with step size {}", output::number(run.step_size))
        }
        Control::Tolerance => format!("{name} with tolerance {}", output::number(run.tolerance)),
    }
}
