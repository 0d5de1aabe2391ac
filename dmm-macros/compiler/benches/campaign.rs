//! Right and wrong declarations in disguise: what the compiler says, against what is so.
//!
//! ```text
//! cargo bench -p dmm-compiler --bench campaign -- --cases 10000 --seed 1
//!     [--first N] [--show N] [--list CLASS]
//! ```
//!
//! Each case starts from a system with a known conserved quantity and is written in other ways
//! by random identities; half of them have a small change as well. What is so is decided in 120
//! digits, apart from the compiler's normal form. A table of classes is printed, by family.
//! `--show` prints a case; `--list` prints the cases of a class, by words of its column such as
//! `right/undecided`. The exit code is 1 if something right was refuted or something wrong
//! proved, or if more than 1 % of what is right is undecided.

mod arguments;
#[path = "../tests/campaign/mod.rs"]
mod campaign;

use std::collections::BTreeMap;
use std::process::ExitCode;

use arguments::arguments;
use campaign::truth::Truth;
use campaign::{Answer, Case, Disguise, FAMILIES};

/// Columns of the table: what is so, and what was said.
const COLUMNS: [(&str, Truth, &[Answer]); 10] = [
    ("right/proved", Truth::Holds, &[Answer::Proved]),
    ("right/work", Truth::Holds, &[Answer::OutOfWork]),
    ("right/undecided", Truth::Holds, &[Answer::NotDecided]),
    ("right/refuted", Truth::Holds, &[Answer::Refuted]),
    ("right/other", Truth::Holds, &[Answer::Other]),
    ("wrong/proved", Truth::Fails, &[Answer::Proved]),
    ("wrong/refuted", Truth::Fails, &[Answer::Refuted]),
    (
        "wrong/undecided",
        Truth::Fails,
        &[Answer::OutOfWork, Answer::NotDecided],
    ),
    ("wrong/other", Truth::Fails, &[Answer::Other]),
    (
        "no points",
        Truth::Open,
        &[
            Answer::Proved,
            Answer::OutOfWork,
            Answer::NotDecided,
            Answer::Refuted,
            Answer::Other,
        ],
    ),
];

struct Options {
    cases: u64,
    seed: u64,
    first: u64,
    show: Option<u64>,
    list: Option<String>,
}

impl Options {
    fn read(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut options = Self {
            cases: 10_000,
            seed: 1,
            first: 0,
            show: None,
            list: None,
        };
        while let Some(option) = arguments.next() {
            let value = arguments
                .next()
                .ok_or_else(|| format!("{option} wants a value"))?;
            let number = || {
                value
                    .parse::<u64>()
                    .map_err(|error| format!("{option}: {error}"))
            };
            match option.as_str() {
                "--cases" => options.cases = number()?,
                "--seed" => options.seed = number()?,
                "--first" => options.first = number()?,
                "--show" => options.show = Some(number()?),
                "--list" => options.list = Some(value),
                _ => return Err(format!("no option {option}")),
            }
        }
        Ok(options)
    }
}

fn main() -> ExitCode {
    let options = match Options::read(arguments()) {
        Ok(options) => options,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    let disguise = Disguise::new();
    if let Some(index) = options.show {
        println!("{:#?}", campaign::case(&disguise, options.seed, index));
        return ExitCode::SUCCESS;
    }
    let mut table = Table::default();
    for index in options.first..options.first + options.cases {
        let case = campaign::case(&disguise, options.seed, index);
        table.add(index, &case, options.list.as_deref());
    }
    table.print();
    table.exit_code()
}

#[derive(Default)]
struct Table {
    /// By family and column.
    counts: BTreeMap<(usize, usize), usize>,
    conditions: usize,
    beyond: usize,
    unguarded: usize,
}

impl Table {
    fn add(&mut self, index: u64, case: &Case, list: Option<&str>) {
        let column = COLUMNS
            .iter()
            .position(|(_, truth, answers)| *truth == case.truth && answers.contains(&case.answer));
        let column = column.unwrap_or(COLUMNS.len() - 1);
        *self.counts.entry((case.family, column)).or_default() += 1;
        self.conditions += case.conditions;
        self.beyond += case.beyond;
        self.unguarded += case.unguarded;
        let is_listed = match list {
            Some("beyond") => case.unguarded > 0,
            Some(class) => COLUMNS[column].0 == class,
            None => matches!(COLUMNS[column].0, "right/refuted" | "wrong/proved"),
        };
        if is_listed {
            println!(
                "case {index}, {}: {}",
                FAMILIES[case.family], case.declaration
            );
            for remark in &case.remarks {
                println!("    {remark}");
            }
        }
    }

    fn count(&self, column: usize) -> usize {
        (0..FAMILIES.len())
            .map(|family| self.counts.get(&(family, column)).copied().unwrap_or(0))
            .sum()
    }

    fn print(&self) {
        print!("{:<24}", "");
        COLUMNS
            .iter()
            .for_each(|(title, ..)| print!(" {title:>15}"));
        println!();
        for (family, title) in FAMILIES.iter().enumerate() {
            print!("{title:<24}");
            for column in 0..COLUMNS.len() {
                let count = self.counts.get(&(family, column)).copied().unwrap_or(0);
                print!(" {count:>15}");
            }
            println!();
        }
        print!("{:<24}", "all");
        (0..COLUMNS.len()).for_each(|column| print!(" {:>15}", self.count(column)));
        println!("\n\nright and undecided: {:.2} %", self.undecided());
        println!(
            "conditions of proofs: {}; emitted code was run beyond {}; finite beyond a condition and not conserved there: {}",
            self.conditions, self.beyond, self.unguarded
        );
    }

    /// The part of what is right that is not decided, in percent.
    fn undecided(&self) -> f64 {
        let right: usize = (0..5).map(|column| self.count(column)).sum();
        let undecided = self.count(1) + self.count(2);
        100.0 * undecided as f64 / right.max(1) as f64
    }

    fn exit_code(&self) -> ExitCode {
        let is_wrong =
            self.count(3) > 0 || self.count(5) > 0 || self.undecided() > 1.0 || self.unguarded > 0;
        ExitCode::from(u8::from(is_wrong))
    }
}
