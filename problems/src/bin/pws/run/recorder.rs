//! Listening to a run: its files, and what its pictures and its summary need.

use std::ops::ControlFlow;
use std::path::PathBuf;

use dmm_problems::problem::{AnyMode, AnyObserver, Crossed, OutputTimes, Problem, Record, Run};

use super::itinerary::Itinerary;
use super::transitions::Transitions;
use crate::directory::Directory;
use crate::failure::Failure;
use crate::mode::{self, Modes};
use crate::output::{self, Csv};
use crate::portrait::{Kept, Mark};
use crate::progress::Progress;
use crate::series::Thinned;

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
    transitions: Transitions<'a>,
    every: u64,
    /// Whether points of output are written, rather than the ends of steps.
    writes_outputs: bool,
    /// Points so far that could be written.
    offered: u64,
    records: u64,
    /// The last record, and whether it is in the file.
    last: Snapshot,
    written: bool,
    /// Whether the next record is the far side of a transition, or the start.
    enters: bool,
    kept: Vec<Kept>,
    keep_every: u64,
    errors: Vec<(String, Thinned)>,
    worst: (f64, f64),
    modes: Modes<'a>,
    failure: Option<Failure>,
    is_interrupted: bool,
    t_end: f64,
    progress: Progress,
}

/// A record that outlives its run.
#[derive(Default)]
struct Snapshot {
    t: f64,
    x: Vec<f64>,
    mode: AnyMode,
    psi: Vec<f64>,
    size: Vec<f64>,
    level: Vec<f64>,
}

impl Snapshot {
    fn take(&mut self, record: &Record<'_>) {
        self.t = record.t;
        if self.mode != *record.mode {
            self.mode = record.mode.clone();
        }
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
            mode: &self.mode,
            psi: &self.psi,
            size: &self.size,
            level: &self.level,
            is_output: false,
        }
    }
}

/// Records from one word of progress to the next.
const TOLD: u64 = 16;

/// Points kept for phase portrait and time series.
const LARGEST_KEPT: usize = 20_000;
/// What is left of a recorder.
pub(super) struct Finished<'a> {
    /// A file that could not be written.
    pub(super) failure: Option<Failure>,
    /// Whether Ctrl-C ended the run.
    pub(super) is_interrupted: bool,
    pub(super) files: Vec<PathBuf>,
    pub(super) kept: Vec<Kept>,
    pub(super) errors: Vec<(String, Vec<(f64, f64)>)>,
    pub(super) worst: (f64, f64),
    pub(super) modes: Modes<'a>,
    /// The first transitions, for the pictures.
    pub(super) marks: Vec<Mark>,
    pub(super) itinerary: Itinerary<'a>,
    pub(super) t: f64,
}

impl<'a> Recorder<'a> {
    /// Opens the files.
    pub(super) fn create(
        problem: &'a Problem,
        run: &Run,
        every: u64,
        out: &Directory,
    ) -> Result<Self, Failure> {
        let names = conserved_names(problem);
        let states = problem.states();
        let mut header = vec!["t".to_owned(), "region".to_owned()];
        header.extend(states.iter().map(|state| (*state).to_owned()));
        let discrete = mode::discrete_names(problem).into_iter();
        header.extend(discrete.map(str::to_owned));
        header.extend(names.iter().map(|name| (*name).to_owned()));
        header.extend(names.iter().map(|name| format!("{name}_error")));
        let points = out.csv("points.csv", &header)?;
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
            transitions: Transitions::create(problem, out)?,
            every,
            writes_outputs,
            // the start counts, and is no output
            offered: u64::from(writes_outputs),
            records: 0,
            last: Snapshot::default(),
            written: true,
            enters: true,
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
            modes: Modes::new(problem),
            failure: None,
            is_interrupted: false,
            t_end: run.t_end,
            progress: Progress::new(problem.description().name),
        })
    }

    /// The fields of a row of points.
    fn fields(&self, record: &Record<'_>) -> Vec<String> {
        let mut fields = vec![
            output::number(record.t),
            self.regions[record.mode.region].to_owned(),
        ];
        fields.extend(record.x.iter().map(|&value| output::number(value)));
        let discrete = mode::discrete(self.problem, record.mode).into_iter();
        fields.extend(discrete.map(output::number));
        let first = fields.len();
        let count = self.errors.len();
        fields.resize(first + 2 * count, String::new());
        for (k, &column) in self.columns[record.mode.region].iter().enumerate() {
            fields[first + column] = output::number(record.psi[k]);
            fields[first + count + column] = output::number(record.psi[k] - record.level[k]);
        }
        fields
    }

    fn store(&mut self, record: &Record<'_>) -> Result<(), Failure> {
        if self.enters && !self.written {
            // the near side of the transition
            self.points.row(self.fields(&self.last.record()))?;
        }
        let mut due = self.enters;
        if record.is_output == self.writes_outputs {
            due |= self.offered.is_multiple_of(self.every);
            self.offered += 1;
        }
        if due {
            self.points.row(self.fields(record))?;
        }
        // an output at the end of a step is that point
        self.written = due || (self.written && record.t == self.last.t);
        Ok(())
    }

    /// Keeps a record for the pictures: of transitions both sides, else one at a time.
    fn keep(&mut self, record: &Record<'_>) {
        let kept_until = self.kept.last().map(|kept| kept.t);
        let due = self.records.is_multiple_of(self.keep_every) && kept_until != Some(record.t);
        if (self.enters || due) && self.kept.len() < LARGEST_KEPT {
            if self.enters && kept_until.is_some_and(|t| t != self.last.t) {
                let near = Kept::new(self.problem, &mut self.modes, &self.last.record());
                self.kept.push(near);
            }
            let kept = Kept::new(self.problem, &mut self.modes, record);
            self.kept.push(kept);
        }
        for (k, &column) in self.columns[record.mode.region].iter().enumerate() {
            let error = record.psi[k] - record.level[k];
            self.errors[column].1.offer(record.t, error);
        }
        self.worst.0 = self.worst.0.max(record.error());
        self.worst.1 = self.worst.1.max(record.error_ulps());
    }

    /// Writes what is left; a file that cannot be written leaves the rest as it is.
    pub(super) fn finish(mut self) -> Finished<'a> {
        self.progress.finish();
        let mut failure = self.failure.take();
        if !self.written && failure.is_none() {
            failure = self.points.row(self.fields(&self.last.record())).err();
        }
        let mut files = Vec::new();
        let (transitions, marks, itinerary) = self.transitions.into_parts();
        let tables = [Some(self.points), transitions];
        for table in tables.into_iter().flatten() {
            match table.finish() {
                Ok(file) => files.push(file),
                Err(error) => failure = failure.or(Some(error)),
            }
        }
        let errors = self.errors.into_iter();
        Finished {
            failure,
            is_interrupted: self.is_interrupted,
            files,
            kept: self.kept,
            errors: errors
                .map(|(name, thinned)| (name, thinned.points().to_vec()))
                .collect(),
            worst: self.worst,
            modes: self.modes,
            marks,
            itinerary,
            t: self.last.t,
        }
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
        self.last.take(record);
        self.enters = false;
        self.records += 1;
        if self.records.is_multiple_of(TOLD) && self.progress.at(record.t / self.t_end).is_break() {
            self.is_interrupted = true;
            return ControlFlow::Break(());
        }
        self.go_on(result)
    }

    fn transition(&mut self, crossed: &Crossed) -> ControlFlow<()> {
        self.enters = true;
        let result = self.transitions.take(crossed);
        self.go_on(result)
    }
}
