//! Fuzzes the macro's input: no token stream may panic, hang, or give what is not Rust.
//!
//! ```text
//! cargo bench --profile dev -p dmm-compiler --bench fuzz -- --cases 100000 --seed 1
//!     [--first N] [--jobs N] [--save DIRECTORY] [--check FILE] [--show N]
//! ```
//!
//! Cases are made from the seed and their number, and compiled in processes of their own, so
//! that a stack overflow or a hang is found out and the run goes on behind it. What fails is
//! printed after it has been made as short as it can be, and kept in the directory of `--save`.
//! `--check` compiles the declaration in one file, `--show` prints a case. Relative paths begin at
//! the folder of the package, in which cargo runs this. The exit code is 1 if anything failed.

mod arguments;
#[path = "../tests/support/corpus.rs"]
mod corpus;
#[path = "../tests/fuzz/mod.rs"]
mod fuzz;
#[path = "fuzz_driver/mod.rs"]
mod fuzz_driver;

use std::process::ExitCode;

use arguments::arguments;
use fuzz_driver::{Options, run, single, worker};

fn main() -> ExitCode {
    let options = match Options::read(arguments()) {
        Ok(options) => options,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    if let Some(index) = options.show {
        print!("{}", fuzz::Seeds::load().case(options.seed, index).text);
        ExitCode::SUCCESS
    } else if let Some(file) = &options.check {
        single(file)
    } else if options.is_worker {
        worker(&options)
    } else {
        run(&options)
    }
}
