//! Hybrid systems: random systems with switches, regions, friction, jumps and sliding, each run
//! compared with a slow solution that shares no code with the library.
//!
//! | file | |
//! |---|---|
//! | `families`, `parts` | the systems, as data (`plant`), and their declarations (`text`) |
//! | `motion` | the field in a mode, with the weights of the mean while it slides |
//! | `reference` | the slow solution, by steps of order 10 (`flow`); `decide` tells the next mode |
//! | `run` | runs by the library |
//! | `judge`, `tally` | what became of each run, and of all |
//!
//! ```sh
//! cargo run --release -p dmm-problems --example hybrid [-- --runs 100000 --seed 1]
//! ```
//!
//! ends with a failure if anything was different in silence.

mod decide;
mod families;
mod flow;
mod judge;
mod motion;
mod parts;
mod plant;
mod reference;
mod run;
mod study;
mod tally;
#[cfg(test)]
mod tests;
mod text;

use std::process::ExitCode;

use study::Campaign;

fn main() -> ExitCode {
    let mut campaign = Campaign::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let value = arguments.next();
        let number = value.as_deref().and_then(|value| value.parse().ok());
        match (argument.as_str(), number) {
            ("--runs", Some(runs)) => campaign.runs = runs as usize,
            ("--seed", Some(seed)) => campaign.seed = seed,
            ("--only", Some(index)) => campaign.only = Some(index as usize),
            _ => {
                eprintln!("there are `--runs N`, `--seed S` and `--only NUMBER`");
                return ExitCode::from(2);
            }
        }
    }
    let total = campaign.make();
    ExitCode::from(u8::from(total.silent > 0 || total.same == 0))
}
