//! How many runs ended how.

use std::collections::BTreeMap;

use crate::judge::Class;
use dmm_problems::stress::{Row, Verdict};

/// Undue refusals that are allowed, a part of all runs.
const MOST_REFUSALS: f64 = 1e-3;

/// The runs of a family with a scheme.
#[derive(Clone, Default, Debug)]
pub(super) struct Tally {
    same: usize,
    near: usize,
    /// The largest margin of those.
    widest: f64,
    refused_near: BTreeMap<&'static str, usize>,
    refused: BTreeMap<&'static str, usize>,
    first_refused: Option<String>,
    silent: usize,
    first_silent: Option<String>,
}

impl Tally {
    /// Counts a run; `what` describes it so that it can be made again.
    pub(super) fn count(&mut self, class: Class, what: impl FnOnce() -> String) {
        match class {
            Class::Same => self.same += 1,
            Class::Near(margin) => {
                self.near += 1;
                self.widest = self.widest.max(margin);
            }
            Class::RefusedNear(kind) => *self.refused_near.entry(kind).or_default() += 1,
            Class::Refused(kind, finding) => {
                *self.refused.entry(kind).or_default() += 1;
                self.first_refused
                    .get_or_insert_with(|| format!("{kind} {finding}: {}", what()));
            }
            Class::Silent(finding) => {
                self.silent += 1;
                self.first_silent
                    .get_or_insert_with(|| format!("{finding}: {}", what()));
            }
        }
    }

    /// Adds others, but for their descriptions.
    pub(super) fn add(&mut self, other: &Self) {
        self.same += other.same;
        self.near += other.near;
        self.widest = self.widest.max(other.widest);
        self.silent += other.silent;
        for (own, more) in [
            (&mut self.refused_near, &other.refused_near),
            (&mut self.refused, &other.refused),
        ] {
            for (kind, count) in more {
                *own.entry(kind).or_default() += count;
            }
        }
    }

    /// Runs that were refused away from tangencies and accumulations, in parts of all.
    fn refusals(&self) -> f64 {
        let refused = sum(&self.refused);
        let all = self.same + self.near + self.silent + sum(&self.refused_near) + refused;
        refused as f64 / all.max(1) as f64
    }

    /// Whether a run was stopped as if the solution slid where it does not.
    pub(super) fn tells_of_sliding(&self) -> bool {
        self.refused.contains_key("sliding")
    }

    fn verdict(&self) -> Verdict {
        if self.silent > 0 {
            Verdict::Wrong
        } else if self.refusals() <= MOST_REFUSALS {
            Verdict::Survived
        } else {
            Verdict::Refused
        }
    }

    /// The row of a family with a scheme.
    pub(super) fn row(&self, case: &str, scheme: &str) -> Row {
        let mut finding = format!("{} same", self.same);
        if self.near > 0 {
            finding.push_str(&format!(
                ", {} near a tangency of at most {:.0e}",
                self.near, self.widest
            ));
        }
        for (refused, place) in [(&self.refused_near, " there"), (&self.refused, "")] {
            if !refused.is_empty() {
                let kinds: Vec<String> = refused
                    .iter()
                    .map(|(kind, count)| format!("{kind} {count}"))
                    .collect();
                let count = sum(refused);
                finding.push_str(&format!(", {count} refused{place} ({})", kinds.join(", ")));
            }
        }
        finding.push_str(&format!(", {} wrong in silence", self.silent));
        for first in [&self.first_silent, &self.first_refused]
            .into_iter()
            .flatten()
        {
            finding.push_str(&format!("; {first}"));
        }
        Row::new(case, scheme, self.verdict(), finding)
    }
}

fn sum(counts: &BTreeMap<&'static str, usize>) -> usize {
    counts.values().sum()
}
