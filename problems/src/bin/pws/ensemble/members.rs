//! The members of an ensemble: every combination of ranges, or the rows of a file.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use dmm_problems::problem::{Problem, Start};

use crate::failure::Failure;
use crate::input;

/// A member, or why the row that should be one is none.
pub(crate) type Row = Result<Start, String>;

/// Members, and how many there are where that is known.
pub(crate) struct Members {
    pub(crate) rows: Box<dyn Iterator<Item = Row>>,
    pub(crate) count: Option<u64>,
}

/// What a value is of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Quantity {
    Parameter(usize),
    State(usize),
}

/// Evenly spaced values.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Range {
    from: f64,
    to: f64,
    count: u64,
}

impl Range {
    fn at(self, index: u64) -> f64 {
        match index {
            0 => self.from,
            _ if index + 1 == self.count => self.to,
            _ => self.from + (self.to - self.from) * (index as f64 / (self.count - 1) as f64),
        }
    }
}

fn set(start: &mut Start, quantity: Quantity, value: f64) {
    let (values, index) = match quantity {
        Quantity::Parameter(index) => (&mut start.parameters, index),
        Quantity::State(index) => (&mut start.initial, index),
    };
    if let Some(place) = values.get_mut(index) {
        *place = value;
    }
}

fn parameter(problem: &Problem, name: &str) -> Option<Quantity> {
    let parameters = problem.parameters();
    let found = parameters.iter().position(|(other, _)| *other == name);
    found.map(Quantity::Parameter)
}

fn state(problem: &Problem, name: &str) -> Option<Quantity> {
    let found = problem.states().iter().position(|other| *other == name);
    found.map(Quantity::State)
}

/// Every combination of what `x=-1..1:101,y=0.5` and `a=1..2:11` say, the last one changing
/// first.
pub(crate) fn combinations(
    problem: &Problem,
    initial: Option<&str>,
    parameters: &[String],
) -> Result<Members, Failure> {
    let mut axes: Vec<(Quantity, Range)> = Vec::new();
    let mut given = Vec::new();
    for text in parameters {
        let (name, range) = assignment(text)?;
        input::refuse_second(&mut given, "parameter", &name)?;
        let known = problem.parameters();
        let quantity = parameter(problem, &name).ok_or_else(|| {
            input::unknown("parameter", &name, known.iter().map(|(name, _)| *name))
        })?;
        axes.push((quantity, range));
    }
    let mut given = Vec::new();
    for text in initial.into_iter().flat_map(|text| text.split(',')) {
        let (name, range) = assignment(text)?;
        input::refuse_second(&mut given, "state", &name)?;
        let quantity = state(problem, &name)
            .ok_or_else(|| input::unknown("state", &name, problem.states().iter().copied()))?;
        axes.push((quantity, range));
    }
    let counts = axes.iter().map(|(_, range)| range.count);
    let count = counts
        .clone()
        .try_fold(1u64, u64::checked_mul)
        .ok_or_else(|| Failure::Request("there are more than 2^64 combinations".to_owned()))?;
    let start = problem.default_start();
    let row = move |number: u64| {
        let mut start = start.clone();
        let mut rest = number;
        for (quantity, range) in axes.iter().rev() {
            set(&mut start, *quantity, range.at(rest % range.count));
            rest /= range.count;
        }
        Ok(start)
    };
    Ok(Members {
        rows: Box::new((0..count).map(row)),
        count: Some(count),
    })
}

/// `x=0.5` or `x=-1..1:101`
fn assignment(text: &str) -> Result<(String, Range), Failure> {
    let wrong = |why: &str| {
        Failure::Request(format!(
            "`{}` {why}: write name=value or name=from..to:count",
            text.trim()
        ))
    };
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| wrong("names no value"))?;
    let name: String = name.split_whitespace().collect();
    let finite = |text: &str| {
        let number = text.trim().parse().ok();
        number.filter(|number: &f64| number.is_finite())
    };
    let Some((from, rest)) = value.split_once("..") else {
        let value = finite(value).ok_or_else(|| wrong("is not a finite number"))?;
        let range = Range {
            from: value,
            to: value,
            count: 1,
        };
        return Ok((name, range));
    };
    let (to, count) = rest
        .split_once(':')
        .ok_or_else(|| wrong("says not how many"))?;
    let ends = finite(from).zip(finite(to));
    let (from, to) = ends.ok_or_else(|| wrong("has an end that is not a finite number"))?;
    match count.trim().parse() {
        Ok(count) if count > 1 => Ok((name, Range { from, to, count })),
        _ => Err(wrong("needs a count of 2 at least")),
    }
}

