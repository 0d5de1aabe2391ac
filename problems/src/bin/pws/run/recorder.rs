//! Listening to a run: its files, and what its pictures and its summary need.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use dmm_problems::problem::{AnyObserver, Crossed, OutputTimes, Problem, Record, Run};
use indicatif::ProgressBar;

use crate::failure::Failure;
use crate::output::Csv;
use crate::portrait::{Kept, Thinned};
use crate::progress;

/// The names of all conserved quantities of a problem: those of each region, once.
fn conserved_names(problem: &Problem) -> Vec<&'static str> {
    let mut names = Vec::new();
    for region in 0..problem.regions().len() {
        for &name in problem.conserved_names(region) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}

/// Writes the files of a run and keeps what the pictures need.
pub(super) struct Recorder<'a> {
    problem: &'a Problem,
    regions: Vec<&'static str>,
    /// For each region the columns of its conserved quantities.
    columns: Vec<Vec<usize>>,
    points: Csv,
    transitions: Csv,
    every: u64,
    /// Whether points of output are written, rather than the ends of steps.
    writes_outputs: bool,
    /// Points so far that could be written.
    offered: u64,
    records: u64,
    /// The last record, and whether it is in the file.
    last: Snapshot,
    written: bool,
    /// Its region.
    region: Option<usize>,
    kept: Vec<Kept>,
    keep_every: u64,
    errors: Vec<(String, Thinned)>,
    worst: (f64, f64),
    transition_count: u64,
    failure: Option<Failure>,
    bar: ProgressBar,
}

/// A record that outlives its run.
#[derive(Default)]
struct Snapshot {
    t: f64,
    x: Vec<f64>,
    region: usize,
    psi: Vec<f64>,
    size: Vec<f64>,
    level: Vec<f64>,
}

impl Snapshot {
    fn take(&mut self, record: &Record<'_>) {
        (self.t, self.region) = (record.t, record.region);
        let copy = |to: &mut Vec<f64>, from: &[f64]| {
            to.clear();
            to.extend_from_slice(from);
        };
        copy(&mut self.x, record.x);
        copy(&mut self.psi, record.psi);
        copy(&mut self.size, record.size);
        copy(&mut self.level, record.level);
    }

    fn record(&self) -> Record<'_> {
        Record {
            t: self.t,
            x: &self.x,
            region: self.region,
            psi: &self.psi,
            size: &self.size,
            level: &self.level,
            is_output: false,
        }
    }
}

/// Points kept for phase portrait and time series.
const LARGEST_KEPT: usize = 20_000;

/// What is left of a recorder.
pub(super) struct Finished {
    pub(super) files: Vec<PathBuf>,
    pub(super) kept: Vec<Kept>,
    pub(super) errors: Vec<(String, Vec<(f64, f64)>)>,
    pub(super) worst: (f64, f64),
    pub(super) transitions: u64,
    pub(super) t: f64,
}

impl<'a> Recorder<'a> {
    /// Opens the files.
    pub(super) fn create(
        problem: &'a Problem,
        run: &Run,
        every: u64,
        out: &Path,
    ) -> Result<Self, Failure> {
        let names = conserved_names(problem);
        let states = problem.states();
        let mut header = vec!["t".to_owned(), "region".to_owned()];
        header.extend(states.iter().map(|state| (*state).to_owned()));
        header.extend(names.iter().map(|name| (*name).to_owned()));
        header.extend(names.iter().map(|name| format!("{name}_error")));
        let points = Csv::create(out.join("points.csv"), &header)?;
        let mut header: Vec<&str> = vec!["t", "interface", "from", "to"];
        header.extend(states);
        header.extend(["rate_from", "rate_to"]);
        let transitions = Csv::create(out.join("transitions.csv"), &header)?;
        let column = |name: &&str| {
            names
                .iter()
                .position(|known| known == name)
                .unwrap_or_default()
        };
        let regions = problem.regions();
        let steps = run.t_end / run.step_size;
        let writes_outputs = run.output_times != OutputTimes::None;
        Ok(Self {
            problem,
            columns: (0..regions.len())
                .map(|region| problem.conserved_names(region).iter().map(column).collect())
                .collect(),
            regions,
            points,
            transitions,
            every,
            writes_outputs,
            // the start counts, and is no output
            offered: u64::from(writes_outputs),
            records: 0,
            last: Snapshot::default(),
            written: true,
            region: None,
            kept: Vec::new(),
            // room for transitions, which are all kept
            keep_every: (steps / (0.8 * LARGEST_KEPT as f64))
                .ceil()
                .clamp(1.0, 10.0) as u64,
            errors: names
                .iter()
                .map(|name| ((*name).to_owned(), Thinned::new()))
                .collect(),
            worst: (0.0, 0.0),
            transition_count: 0,
            failure: None,
            bar: progress::bar((run.t_end / run.step_size) as u64, steps),
        })
    }

