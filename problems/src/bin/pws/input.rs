//! Options that several commands share.

use std::path::Path;

use clap::ValueEnum;
use dmm_picture::Format;
use dmm_problems::problem::Problem;
use dmm_problems::registry::{self, Unknown};
use dmm_runtime::Model;

use crate::failure::Failure;
use crate::file::Source;
use crate::output::grouped;

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

/// The file that is meant: what is no problem's name and is there, or is written like a path.
pub(crate) fn own_file(text: &str) -> Option<&Path> {
    let path = Path::new(text);
    let is_path = path.components().count() > 1 || path.extension().is_some();
    (is_path || (registry::find(text).is_err() && path.is_file())).then_some(path)
}

/// The problem of that name, or the system that is declared in that file, with `name=value`
/// parameters set.
pub(crate) fn problem(name: &str, parameters: &[String]) -> Result<Problem, Failure> {
    let mut problem = match own_file(name) {
        Some(path) => own(path)?,
        None => registry::find(name).map_err(|unknown| match unknown.closest {
            Some(_) => Failure::from(unknown),
            None => Failure::Request(format!(
                "{unknown}; `pws list` names those there are, and a file may declare another"
            )),
        })?,
    };
    let mut given = Vec::new();
    for assignment in parameters {
        let (name, value) = parse_assignment(assignment)?;
        refuse_second(&mut given, "parameter", &name)?;
        let name = name.as_str();
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

/// The system that a file declares.
fn own(path: &Path) -> Result<Problem, Failure> {
    let source = Source::read(path)?;
    let declaration = source.declaration()?;
    let model = Model::compile(source.text()).map_err(|error| {
        // once more, for the places of the errors
        match dmm_compiler::read(declaration) {
            Ok(_) => Failure::Request(format!("{}: {error}", path.display())),
            Err(wrong) => source.report(&[wrong]),
        }
    })?;
    for (line, column, text) in model.warnings() {
        source.warn_at((line, column), text);
    }
    Problem::own(model).map_err(|error| Failure::Request(error.to_string()))
}

/// The initial state: that of the problem's description with `x=1,q[0]=2` set.
pub(crate) fn initial(problem: &Problem, given: Option<&str>) -> Result<Vec<f64>, Failure> {
    let mut initial = problem.description().initial.to_vec();
    let assignments = given.into_iter().flat_map(|text| text.split(','));
    let mut given = Vec::new();
    for assignment in assignments {
        let (name, value) = parse_assignment(assignment)?;
        refuse_second(&mut given, "state", &name)?;
        let name = name.as_str();
        let states = problem.states();
        match states.iter().position(|state| *state == name) {
            Some(index) => initial[index] = value,
            None => return Err(unknown("state", name, states.iter().copied())),
        }
    }
    Ok(initial)
}

/// The index of a state.
pub(crate) fn state(problem: &Problem, name: &str) -> Result<usize, Failure> {
    let states = problem.states();
    let found = states.iter().position(|state| *state == name);
    found.ok_or_else(|| unknown("state", name, states.iter().copied()))
}

/// Refuses a name that was given before.
pub(crate) fn refuse_second(
    given: &mut Vec<String>,
    kind: &str,
    name: &str,
) -> Result<(), Failure> {
    if given.iter().any(|before| before == name) {
        return Err(Failure::Request(format!(
            "{kind} `{name}` is given twice: name each once"
        )));
    }
    given.push(name.to_owned());
    Ok(())
}

/// A whole number, one at least.
pub(crate) fn count(text: &str) -> Result<u64, String> {
    match text.parse() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err("must be a whole number, 1 at least".to_owned()),
    }
}

pub(crate) fn unknown<'a>(
    kind: &'static str,
    name: &str,
    known: impl Iterator<Item = &'a str>,
) -> Failure {
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
            grouped(&known).join(", ")
        )),
    }
}

/// The name, without blanks, and the value.
fn parse_assignment(text: &str) -> Result<(String, f64), Failure> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| Failure::Request(format!("`{text}` is not of the form name=value")))?;
    let name: String = name.split_whitespace().collect();
    let value = value.trim();
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok((name, number)),
        _ => Err(Failure::Request(format!(
            "`{value}` (for `{name}`) is not a finite number"
        ))),
    }
}
