//! The long run: processes that compile cases, one that watches them, and the table.

mod minimise;
mod options;
mod tally;
mod worker;

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, ExitCode, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

use crate::fuzz::Seeds;
pub(crate) use options::Options;
use tally::Tally;
pub(crate) use worker::{single, worker};

/// A process that says nothing for so long hangs: a case may take 2 s of processor time twice
/// over, on a machine with other work to do.
const HANG: Duration = Duration::from_secs(60);

/// Runs all cases and prints what became of them.
pub(crate) fn run(options: &Options) -> ExitCode {
    let start = Instant::now();
    let (events, receive) = mpsc::channel();
    let supervisors: Vec<_> = (0..options.jobs)
        .map(|job| {
            let (options, events) = (options.clone(), events.clone());
            thread::spawn(move || supervise(&options, job, &events))
        })
        .collect();
    drop(events);
    let mut tally = Tally::new(options);
    for event in receive {
        tally.add(event);
    }
    for supervisor in supervisors {
        if supervisor.join().is_err() {
            eprintln!("a supervising thread panicked");
            return ExitCode::from(2);
        }
    }
    let seeds = Seeds::load();
    tally.print(&seeds, start.elapsed());
    if tally.is_clean() {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// What became of a case.
pub(crate) struct Event {
    /// The number of the case.
    pub(crate) index: u64,
    /// What the worker says: `accepted`, `refused`, `not-tokens`, or what is wrong.
    pub(crate) outcome: String,
    /// Its processor time.
    pub(crate) time: Duration,
}

/// Keeps a process running until all cases of `job` have been compiled.
fn supervise(options: &Options, job: u64, events: &Sender<Event>) {
    let end = options.first + options.cases;
    let mut next = options.first + job;
    while next < end {
        let mut child = match start_worker(options, next, end) {
            Ok(child) => child,
            Err(error) => {
                eprintln!("a process could not be started: {error}");
                return;
            }
        };
        next = watch(&mut child, next, options.jobs, events);
        // it has ended, or hangs
        drop(child.kill());
        drop(child.wait());
    }
}

fn start_worker(options: &Options, first: u64, end: u64) -> std::io::Result<Child> {
    Command::new(std::env::current_exe()?)
        .arg("--worker")
        .args(["--seed", &options.seed.to_string()])
        .args(["--first", &first.to_string()])
        .args(["--cases", &(end - first).to_string()])
        .args(["--jobs", &options.jobs.to_string()])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
}

/// Passes on what a process says; the case after the one that it ended with.
fn watch(child: &mut Child, first: u64, jobs: u64, events: &Sender<Event>) -> u64 {
    let Some(output) = child.stdout.take() else {
        return u64::MAX;
    };
    let (lines, receive) = mpsc::channel();
    let reader = thread::spawn(move || {
        for line in BufReader::new(output).lines().map_while(Result::ok) {
            if lines.send(line).is_err() {
                return;
            }
        }
    });
    let mut next = first;
    let outcome = loop {
        match receive.recv_timeout(HANG) {
            Ok(line) if line == "end" => return u64::MAX,
            Ok(line) => {
                if let Some(event) = parse(&line, next) {
                    drop(events.send(event));
                    next += jobs;
                }
            }
            Err(RecvTimeoutError::Timeout) => break "hang",
            Err(RecvTimeoutError::Disconnected) => break "crash (stack overflow)",
        }
    };
    drop(child.kill());
    drop(reader.join());
    drop(events.send(Event {
        index: next,
        outcome: outcome.to_owned(),
        time: HANG,
    }));
    next + jobs
}

/// `microseconds outcome`
fn parse(line: &str, index: u64) -> Option<Event> {
    let (time, outcome) = line.split_once(' ')?;
    Some(Event {
        index,
        outcome: outcome.to_owned(),
        time: Duration::from_micros(time.parse().ok()?),
    })
}