    /// The fields of a row of points.
    fn fields(&self, record: &Record<'_>) -> Vec<String> {
        let mut fields = vec![record.t.to_string(), self.regions[record.region].to_owned()];
        fields.extend(record.x.iter().map(f64::to_string));
        let first = fields.len();
        let count = self.errors.len();
        fields.resize(first + 2 * count, String::new());
        for (k, &column) in self.columns[record.region].iter().enumerate() {
            fields[first + column] = record.psi[k].to_string();
            fields[first + count + column] = (record.psi[k] - record.level[k]).to_string();
        }
        fields
    }

    fn store(&mut self, record: &Record<'_>) -> Result<(), Failure> {
        let first = self.region != Some(record.region);
        if first && !self.written {
            // the near side of the transition
            self.points.row(self.fields(&self.last.record()))?;
        }
        let mut due = first;
        if record.is_output == self.writes_outputs {
            due |= self.offered.is_multiple_of(self.every);
            self.offered += 1;
        }
        if due {
            self.points.row(self.fields(record))?;
        }
        // an output at the end of a step is that point
        self.written = due || (self.written && record.t == self.last.t);
        self.last.take(record);
        Ok(())
    }

    fn keep(&mut self, record: &Record<'_>) {
        let changed = self.region != Some(record.region);
        let due = changed || self.records.is_multiple_of(self.keep_every);
        if due && self.kept.len() < LARGEST_KEPT {
            let (t, x) = (record.t, record.x.to_vec());
            if changed && let Some(region) = self.region {
                let x = x.clone();
                self.kept.push(Kept { t, x, region });
            }
            let region = record.region;
            self.kept.push(Kept { t, x, region });
        }
        for (k, &column) in self.columns[record.region].iter().enumerate() {
            let error = record.psi[k] - record.level[k];
            self.errors[column].1.offer(record.t, error);
        }
        self.worst.0 = self.worst.0.max(record.error());
        self.worst.1 = self.worst.1.max(record.error_ulps());
    }

    /// Writes what is left.
    pub(super) fn finish(mut self) -> Result<Finished, Failure> {
        self.bar.finish_and_clear();
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        if !self.written {
            self.points.row(self.fields(&self.last.record()))?;
        }
        let t = self.last.t;
        let mut files = vec![self.points.finish()?];
        let transitions = self.transitions.finish()?;
        if !self.problem.interfaces().is_empty() {
            files.push(transitions);
        } else {
            // a smooth system has none: no file that says only that
            let _ = std::fs::remove_file(transitions);
        }
        let errors = self.errors.into_iter();
        Ok(Finished {
            files,
            kept: self.kept,
            errors: errors
                .map(|(name, thinned)| (name, thinned.points().to_vec()))
                .collect(),
            worst: self.worst,
            transitions: self.transition_count,
            t,
        })
    }

    /// Ends the run if a file cannot be written.
    fn go_on(&mut self, result: Result<(), Failure>) -> ControlFlow<()> {
        match result {
            Ok(()) => ControlFlow::Continue(()),
            Err(failure) => {
                self.failure = Some(failure);
                ControlFlow::Break(())
            }
        }
    }
}

impl AnyObserver for Recorder<'_> {
    fn record(&mut self, record: &Record<'_>) -> ControlFlow<()> {
        let result = self.store(record);
        self.keep(record);
        self.region = Some(record.region);
        self.records += 1;
        if self.records.is_multiple_of(1 << 14) {
            self.bar.set_position(self.records);
        }
        self.go_on(result)
    }

    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.transition_count += 1;
        let interface = self
            .problem
            .interfaces()
            .get(crossed.interface)
            .unwrap_or(&"");
        let mut fields = vec![
            crossed.t.to_string(),
            (*interface).to_owned(),
            self.regions[crossed.from].to_owned(),
            self.regions[crossed.to].to_owned(),
        ];
        fields.extend(crossed.x.iter().map(f64::to_string));
        fields.extend([crossed.rate_from.to_string(), crossed.rate_to.to_string()]);
        let result = self.transitions.row(&fields);
        self.go_on(result)
    }
}
