//! Ctrl-C: what was computed until then is kept.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use super::Results;

/// Starts a call that takes hours, and presses Ctrl-C as soon as `is_ready`.
fn interrupted(arguments: &[&str], out: &Path, is_ready: &dyn Fn() -> bool) -> Output {
    let mut child: Child = Command::new(assert_cmd::cargo::cargo_bin("pws"))
        .args(arguments)
        .arg("--out")
        .arg(out)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !is_ready() {
        assert!(
            child.try_wait().unwrap().is_none(),
            "{arguments:?} ended by itself"
        );
        assert!(start.elapsed() < Duration::from_secs(120), "{arguments:?}");
        std::thread::sleep(Duration::from_millis(20));
    }
    let id = child.id().to_string();
    let kill = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(kill.success());
    child.wait_with_output().unwrap()
}

fn size(path: &Path) -> u64 {
    fs::metadata(path).map_or(0, |file| file.len())
}

#[test]
fn a_run_leaves_complete_files_and_pictures() {
    let results = Results::new();
    let call = ["run", "harmonic", "--end", "1e9", "--step", "0.01"];
    let points = results.path("points.csv");
    let output = interrupted(&call, &results.path(""), &|| size(&points) > 300_000);
    assert_eq!(output.status.code(), Some(130));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.starts_with("pws: interrupted at t = "), "{said}");
    let (header, rows) = results.table("points.csv");
    assert!(rows.iter().all(|row| row.len() == header.len()));
    let time = |row: &[String]| row[0].parse::<f64>().unwrap();
    let last = time(rows.last().unwrap());
    assert!(
        last > 10.0 && said.contains(&format!("t = {last}")),
        "{said}"
    );
    let (_, transitions) = results.table("transitions.csv");
    let late = time(transitions.last().unwrap());
    assert!(late <= last && last - late < 4.0);
    for picture in ["phase.svg", "series.svg", "conservation.svg"] {
        let text = fs::read_to_string(results.path(picture)).unwrap();
        assert!(text.trim_end().ends_with("</svg>"), "{picture}");
    }
    let record = fs::read_to_string(results.path("run.json")).unwrap();
    assert!(record.contains("interrupted at t = "), "{record}");
}

#[test]
fn studies_end_in_order() {
    let calls: [(&[&str], &str); 4] = [
        (
            &["conserve", "harmonic", "--steps", "100000000000"],
            "conservation.csv",
        ),
        (
            &[
                "converge",
                "elliptic",
                "--after",
                "0",
                "--step",
                "1e-3",
                "--halvings",
                "20",
            ],
            "convergence.csv",
        ),
        (
            &["bench", "elliptic", "--rounds", "1000000"],
            "work_precision.csv",
        ),
        (&["stress", "long"], "stress.csv"),
    ];
    for (call, file) in calls {
        let results = Results::new();
        let record = results.path("run.json");
        let started = Instant::now();
        // beyond the first results of `converge`
        let is_ready = || record.exists() && started.elapsed() > Duration::from_secs(1);
        let output = interrupted(call, &results.path(""), &is_ready);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{call:?}: {said}");
        assert!(said.starts_with("pws: interrupted "), "{call:?}: {said}");
        let (header, rows) = results.table(file);
        assert!(rows.iter().all(|row| row.len() == header.len()), "{call:?}");
        let record = fs::read_to_string(record).unwrap();
        assert!(record.contains("\"outcome\": \"interrupted "), "{record}");
    }
}

#[test]
fn an_ensemble_keeps_the_rows_until_then() {
    let results = Results::new();
    let out = results.path("ends.csv");
    let call = [
        "ensemble",
        "elliptic",
        "--initial",
        "y=-1..-0.9:100000000",
        "--end",
        "3",
    ];
    let output = interrupted(&call, &out, &|| size(&out) > 100_000);
    assert_eq!(output.status.code(), Some(130));
    let (header, rows) = results.table("ends.csv");
    assert!(rows.len() > 100 && rows.iter().all(|row| row.len() == header.len()));
    let members: Vec<usize> = rows.iter().map(|row| row[0].parse().unwrap()).collect();
    assert!(members.iter().copied().eq(0..rows.len()));
}
