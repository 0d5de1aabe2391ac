//! The transitions of a run: their file, their marks in pictures, and the itinerary.

use dmm_problems::problem::{Crossed, Problem};

use super::itinerary::Itinerary;
use crate::directory::Directory;
use crate::failure::Failure;
use crate::mode;
use crate::output::{self, Csv};
use crate::portrait::Mark;

/// Transitions kept for the phase portrait.
const MOST_MARKS: usize = 2_000;

/// What is told of transitions.
pub(super) struct Transitions<'a> {
    problem: &'a Problem,
    /// Of a system with interfaces.
    table: Option<Csv>,
    marks: Vec<Mark>,
    itinerary: Itinerary<'a>,
}

impl<'a> Transitions<'a> {
    /// Opens the file.
    pub(super) fn create(problem: &'a Problem, out: &Directory) -> Result<Self, Failure> {
        let table = match problem.interfaces() {
            // a smooth system has none: no file that says only that
            [] => None,
            _ => Some(out.csv("transitions.csv", header(problem))?),
        };
        Ok(Self {
            problem,
            table,
            marks: Vec::new(),
            itinerary: Itinerary::new(problem),
        })
    }

    /// Takes a transition.
    pub(super) fn take(&mut self, crossed: &Crossed) -> Result<(), Failure> {
        self.itinerary.take(crossed);
        if self.marks.len() < MOST_MARKS {
            self.marks.push(Mark::new(crossed));
        }
        match &mut self.table {
            Some(table) => table.row(fields(self.problem, crossed)),
            None => Ok(()),
        }
    }

    /// The file, the first transitions as marks, and the itinerary.
    pub(super) fn into_parts(self) -> (Option<Csv>, Vec<Mark>, Itinerary<'a>) {
        (self.table, self.marks, self.itinerary)
    }
}

/// Whether the values behind a transition may be others than those before.
fn has_jumps(problem: &Problem) -> bool {
    !problem.metadata().events.is_empty()
}

fn header(problem: &Problem) -> Vec<String> {
    let mut values = problem.states().to_vec();
    values.extend(mode::discrete_names(problem));
    let mut header = ["t", "interface", "from", "to", "kind"]
        .map(str::to_owned)
        .to_vec();
    header.extend(values.iter().map(|&name| name.to_owned()));
    if has_jumps(problem) {
        header.extend(values.iter().map(|name| format!("{name}_after")));
    }
    header.extend(["rate_from", "rate_to"].map(str::to_owned));
    header
}

fn fields(problem: &Problem, crossed: &Crossed) -> Vec<String> {
    let metadata = problem.metadata();
    let region = |index: usize| metadata.regions.get(index).map_or("", |region| region.name);
    let mut fields = vec![output::number(crossed.t)];
    let words = [
        metadata.guard_name(crossed.interface),
        region(crossed.from.region),
        region(crossed.to.region),
        crossed.kind.name(),
    ];
    fields.extend(words.map(str::to_owned));
    let mut sides = vec![(&crossed.x, &crossed.from)];
    if has_jumps(problem) {
        sides.push((&crossed.after, &crossed.to));
    }
    for (x, mode) in sides {
        let values = x.iter().copied().chain(mode::discrete(problem, mode));
        fields.extend(values.map(output::number));
    }
    fields.extend([crossed.rate_from, crossed.rate_to].map(output::number));
    fields
}
