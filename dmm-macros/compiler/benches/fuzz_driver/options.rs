//! The command line.

use std::path::PathBuf;
use std::thread;

/// What to do.
#[derive(Debug, Clone)]
pub(crate) struct Options {
    /// The number of cases.
    pub(crate) cases: u64,
    /// What they are made from.
    pub(crate) seed: u64,
    /// The number of the first.
    pub(crate) first: u64,
    /// The number of processes; cases are dealt out in turns.
    pub(crate) jobs: u64,
    /// Where failures are kept.
    pub(crate) save: Option<PathBuf>,
    /// Compile this file and nothing else.
    pub(crate) check: Option<PathBuf>,
    /// Print this case and nothing else.
    pub(crate) show: Option<u64>,
    /// Whether this is one of the processes that compile cases.
    pub(crate) is_worker: bool,
}

impl Options {
    /// The options in `arguments`, or what is wrong with them.
    pub(crate) fn read(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut options = Self {
            cases: 1000,
            seed: 1,
            first: 0,
            jobs: thread::available_parallelism().map_or(1, |count| count.get() as u64),
            save: None,
            check: None,
            show: None,
            is_worker: false,
        };
        while let Some(name) = arguments.next() {
            if name == "--worker" {
                options.is_worker = true;
                continue;
            }
            let value = arguments.next().ok_or(format!("{name} needs a value"))?;
            let number = || value.parse().map_err(|_| format!("{name} needs a number"));
            match name.as_str() {
                "--cases" => options.cases = number()?,
                "--seed" => options.seed = number()?,
                "--first" => options.first = number()?,
                "--jobs" => options.jobs = number()?.max(1),
                "--save" => options.save = Some(value.into()),
                "--show" => options.show = Some(number()?),
                "--check" => options.check = Some(value.into()),
                _ => return Err(format!("there is no option {name}")),
            }
        }
        Ok(options)
    }
}
