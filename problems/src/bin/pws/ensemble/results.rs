//! The results of an ensemble as they come in: written to a table in order, and counted.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io::Write;
use std::ops::ControlFlow;
use std::path::PathBuf;

use dmm_problems::problem::{Arrival, MemberOutcome, Problem, Run, Start};
use dmm_runtime::Metadata;

use super::cells::{Cell, Column, Kind};
use super::members::Row;
use super::table::Table;
use crate::failure::Failure;
use crate::mode;
use crate::output;
use crate::progress::Progress;
use crate::scheme;

/// Rows that are read and not yet written; a bad one has its place among the others.
pub(crate) type Waiting = RefCell<VecDeque<Row>>;

/// The results so far.
pub(crate) struct Results {
    table: Table,
    regions: Vec<&'static str>,
    metadata: &'static Metadata,
    progress: Progress,
    /// How many members there will be, if that is known.
    count: Option<u64>,
    members: u64,
    failures: u64,
    steps: u64,
    transitions: u64,
    /// Columns of a member's start, and of where it ended.
    widths: (usize, usize),
}

impl Results {
    /// None yet, to be written to `path`.
    pub(crate) fn create(
        problem: &Problem,
        path: PathBuf,
        count: Option<u64>,
    ) -> Result<Self, Failure> {
        let states = problem.states();
        let parameters = problem.parameters();
        let column = |name: &str, kind| -> Column { (name.to_owned(), kind) };
        let number = |name: &str| column(name, Kind::Number);
        let mut columns = vec![column("member", Kind::Count)];
        columns.extend(parameters.iter().map(|(name, _)| number(name)));
        columns.extend(states.iter().map(|name| number(&format!("{name}(0)"))));
        columns.extend([number("t"), column("region", Kind::Text)]);
        columns.extend(states.iter().map(|name| number(name)));
        let discrete = mode::discrete_names(problem);
        columns.extend(discrete.iter().map(|name| number(name)));
        columns.extend(["steps", "transitions"].map(|name| column(name, Kind::Count)));
        columns.push(column("failure", Kind::Text));
        Ok(Self {
            table: Table::create(path, &columns)?,
            regions: problem.regions(),
            progress: Progress::new(problem.description().name),
            count,
            members: 0,
            failures: 0,
            steps: 0,
            transitions: 0,
            widths: (
                parameters.len() + states.len(),
                states.len() + discrete.len() + 4,
            ),
            metadata: problem.metadata(),
        })
    }

    /// Writes the next member with its outcome and the bad rows before it; without an outcome those that
    /// are left.
    pub(crate) fn take(
        &mut self,
        waiting: &Waiting,
        mut outcome: Option<MemberOutcome>,
    ) -> Result<(), Failure> {
        let ends_with_member = outcome.is_some();
        loop {
            // the members are not borrowed while the row is written
            let next = waiting.borrow_mut().pop_front();
            let Some(row) = next else { break };
            match row {
                Err(failure) => self.write(None, None, Some(failure))?,
                Ok(start) => {
                    let (arrival, error) = match outcome.take() {
                        Some(outcome) => (outcome.arrival, outcome.error),
                        None => (None, None),
                    };
                    let failure = error.map(|error| error.to_string());
                    self.write(Some(start), arrival, failure)?;
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
        start: Option<Start>,
        arrival: Option<Arrival>,
        failure: Option<String>,
    ) -> Result<(), Failure> {
        let missing = |count| (0..count).map(|_| Cell::Missing);
        let mut cells = vec![Cell::Count(self.members)];
        match start {
            Some(Start {
                parameters,
                initial,
            }) => cells.extend(parameters.into_iter().chain(initial).map(Cell::Number)),
            None => cells.extend(missing(self.widths.0)),
        }
        match arrival {
            Some(arrival) => {
                let region = self.regions.get(arrival.mode.region).copied();
                let region = region.unwrap_or_default().to_owned();
                cells.extend([Cell::Number(arrival.t), Cell::Text(region)]);
                cells.extend(arrival.x.into_iter().map(Cell::Number));
                let discrete = self.metadata.declared_values(&arrival.mode.discrete);
                cells.extend(discrete.into_iter().map(Cell::Number));
                let counts = arrival.statistics;
                cells.extend([counts.steps, counts.transitions].map(Cell::Count));
                self.steps += counts.steps;
                self.transitions += counts.transitions;
            }
            None => cells.extend(missing(self.widths.1)),
        }
        self.members += 1;
        self.failures += u64::from(failure.is_some());
        cells.push(failure.map_or(Cell::Missing, Cell::Text));
        self.table.row(cells)
    }

    /// How many members there were so far.
    pub(crate) fn members(&self) -> u64 {
        self.members
    }

    /// Tells how far it is; whether to go on.
    pub(crate) fn goes_on(&self) -> ControlFlow<()> {
        match self.count {
            Some(count) => self.progress.at(self.members as f64 / count as f64),
            None => self.progress.count(self.members, "trajectories"),
        }
    }

    /// Closes the table and sums up: the file, and whether all went well.
    pub(crate) fn finish(
        self,
        problem: &Problem,
        run: &Run,
        seconds: f64,
    ) -> Result<(PathBuf, Result<(), Failure>), Failure> {
        self.progress.finish();
        let path = self.table.finish()?;
        let mut out = std::io::stdout().lock();
        writeln!(
            out,
            "{}: {}",
            problem.description().name,
            problem.description().title
        )?;
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
        let outcome = match self.failures {
            0 => Ok(()),
            failures => Err(Failure::Stopped(format!(
                "{failures} of {members} trajectories failed: see the column `failure`"
            ))),
        };
        Ok((path, outcome))
    }
}
