//! What the compiler proves: a line a conserved quantity of every declaration of the corpus.
//!
//! ```text
//! cargo bench --profile dev -p dmm-compiler --bench proof_table
//! ```
//!
//! The systems that hold come first, with the domain that a proof needs; then wrong ones, each
//! refuted with its residual and a point; then what is hard to prove. Times are those of the
//! stage of the proofs, the fastest of a few runs, in the profile that this is built with.

#[path = "../tests/support/corpus.rs"]
mod corpus;
#[path = "../tests/support/judgement.rs"]
mod judgement;

use std::time::Duration;

use corpus::Sample;
use judgement::{Judgement, Verdict, judge};

/// Every declaration is judged this often; the fastest run counts.
const RUNS: usize = 3;

fn main() {
    let total = section("problems of this repository", &corpus::problems())
        + section("systems that hold", &corpus::sound())
        + section("wrong declarations", &corpus::wrong())
        + section("hard to prove", &corpus::open());
    println!("\nproofs in total: {:.1} ms", 1e3 * total.as_secs_f64());
}

/// Prints a table, and the verdicts in a line below it.
fn section(title: &str, samples: &[Sample]) -> Duration {
    println!("\n{title}\n");
    println!(
        "{:<25} {:>8}  {:<24} {:<15} domain, or residual and point",
        "system", "ms", "quantity", "verdict"
    );
    let mut total = Duration::ZERO;
    let mut verdicts: Vec<Verdict> = Vec::new();
    for sample in samples {
        let judgement = fastest(&sample.source);
        print(&sample.name, &judgement);
        verdicts.extend(judgement.verdict());
        total += judgement.time;
    }
    let counts: Vec<String> = [
        Verdict::Proved,
        Verdict::ByConstruction,
        Verdict::Assumed,
        Verdict::Undecided,
        Verdict::Refuted,
        Verdict::Other,
    ]
    .into_iter()
    .map(|verdict| (verdict, verdicts.iter().filter(|&&v| v == verdict).count()))
    .filter(|&(_, count)| count > 0)
    .map(|(verdict, count)| format!("{count} {}", verdict.word()))
    .collect();
    println!("\n{} systems: {}", samples.len(), counts.join(", "));
    total
}

fn fastest(source: &str) -> Judgement {
    let mut best = judge(source);
    for _ in 1..RUNS {
        let next = judge(source);
        if next.time < best.time {
            best = next;
        }
    }
    best
}

fn print(name: &str, judgement: &Judgement) {
    for (index, statement) in judgement.statements.iter().enumerate() {
        let (name, time) = if index == 0 {
            (name, format!("{:.2}", 1e3 * judgement.time.as_secs_f64()))
        } else {
            ("", String::new())
        };
        let remark = match statement.verdict {
            // what stands in front is in the columns already
            Verdict::Refuted => after(&statement.remark, " = "),
            _ => &statement.remark,
        };
        println!(
            "{name:<25} {time:>8}  {:<24} {:<15} {remark}",
            statement.about,
            statement.verdict.word(),
        );
    }
}

fn after<'a>(text: &'a str, separator: &str) -> &'a str {
    text.split_once(separator).map_or(text, |(_, rest)| rest)
}
