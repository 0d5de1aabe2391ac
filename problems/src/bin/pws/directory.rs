//! The place of results: a directory with the record `run.json`, which says what they are results
//! of. Results of the same request are replaced; others only with `--force`.

use std::fs;
use std::path::{Path, PathBuf};

use dmm_picture::{Format, Picture};
use dmm_problems::method::Control;
use dmm_problems::problem::{Problem, Run};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::failure::Failure;
use crate::output::{self, Csv};

/// Where results go, as it is asked for.
#[derive(clap::Args)]
pub(crate) struct DirectoryOptions {
    /// Directory of the results [default: output/PROBLEM/COMMAND, or output/COMMAND of many
    /// problems].
    #[arg(long, value_name = "DIRECTORY")]
    out: Option<PathBuf>,
    /// Overwrite other results that are there. Those of the same request, as `run.json` in the
    /// directory tells it, are overwritten anyway.
    #[arg(long)]
    force: bool,
}

/// The name of the record in a directory.
const RECORD: &str = "run.json";
/// What results end with.
const ENDINGS: [&str; 5] = ["csv", "parquet", "svg", "png", "json"];

/// What results are results of.
#[derive(Serialize, Deserialize)]
struct Record {
    /// The program with its version.
    program: String,
    /// The command as it was given.
    command: Vec<String>,
    /// What decides the results.
    request: Value,
    /// How the work ended.
    outcome: String,
    /// The files, for who reads them.
    files: Vec<String>,
}

/// A place of results that are being made.
pub(crate) struct Directory {
    path: PathBuf,
    record_path: PathBuf,
    record: Record,
    files: Vec<PathBuf>,
}

impl DirectoryOptions {
    /// The directory, for the results of `request` in files of these names without their endings.
    pub(crate) fn open(
        &self,
        default: impl AsRef<Path>,
        stems: &[&str],
        request: Value,
    ) -> Result<Directory, Failure> {
        let path = self.out.as_deref().unwrap_or(default.as_ref());
        let ending = path.extension().and_then(|ending| ending.to_str());
        if let Some(ending) = ending.filter(|ending| ENDINGS.contains(ending))
            && !path.is_dir()
        {
            return Err(Failure::Request(format!(
                "{}: `--out` names a directory here, which gets several files; leave `.{ending}` \
                 off",
                path.display()
            )));
        }
        let names = stems.iter().flat_map(|stem| {
            let endings = ["csv", "svg", "png"].iter();
            endings.map(move |ending| format!("{stem}.{ending}"))
        });
        let names: Vec<String> = names.collect();
        Directory::open(path, RECORD, &names, request, self.force)
    }
}

impl Directory {
    /// The directory `path` with the record `record`; other results in files of these names are
    /// overwritten if `force` says so.
    pub(crate) fn open(
        path: &Path,
        record: &str,
        names: &[String],
        request: Value,
        force: bool,
    ) -> Result<Self, Failure> {
        let record_path = path.join(record);
        let files = names.iter().map(|name| path.join(name));
        let present: Vec<PathBuf> = files.filter(|file| file.exists()).collect();
        if !force && let Some(reason) = occupied(&record_path, &present, &request) {
            return Err(Failure::Request(format!(
                "{} has other results: {reason}; add `--force` to overwrite them, or name another \
                 place with `--out`",
                path.display()
            )));
        }
        output::directory(path)?;
        for file in &present {
            fs::remove_file(file).map_err(|error| Failure::write(file, error))?;
        }
        let directory = Self {
            path: path.to_owned(),
            record_path,
            record: Record {
                program: concat!("pws ", env!("CARGO_PKG_VERSION")).to_owned(),
                command: std::env::args().skip(1).collect(),
                request,
                outcome: "unfinished".to_owned(),
                files: Vec::new(),
            },
            files: Vec::new(),
        };
        directory.write()?;
        Ok(directory)
    }

    /// The place of a file.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// A new table.
    pub(crate) fn csv(
        &self,
        name: &str,
        header: impl IntoIterator<Item = impl AsRef<[u8]>>,
    ) -> Result<Csv, Failure> {
        Csv::create(self.path(name), header)
    }

    /// Takes note of a finished file.
    pub(crate) fn add(&mut self, file: PathBuf) {
        self.files.push(file);
    }