/// The rows of a CSV file whose columns are named after states and parameters; what has no
/// column keeps the problem's value.
pub(crate) fn of_file(problem: &Problem, path: &Path) -> Result<Members, Failure> {
    let count = rows(path)?;
    let file = File::open(path).map_err(|error| Failure::read(path, error))?;
    let mut reader = csv::ReaderBuilder::new()
        .flexible(true)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(file);
    let header = reader
        .headers()
        .map_err(|error| Failure::read(path, error))?
        .clone();
    let mut columns = Vec::new();
    let mut given = Vec::new();
    for name in &header {
        input::refuse_second(&mut given, "column", name)?;
        let quantity = state(problem, name).or_else(|| parameter(problem, name));
        let known = problem.parameters();
        let known = known.iter().map(|(name, _)| *name);
        let known = problem.states().iter().copied().chain(known);
        let quantity = quantity.ok_or_else(|| input::unknown("state or parameter", name, known))?;
        columns.push((name.to_owned(), quantity));
    }
    let start = problem.default_start();
    let records = reader
        .into_records()
        .map(move |record| row(&start, &columns, record));
    Ok(Members {
        rows: Box::new(records),
        count,
    })
}

/// About how many members a file has, by its lines; nothing of what can be read once only.
fn rows(path: &Path) -> Result<Option<u64>, Failure> {
    let failed = |error| Failure::read(path, error);
    let file = File::open(path).map_err(failed)?;
    if !file.metadata().map_err(failed)?.is_file() {
        return Ok(None);
    }
    let mut count = 0;
    for line in BufReader::new(file).split(b'\n') {
        let line = line.map_err(failed)?;
        let is_member = !line.starts_with(b"#") && !line.trim_ascii().is_empty();
        count += u64::from(is_member);
    }
    Ok(Some(count.saturating_sub(1)))
}

/// A row of a file.
fn row(
    start: &Start,
    columns: &[(String, Quantity)],
    record: Result<csv::StringRecord, csv::Error>,
) -> Row {
    let record = record.map_err(|error| error.to_string())?;
    let line = record.position().map_or(0, csv::Position::line);
    if record.len() != columns.len() {
        let (found, wanted) = (record.len(), columns.len());
        return Err(format!(
            "line {line}: {found} values where the header has {wanted}"
        ));
    }
    let mut start = start.clone();
    for ((name, quantity), text) in columns.iter().zip(&record) {
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => set(&mut start, *quantity, value),
            _ => {
                return Err(format!(
                    "line {line}, column `{name}`: `{text}` is not a finite number"
                ));
            }
        }
    }
    Ok(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parameters and the initial state of each.
    type Starts = Vec<(Vec<f64>, Vec<f64>)>;

    fn starts(initial: &str, parameters: &[&str]) -> Result<Starts, Failure> {
        let problem = input::problem("elliptic", &[])?;
        let parameters: Vec<String> = parameters.iter().map(|text| (*text).to_owned()).collect();
        let members = combinations(&problem, Some(initial), &parameters)?;
        let rows: Vec<Start> = members.rows.flatten().collect();
        assert_eq!(members.count, Some(rows.len() as u64));
        Ok(rows
            .into_iter()
            .map(|start| (start.parameters, start.initial))
            .collect())
    }

    #[test]
    fn ranges_are_combined() {
        let rows = starts("x=-1..1:3, y=0.5", &["a_inside=-3..-2:2"]).expect("valid");
        let expected = [-3.0, -2.0].map(|a| [-1.0, 0.0, 1.0].map(|x| (a, x)));
        let expected: Vec<_> = expected
            .concat()
            .into_iter()
            .map(|(a, x)| (vec![a, -2.0], vec![x, 0.5]))
            .collect();
        assert_eq!(rows, expected);
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (initial, said) in [
            ("x", "names no value"),
            ("x=a", "not a finite number"),
            ("x=1..2", "how many"),
            ("x=1..2:1", "2 at least"),
            ("x=1..inf:3", "not a finite number"),
            ("q=1", "unknown state"),
            ("x=1,x=2", "given twice"),
        ] {
            let failure = starts(initial, &[]).expect_err(initial).to_string();
            assert!(failure.contains(said), "{initial}: {failure}");
        }
    }
}
