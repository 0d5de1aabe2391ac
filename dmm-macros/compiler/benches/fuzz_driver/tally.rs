//! The table of what became of the cases.

use std::collections::BTreeMap;
use std::time::Duration;

use super::{Event, Options, minimise};
use crate::fuzz::{Seeds, kinds};

/// The slowest cases are shown, this many.
const SLOWEST: usize = 5;
/// Failures of one message are made short this often; the others are counted.
const SHORTENED: usize = 2;

/// What became of the cases so far.
pub(crate) struct Tally {
    options: Options,
    done: u64,
    /// accepted, refused, not tokens, failed
    outcomes: BTreeMap<u64, usize>,
    slowest: Vec<(Duration, u64)>,
    failures: Vec<Event>,
    total: Duration,
}

/// The columns of the table.
const COLUMNS: [&str; 4] = ["accepted", "refused", "not tokens", "failed"];

impl Tally {
    pub(crate) fn new(options: &Options) -> Self {
        Self {
            options: options.clone(),
            done: 0,
            outcomes: BTreeMap::new(),
            slowest: Vec::new(),
            failures: Vec::new(),
            total: Duration::ZERO,
        }
    }

    pub(crate) fn add(&mut self, event: Event) {
        let column = match event.outcome.as_str() {
            "accepted" => 0,
            "refused" => 1,
            "not-tokens" => 2,
            _ => 3,
        };
        self.done += 1;
        self.total += event.time;
        self.outcomes.insert(event.index, column);
        self.slowest.push((event.time, event.index));
        self.slowest.sort_by(|a, b| b.cmp(a));
        self.slowest.truncate(SLOWEST);
        if column == 3 {
            eprintln!("case {}: {}", event.index, event.outcome);
            self.failures.push(event);
        }
        if self.done.is_multiple_of(5000) {
            let failed = self.failures.len();
            eprintln!(
                "{} of {} cases, {failed} failed",
                self.done, self.options.cases
            );
        }
    }

    pub(crate) fn is_clean(&self) -> bool {
        self.failures.is_empty() && self.done == self.options.cases
    }

    pub(crate) fn print(&self, seeds: &Seeds, elapsed: Duration) {
        self.print_counts(seeds);
        println!("\nslowest cases, in processor time of one compilation");
        for &(time, index) in &self.slowest {
            let kind = kinds()[seeds.case(self.options.seed, index).kind];
            println!(
                "{:>10.1} ms  case {index}, {kind}",
                1e3 * time.as_secs_f64()
            );
        }
        let with = |start: &str| {
            let all = self.failures.iter();
            all.filter(|event| event.outcome.starts_with(start)).count()
        };
        println!(
            "\n{} cases of seed {} in {:.0?}, {:.2} ms each; panics {}, crashes {}, hangs {}, slow {}, wrong {}",
            self.done,
            self.options.seed,
            elapsed,
            1e3 * self.total.as_secs_f64() / self.done.max(1) as f64,
            with("panic"),
            with("crash"),
            with("hang"),
            with("slow"),
            with("wrong"),
        );
        self.print_failures(seeds);
    }

    fn print_counts(&self, seeds: &Seeds) {
        let names = kinds();
        let mut counts = vec![[0_usize; 4]; names.len()];
        for (&index, &column) in &self.outcomes {
            counts[seeds.case(self.options.seed, index).kind][column] += 1;
        }
        println!(
            "{:<26} {:>10} {:>10} {:>10} {:>10} {:>10}",
            "kind", "cases", COLUMNS[0], COLUMNS[1], COLUMNS[2], COLUMNS[3]
        );
        let row = |name: &str, counts: [usize; 4]| {
            let all: usize = counts.iter().sum();
            let [a, b, c, d] = counts;
            println!("{name:<26} {all:>10} {a:>10} {b:>10} {c:>10} {d:>10}");
        };
        for (name, &counts) in names.iter().zip(&counts) {
            row(name, counts);
        }
        let total = |column: usize| counts.iter().map(|row| row[column]).sum();
        row("all", [total(0), total(1), total(2), total(3)]);
    }

    /// The failures, each made as short as it can be.
    fn print_failures(&self, seeds: &Seeds) {
        let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
        for event in &self.failures {
            // numbers in a message differ from case to case
            let kind = event.outcome.split(|c: char| c.is_ascii_digit()).next();
            let count = seen.entry(kind.unwrap_or_default()).or_default();
            *count += 1;
            if *count > SHORTENED {
                continue;
            }
            let text = seeds.case(self.options.seed, event.index).text;
            let short = minimise::shorten(&text);
            println!("\ncase {}: {}\n{short}", event.index, event.outcome);
            if let Some(directory) = &self.options.save {
                let name = format!("seed_{}_case_{}.pws", self.options.seed, event.index);
                if let Err(error) = std::fs::write(directory.join(name), short) {
                    eprintln!("{}: {error}", directory.display());
                }
            }
        }
    }
}
