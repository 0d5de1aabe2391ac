//! The program `pws` as its user meets it.

mod directory;
mod ensemble;
mod fesd;
#[cfg(unix)]
mod interrupt;
mod refusals;
mod run;
mod show;
mod studies;
mod transitions;

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
use tempfile::TempDir;

fn pws(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("pws").unwrap();
    command.args(arguments);
    command
}

/// Standard output and standard error of a call that ends with exit status `status`.
fn texts(mut call: Command, status: i32) -> [String; 2] {
    let output = call.assert().code(status).get_output().clone();
    [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap())
}

/// Standard output of a successful call.
fn said(arguments: &[&str]) -> String {
    let [text, _] = texts(pws(arguments), 0);
    text
}

/// The one line on standard error of a call that is refused with exit status 2.
fn refusal(arguments: &[&str]) -> String {
    // some are refused late, when the default directory for results is there
    let elsewhere = tempfile::tempdir().unwrap();
    let mut call = pws(arguments);
    call.current_dir(&elsewhere);
    let [_, text] = texts(call, 2);
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    assert!(text.starts_with("pws: "), "{text}");
    text
}

/// A directory for the results of a call.
struct Results {
    directory: TempDir,
    /// Where in it they go.
    within: &'static str,
}

impl Results {
    fn new() -> Self {
        Self::within("")
    }

    /// In a directory that does not exist yet.
    fn within(within: &'static str) -> Self {
        Self {
            directory: tempfile::tempdir().unwrap(),
            within,
        }
    }

    fn path(&self, file: &str) -> PathBuf {
        self.directory.path().join(self.within).join(file)
    }

    /// The call with these arguments that writes here.
    fn pws(&self, arguments: &[&str]) -> Command {
        let mut command = pws(arguments);
        command.arg("--out").arg(self.path(""));
        command
    }

    /// Standard output of a successful call that writes here.
    fn said(&self, arguments: &[&str]) -> String {
        let [text, _] = texts(self.pws(arguments), 0);
        text
    }

    /// The header of a CSV file, and its other rows.
    fn table(&self, file: &str) -> (Vec<String>, Vec<Vec<String>>) {
        let mut reader = csv::Reader::from_path(self.path(file)).unwrap();
        let strings = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let header = strings(reader.headers().unwrap());
        let rows = reader.records().map(|record| strings(&record.unwrap()));
        (header, rows.collect())
    }
}

/// Every problem has a line.
fn assert_names_every_problem(text: &str) {
    for problem in dmm_problems::registry::all() {
        assert!(
            text.lines()
                .any(|line| line.starts_with(problem.description().name))
        );
    }
}

#[test]
fn list_names_every_problem() {
    assert_names_every_problem(&said(&["list"]));
}

#[test]
fn explain_prints_cause_and_remedy() {
    let entry = said(&["explain", "PWS131"]);
    assert!(entry.starts_with("PWS131: a range is not written"));
    assert!(entry.contains("\ncause: ") && entry.contains("\nremedy: "));
    for spelling in ["131", "pws131", "[PWS131]"] {
        assert_eq!(said(&["explain", spelling]), entry);
    }
    let all = said(&["explain"]);
    assert!(all.lines().count() > 50 && all.contains("\nPWS131  a range is not written"));
    for unknown in ["PWS999", "0", "+131", "PWS", "range", "131131", "é131"] {
        let refused = refusal(&["explain", unknown]);
        assert!(refused.contains(&format!("there is no error `{unknown}`")));
        assert!(refused.contains("PWS100 to PWS"));
    }
}

/// Every write to it fails: there is no space on the device.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_under_standard_output_is_a_failure() {
    for arguments in [&["list"][..], &["show", "toda"], &["--help"]] {
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let output = std::process::Command::new(assert_cmd::cargo::cargo_bin("pws"))
            .args(arguments)
            .stdout(full)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(
            text.starts_with("pws: cannot write to standard output"),
            "{text}"
        );
    }
}

#[test]
fn show_takes_every_problem() {
    for problem in dmm_problems::registry::all() {
        let name = problem.description().name;
        let shown = said(&["show", name]);
        assert!(shown.contains("discrete vector field"), "{name}");
    }
}

#[test]
fn run_takes_every_problem() {
    let results = Results::new();
    for problem in dmm_problems::registry::all() {
        let name = problem.description().name;
        let text = results.said(&["run", name, "--step", "0.02", "--end", "1", "--force"]);
        assert!(
            text.contains("reached t = 1 by best with tolerance 1e-12"),
            "{text}"
        );
    }
}

#[test]
fn converge_takes_every_problem() {
    let results = Results::new();
    for problem in dmm_problems::registry::all() {
        let name = problem.description().name;
        let spans = ["--after", "0", "--end", "1", "--halvings", "2", "--force"];
        let text = results.said(&[&["converge", name, "--step", "0.01"][..], &spans].concat());
        assert!(text.contains("order"), "{text}");
    }
}

#[test]
fn conserve_takes_every_problem() {
    let results = Results::new();
    assert_names_every_problem(&results.said(&["conserve", "--steps", "200", "--force"]));
}
