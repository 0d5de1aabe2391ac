//! A short run of the fuzzer, and what it found before.
//!
//! The long run is `cargo bench --profile dev -p dmm-compiler --bench fuzz -- --cases 100000 --seed 1`.

#[path = "support/corpus.rs"]
mod corpus;
#[path = "fuzz/mod.rs"]
mod fuzz;

use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use fuzz::{Case, STACK_SIZE, Seeds, check, kinds, watch};

/// The cases of the short run, a few seconds of them.
const CASES: u64 = 400;
/// A case that takes longer than this on the wall hangs: ten times what it may take, for busy
/// machines.
const HANG: Duration = Duration::from_secs(20);

/// Runs cases on a thread with the stack of a macro; what went wrong, with the text.
fn failures(cases: Vec<Case>) -> Vec<String> {
    let (results, receive) = mpsc::channel();
    let work = cases.clone();
    thread::Builder::new()
        .name(watch::WORKER.into())
        .stack_size(STACK_SIZE)
        .spawn(move || {
            for case in work {
                let (_, outcome) = check(&case.text);
                if results.send(outcome).is_err() {
                    return;
                }
            }
        })
        .expect("a thread");
    let mut failures = Vec::new();
    for case in cases {
        let message = match receive.recv_timeout(HANG) {
            Ok(Ok(_)) => continue,
            Ok(Err(failure)) => failure.message(),
            Err(error) => format!("hang: {error}"),
        };
        failures.push(format!("{message}\n{}:\n{}", kinds()[case.kind], case.text));
        if message.starts_with("hang") {
            break;
        }
    }
    failures
}

#[test]
fn no_input_panics_or_hangs() {
    let seeds = Seeds::load();
    let cases = (0..CASES).map(|index| seeds.case(1, index)).collect();
    let failures = failures(cases);
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

#[test]
fn what_failed_once_is_right_now() {
    let directory = corpus::package().join("tests/fuzz/regressions");
    let files = corpus::files(&directory, "pws");
    let cases = files.iter().map(|file| Case {
        kind: 0,
        text: corpus::read(file),
    });
    let failures = failures(cases.collect());
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

#[test]
fn the_same_seed_gives_the_same_cases() {
    let seeds = Seeds::load();
    let text = |seed, index| seeds.case(seed, index).text;
    let run: Vec<String> = (0..50).map(|index| text(7, index)).collect();
    let again: Vec<String> = (0..50).map(|index| text(7, index)).collect();
    let other: Vec<String> = (0..50).map(|index| text(8, index)).collect();
    assert_eq!(run, again);
    assert!(run.iter().zip(&other).filter(|(a, b)| a == b).count() < 5);
}
