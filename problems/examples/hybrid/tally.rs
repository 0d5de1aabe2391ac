//! How many runs ended how.

use std::collections::BTreeMap;

use crate::judge::Outcome;
use crate::reference::{Kind, Solution};

/// So many of a kind are described.
const SHOWN: usize = 3;

/// The runs of a family by a scheme.
#[derive(Clone, Default, Debug)]
pub(crate) struct Tally {
    pub(crate) same: usize,
    confirmed: BTreeMap<String, usize>,
    degenerate: BTreeMap<String, usize>,
    undecided: BTreeMap<&'static str, usize>,
    refused: BTreeMap<String, usize>,
    pub(crate) silent: usize,
    /// Transitions of the runs that were the same, by kind.
    kinds: [usize; 4],
}

impl Tally {
    /// Counts a run; `what` describes it so that it can be made again.
    pub(crate) fn count(
        &mut self,
        outcome: Outcome,
        solution: &Solution,
        what: impl FnOnce() -> String,
    ) {
        match outcome {
            Outcome::Same => {
                self.same += 1;
                for one in &solution.passed {
                    let kinds = [Kind::Crossed, Kind::Jumped, Kind::Began, Kind::Left];
                    for (count, kind) in self.kinds.iter_mut().zip(kinds) {
                        *count += usize::from(one.kind == kind);
                    }
                }
            }
            Outcome::Confirmed(kind) => *self.confirmed.entry(kind).or_default() += 1,
            Outcome::Degenerate(kind) => *self.degenerate.entry(kind).or_default() += 1,
            Outcome::Undecided(reason) => *self.undecided.entry(reason).or_default() += 1,
            Outcome::Refused(kind, text) => {
                let count = self.refused.entry(kind).or_default();
                *count += 1;
                if *count <= SHOWN {
                    println!("refused: {text}{}", what());
                }
            }
            Outcome::Silent(text) => {
                self.silent += 1;
                if self.silent <= SHOWN {
                    println!("different in silence: {text}{}", what());
                }
            }
        }
    }

    /// Adds others.
    pub(crate) fn add(&mut self, other: &Self) {
        self.same += other.same;
        self.silent += other.silent;
        for (own, more) in [
            (&mut self.confirmed, &other.confirmed),
            (&mut self.degenerate, &other.degenerate),
            (&mut self.refused, &other.refused),
        ] {
            for (kind, count) in more {
                *own.entry(kind.clone()).or_default() += count;
            }
        }
        for (reason, count) in &other.undecided {
            *self.undecided.entry(reason).or_default() += count;
        }
        for (own, more) in self.kinds.iter_mut().zip(other.kinds) {
            *own += more;
        }
    }

    /// What stands above the rows.
    pub(crate) fn head() -> String {
        format!(
            "{:<15} {:<17} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9}  {}",
            "family",
            "scheme",
            "runs",
            "same",
            "refused",
            "unclear",
            "refused",
            "different",
            "crossed, jumped,"
        ) + &format!(
            "\n{:<15} {:<17} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9}  {}",
            "", "", "", "", "rightly", "", "wrongly", "silently", "began and left sliding"
        )
    }

    /// The row of a family by a scheme.
    pub(crate) fn row(&self, family: &str, scheme: &str) -> String {
        let sum = |counts: &BTreeMap<String, usize>| counts.values().sum::<usize>();
        let unclear = self.undecided.values().sum::<usize>() + sum(&self.degenerate);
        let (confirmed, refused) = (sum(&self.confirmed), sum(&self.refused));
        let runs = self.same + confirmed + unclear + refused + self.silent;
        let [crossed, jumped, began, left] = self.kinds;
        format!(
            "{family:<15} {scheme:<17} {runs:>7} {:>8} {confirmed:>8} {unclear:>8} {refused:>8} {:>9}  {crossed}, {jumped}, {began}, {left}",
            self.same, self.silent
        )
    }

    /// The kinds of what was no agreement.
    pub(crate) fn kinds(&self) -> String {
        let list = |counts: &BTreeMap<String, usize>| {
            let parts = counts.iter().map(|(kind, count)| format!("{kind} {count}"));
            parts.collect::<Vec<String>>().join(", ")
        };
        let reasons = self.undecided.iter();
        let reasons = reasons.map(|(reason, count)| ((*reason).to_owned(), *count));
        format!(
            "refused rightly: {}\nunclear, and refused: {}\nunclear, and not refused: {}\nrefused wrongly: {}",
            list(&self.confirmed),
            list(&self.degenerate),
            list(&reasons.collect()),
            list(&self.refused)
        )
    }
}
