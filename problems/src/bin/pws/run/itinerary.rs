//! The itinerary of a run: what happened when, between which modes.

use std::io::{self, Write};

use dmm_problems::problem::{Crossed, Problem};

use crate::mode;
use crate::output::{self, Table};

/// So many transitions are printed.
const PRINTED: usize = 20;
/// So many states that a jump changes are printed.
const MOST_STATES: usize = 4;
/// A name of more letters is shortened.
const LONGEST_NAME: usize = 40;
/// Digits of a time.
const DIGITS: i32 = 9;

/// The first transitions of a run, and how many there were of each kind.
pub(super) struct Itinerary<'a> {
    problem: &'a Problem,
    first: Vec<Crossed>,
    counts: Vec<(&'static str, u64)>,
}

impl<'a> Itinerary<'a> {
    pub(super) fn new(problem: &'a Problem) -> Self {
        Self {
            problem,
            first: Vec::new(),
            counts: Vec::new(),
        }
    }

    /// Takes a transition.
    pub(super) fn take(&mut self, crossed: &Crossed) {
        let name = crossed.kind.name();
        match self.counts.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((name, 1)),
        }
        if self.first.len() < PRINTED {
            self.first.push(crossed.clone());
        }
    }

    fn count(&self) -> u64 {
        self.counts.iter().map(|(_, count)| count).sum()
    }

    /// Prints how many there were, and the first of them.
    pub(super) fn print(&self) -> io::Result<()> {
        let mut out = io::stdout().lock();
        let counts = self.counts.iter();
        let counts: Vec<String> = counts
            .map(|(kind, count)| format!("{count} {kind}"))
            .collect();
        match &counts[..] {
            [] => return writeln!(out, "transitions: 0"),
            counts => writeln!(out, "transitions: {} ({})", self.count(), counts.join(", "))?,
        }
        writeln!(out)?;
        self.table().print()?;
        match self.count() - self.first.len() as u64 {
            0 => {}
            more => writeln!(out, "… and {more} more, which transitions.csv lists")?,
        }
        writeln!(out)
    }

    /// The first transitions; columns that would be empty are left out.
    fn table(&self) -> Table {
        let header = ["t", "interface", "g", "kind", "mode", "state"].map(str::to_owned);
        let times = times(&self.first.iter().map(|one| one.t).collect::<Vec<_>>());
        let rows = self.first.iter().zip(times);
        let rows = rows.map(|(crossed, t)| self.row(crossed, t));
        let rows: Vec<[String; 6]> = rows.collect();
        let used = |column: &usize| rows.iter().any(|row| !row[*column].is_empty());
        let columns: Vec<usize> = (0..header.len()).filter(used).collect();
        let chosen = |row: &[String; 6]| -> Vec<String> {
            columns.iter().map(|&column| row[column].clone()).collect()
        };
        let mut table = Table::new(columns.len(), chosen(&header));
        rows.iter().for_each(|row| table.row(chosen(row)));
        table
    }

    fn row(&self, crossed: &Crossed, t: String) -> [String; 6] {
        let direction = if crossed.rate_from > 0.0 {
            "rises"
        } else {
            "falls"
        };
        let name = self.problem.metadata().guard_name(crossed.interface);
        [
            t,
            shortened(name),
            direction.to_owned(),
            crossed.kind.name().to_owned(),
            mode::change(self.problem, &crossed.from, &crossed.to),
            self.jump(crossed),
        ]
    }

    /// What has become of the states that a jump changes.
    fn jump(&self, crossed: &Crossed) -> String {
        let sides = crossed.x.iter().zip(&crossed.after);
        let states = self.problem.states().iter().zip(sides);
        let changed = states.filter(|(_, (before, after))| before != after);
        let mut texts: Vec<String> = changed
            .map(|(name, (&before, &after))| {
                format!(
                    "{name} {} → {}",
                    output::short(before),
                    output::short(after)
                )
            })
            .collect();
        if texts.len() > MOST_STATES {
            let more = texts.len() - (MOST_STATES - 1);
            texts.truncate(MOST_STATES - 1);
            texts.push(format!("{more} more"));
        }
        texts.join(", ")
    }
}

/// A name, the end of a long one left out.
fn shortened(name: &str) -> String {
    if name.chars().count() <= LONGEST_NAME {
        return name.to_owned();
    }
    let kept: String = name.chars().take(LONGEST_NAME - 1).collect();
    format!("{kept}…")
}

/// Times with the same digits behind the point, one below the other.
fn times(times: &[f64]) -> Vec<String> {
    let largest = times
        .iter()
        .fold(0.0, |largest: f64, t| largest.max(t.abs()));
    let places = (DIGITS - 1).saturating_sub(largest.log10().floor() as i32);
    let texts: Vec<String> = if (0..2 * DIGITS).contains(&places) {
        times
            .iter()
            .map(|t| format!("{t:.*}", places as usize))
            .collect()
    } else {
        times.iter().copied().map(output::number).collect()
    };
    let width = texts.iter().map(String::len).max().unwrap_or_default();
    texts.iter().map(|text| format!("{text:>width$}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_stand_one_below_the_other() {
        assert_eq!(times(&[0.5, 12.0]), [" 0.5000000", "12.0000000"]);
        assert_eq!(times(&[3e-12]), ["3e-12"]);
        assert_eq!(times(&[0.0]), ["0"]);
        assert_eq!(times(&[2.0, 1e9]), ["         2", "1000000000"]);
    }

    #[test]
    fn long_names_are_shortened() {
        assert_eq!(shortened("floor"), "floor");
        assert_eq!(shortened(&"a".repeat(50)).chars().count(), LONGEST_NAME);
    }
}
