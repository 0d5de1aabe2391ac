//! A process that compiles cases and writes a line about each.

use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::thread;

use super::Options;
use crate::fuzz::watch::{Outcome, WORKER};
use crate::fuzz::{STACK_SIZE, Seeds, check};

/// Compiles every case of its turn.
pub(crate) fn worker(options: &Options) -> ExitCode {
    let options = options.clone();
    on_small_stack(move || {
        let seeds = Seeds::load();
        let end = options.first + options.cases;
        let mut output = std::io::stdout().lock();
        let mut index = options.first;
        while index < end {
            let (time, outcome) = check(&seeds.case(options.seed, index).text);
            let outcome = match outcome {
                Ok(Outcome::Accepted) => "accepted".to_owned(),
                Ok(Outcome::Refused) => "refused".to_owned(),
                Ok(Outcome::NotTokens) => "not-tokens".to_owned(),
                Err(failure) => failure.message().replace('\n', " "),
            };
            let line = writeln!(output, "{} {outcome}", time.as_micros());
            if line.and_then(|()| output.flush()).is_err() {
                return false;
            }
            index += options.jobs;
        }
        writeln!(output, "end").is_ok()
    })
}

/// Compiles one file.
pub(crate) fn single(file: &Path) -> ExitCode {
    let text = match std::fs::read_to_string(file) {
        Ok(text) => text,
        Err(error) => {
            eprintln!("{}: {error}", file.display());
            return ExitCode::from(2);
        }
    };
    on_small_stack(move || {
        let (time, outcome) = check(&text);
        match outcome {
            Ok(outcome) => {
                println!("{outcome:?} in {time:.1?}");
                true
            }
            Err(failure) => {
                println!("{}", failure.message());
                false
            }
        }
    })
}

/// Runs `work`, which says whether all is well, on a thread with the stack of a macro.
fn on_small_stack(work: impl FnOnce() -> bool + Send + 'static) -> ExitCode {
    let thread = thread::Builder::new()
        .name(WORKER.into())
        .stack_size(STACK_SIZE)
        .spawn(work);
    match thread.map(thread::JoinHandle::join) {
        Ok(Ok(true)) => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}
