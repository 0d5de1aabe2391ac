//! Options that several commands share.

use clap::ValueEnum;
use dmm_problems::picture::Format;
use dmm_problems::problem::Problem;
use dmm_problems::registry::{self, Unknown};

use crate::failure::Failure;

/// How pictures are stored.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum FormatOption {
    Svg,
    Png,
}

impl From<FormatOption> for Format {
    fn from(option: FormatOption) -> Self {
        match option {
            FormatOption::Svg => Self::Svg,
            FormatOption::Png => Self::Png,
        }
    }
}

/// The problem of that name with `name=value` parameters set.
pub(crate) fn problem(name: &str, parameters: &[String]) -> Result<Box<dyn Problem>, Failure> {
    let mut problem = registry::find(name)?;
    for assignment in parameters {
        let (name, value) = parse_assignment(assignment)?;
        if !problem.set_parameter(name, value) {
            let known = problem.parameters();
            return Err(unknown(
                "parameter",
                name,
                known.iter().map(|(name, _)| *name),
            ));
        }
    }
    Ok(problem)
}

/// The initial state: that of the problem's card with `x=1,y=2` set.
pub(crate) fn initial(problem: &dyn Problem, given: Option<&str>) -> Result<Vec<f64>, Failure> {
    let mut initial = problem.card().initial.to_vec();
    let assignments = given.into_iter().flat_map(|text| text.split(','));
    for assignment in assignments {
        let (name, value) = parse_assignment(assignment)?;
        let states = problem.states();
        match states.iter().position(|state| *state == name) {
            Some(index) => initial[index] = value,
            None => return Err(unknown("state", name, states.iter().copied())),
        }
    }
    Ok(initial)
}

/// The index of a state.
pub(crate) fn state(problem: &dyn Problem, name: &str) -> Result<usize, Failure> {
    let states = problem.states();
    let found = states.iter().position(|state| *state == name);
    found.ok_or_else(|| unknown("state", name, states.iter().copied()))
}

fn unknown<'a>(kind: &'static str, name: &str, known: impl Iterator<Item = &'a str>) -> Failure {
    let known: Vec<&str> = known.collect();
    let closest = registry::closest(name, known.iter().copied());
    match (&closest, known.is_empty()) {
        (Some(_), _) => Unknown {
            kind,
            name: name.to_owned(),
            closest,
        }
        .into(),
        (None, true) => Failure::Request(format!("unknown {kind} `{name}`: there are none")),
        (None, false) => Failure::Request(format!(
            "unknown {kind} `{name}`; there are {}",
            known.join(", ")
        )),
    }
}

fn parse_assignment(text: &str) -> Result<(&str, f64), Failure> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| Failure::Request(format!("`{text}` is not of the form name=value")))?;
    let (name, value) = (name.trim(), value.trim());
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok((name, number)),
        _ => Err(Failure::Request(format!(
            "`{value}` (for `{name}`) is not a finite number"
        ))),
    }
}
