//! Crossings: random systems with switching functions of every kind, each run compared with a
//! slow solution in pairs of doubles whose signs of g are certain. No crossing is missed, none
//! invented.
//!
//! | file | |
//! |---|---|
//! | `families` | the systems, by `pws!` and in formulas |
//! | `schemes` | the schemes that are tried |
//! | `reference` | the slow solution; `signs` along it, by `interval`s; `series` of it, from `formula`s in `pairs` of doubles |
//! | `judge`, `tally` | what became of each run, and of all |
//! | `affine` | a study of affine systems alone |
//!
//! ```sh
//! cargo run --release -p dmm-crossings [-- crossings|affine] [--brief]
//! ```
//!
//! ends with a failure if anything was wrong in silence.

mod affine;
mod families;
mod formula;
mod interval;
mod judge;
mod pairs;
mod reference;
mod schemes;
mod series;
mod signs;
mod study;
mod tally;
#[cfg(test)]
mod tests;

use std::process::ExitCode;

use dmm_problems::stress::{Extent, Observe, Row, Verdict};

/// Prints each case as soon as it has ended.
#[derive(Default)]
struct Table {
    /// How many there were of each verdict.
    counts: [usize; 3],
}

impl Observe for Table {
    fn ended(&mut self, row: Row) {
        self.counts[row.verdict as usize] += 1;
        let verdict = row.verdict.describe();
        println!(
            "{:<50}  {:<16}  {verdict:<8}  {}",
            row.case, row.scheme, row.finding
        );
    }
}

fn main() -> ExitCode {
    let mut extent = Extent::Full;
    let mut studies = Vec::new();
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--brief" => extent = Extent::Brief,
            "crossings" | "affine" => studies.push(argument),
            _ => {
                eprintln!("`{argument}` is neither `crossings` nor `affine` nor `--brief`");
                return ExitCode::from(2);
            }
        }
    }
    let does = |name: &str| studies.is_empty() || studies.iter().any(|study| study == name);
    let mut table = Table::default();
    if does("crossings") {
        study::study(extent, &mut table);
    }
    if does("affine") {
        affine::study(extent, &mut table);
    }
    let [survived, refused, wrong] = table.counts;
    println!("\n{survived} survived, {refused} refused, {wrong} wrong");
    ExitCode::from(u8::from(
        wrong > 0 || table.counts[Verdict::Survived as usize] == 0,
    ))
}