    /// Draws `NAME.svg` or `NAME.png`.
    pub(crate) fn picture(
        &mut self,
        name: &str,
        picture: &Picture,
        format: Format,
    ) -> Result<(), Failure> {
        let path = self.path(&format!("{name}.{}", format.extension()));
        picture
            .write(&path, format)
            .map_err(|error| Failure::write(&path, error))?;
        self.files.push(path);
        Ok(())
    }

    /// Completes the record, and says which files were written.
    pub(crate) fn finish(mut self, outcome: &Result<(), Failure>) -> Result<(), Failure> {
        self.record.outcome = match outcome {
            Ok(()) => "complete".to_owned(),
            Err(failure) => failure.to_string(),
        };
        let names = self.files.iter().filter_map(|file| file.file_name());
        self.record.files = names
            .map(|name| name.to_string_lossy().into_owned())
            .collect();
        self.write()?;
        self.files.push(self.record_path);
        Ok(output::announce(&self.files)?)
    }

    fn write(&self) -> Result<(), Failure> {
        let failed = |error| Failure::write(&self.record_path, error);
        let text = serde_json::to_string_pretty(&self.record)
            .map_err(|error| failed(std::io::Error::from(error)))?;
        fs::write(&self.record_path, text + "\n").map_err(failed)
    }
}

/// What is there that would be lost: nothing where there is nothing, or results of the same
/// request.
fn occupied(record: &Path, present: &[PathBuf], request: &Value) -> Option<String> {
    let text = match fs::read_to_string(record) {
        Ok(text) => text,
        Err(_) => {
            let name = present.first()?.file_name()?.to_string_lossy().into_owned();
            let record = record.file_name()?.to_string_lossy().into_owned();
            return Some(format!("`{name}` without a `{record}` that tells of it"));
        }
    };
    let Ok(found) = serde_json::from_str::<Record>(&text) else {
        let name = record.file_name()?.to_string_lossy().into_owned();
        return Some(format!("`{name}` is not of this program"));
    };
    let others = differences(&found.request, request);
    if others.is_empty() {
        return None;
    }
    let command = found.command.join(" ");
    Some(format!(
        "`pws {command}` with another {}",
        others.join(", ")
    ))
}

/// The names of what differs between two requests.
fn differences(found: &Value, wanted: &Value) -> Vec<String> {
    let none = Map::new();
    let entries = |value: &'_ Value| value.as_object().cloned().unwrap_or_else(|| none.clone());
    let (found, wanted) = (entries(found), entries(wanted));
    let names = found.keys().chain(wanted.keys());
    let mut others: Vec<String> = names
        .filter(|name| found.get(*name) != wanted.get(*name))
        .map(|name| name.replace('_', " "))
        .collect();
    others.sort();
    others.dedup();
    others
}

/// What decides the results of a run.
pub(crate) fn of_run(problem: &Problem, run: &Run) -> Value {
    let states = problem.states().iter().copied();
    let initial = states.zip(run.initial.iter().copied());
    let mut request = of_problem(problem);
    add(
        &mut request,
        json!({ "initial state": object(initial), "level correction": run.level_correction }),
    );
    add(&mut request, of_scheme(run));
    add(&mut request, json!({ "end": run.t_end }));
    request
}

/// A problem with its parameters.
pub(crate) fn of_problem(problem: &Problem) -> Value {
    json!({
        "problem": problem.description().name,
        "declaration": problem.declaration(),
        "parameters": object(problem.parameters().into_iter()),
    })
}

/// A scheme and what decides its steps.
pub(crate) fn of_scheme(run: &Run) -> Value {
    let mut scheme = json!({ "scheme": run.method.name(), "step size": run.step_size });
    if run.method.control() == Control::Tolerance {
        add(&mut scheme, json!({ "tolerance": run.tolerance }));
    }
    scheme
}

/// Adds the entries of an object to another.
pub(crate) fn add(object: &mut Value, more: Value) {
    if let (Value::Object(object), Value::Object(more)) = (object, more) {
        object.extend(more);
    }
}

fn object<'a>(values: impl Iterator<Item = (&'a str, f64)>) -> Value {
    let entries = values.map(|(name, value)| (name.to_owned(), json!(value)));
    Value::Object(entries.collect())
}
