//! The place of results: what they are results of, and what may be overwritten.

use std::fs;

use super::{Results, pws, refusal, said, texts};

const CALL: [&str; 4] = ["run", "harmonic", "--end", "2"];

#[test]
fn the_record_says_what_the_results_are_of() {
    let results = Results::new();
    let options = ["--param", "k_below=2.5", "--tolerance", "1e-9"];
    results.said(&[&CALL[..], &options].concat());
    let text = fs::read_to_string(results.path("run.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&text).unwrap();
    let request = &record["request"];
    assert_eq!(
        record["program"],
        concat!("pws ", env!("CARGO_PKG_VERSION"))
    );
    assert_eq!(record["outcome"], "complete");
    assert_eq!(record["command"][0], "run");
    assert_eq!(request["scheme"], "best");
    assert_eq!(request["tolerance"], 1e-9);
    assert_eq!(request["end"], 2.0);
    assert_eq!(request["parameters"]["k_below"], 2.5);
    assert_eq!(request["initial state"]["y"], 1.0);
    let declaration = request["declaration"].as_str().unwrap();
    assert!(declaration.contains("system Harmonic {"), "{declaration}");
    for file in record["files"].as_array().unwrap() {
        assert!(results.path(file.as_str().unwrap()).exists());
    }
}

#[test]
fn the_same_request_replaces_its_results_and_another_does_not() {
    let results = Results::new();
    results.said(&CALL);
    let first = fs::read_to_string(results.path("points.csv")).unwrap();
    // pictures are drawn from the results, in whatever format
    results.said(&[&CALL[..], &["--format", "png"]].concat());
    assert_eq!(
        fs::read_to_string(results.path("points.csv")).unwrap(),
        first
    );
    assert!(results.path("phase.png").exists() && !results.path("phase.svg").exists());

    let other = ["run", "harmonic", "--end", "3", "--param", "k_above=2"];
    let [_, error] = texts(results.pws(&other), 2);
    assert!(error.contains("has other results"), "{error}");
    assert!(error.contains("with another end, parameters;"), "{error}");
    assert!(error.contains("`--force`"), "{error}");
    assert_eq!(
        fs::read_to_string(results.path("points.csv")).unwrap(),
        first
    );

    // nothing of the old results is left among the new ones
    let smooth = ["run", "henon_heiles", "--end", "1", "--force"];
    results.said(&smooth);
    assert!(!results.path("transitions.csv").exists());
    assert!(!results.path("phase.png").exists());
}

#[test]
fn a_file_of_unknown_origin_is_kept() {
    let results = Results::new();
    fs::write(results.path("points.csv"), "mine").unwrap();
    let [_, error] = texts(results.pws(&CALL), 2);
    assert!(
        error.contains("`points.csv` without a `run.json`"),
        "{error}"
    );
    assert_eq!(
        fs::read_to_string(results.path("points.csv")).unwrap(),
        "mine"
    );
    // other files do not matter
    let results = Results::new();
    fs::write(results.path("notes.txt"), "mine").unwrap();
    results.said(&CALL);
    assert_eq!(
        fs::read_to_string(results.path("notes.txt")).unwrap(),
        "mine"
    );
}

#[test]
fn endings_say_what_is_written() {
    let ending = refusal(&["ensemble", "elliptic", "--out", "ends.xlsx"]);
    assert!(
        ending.contains("unknown ending `.xlsx`; name a .csv or a .parquet file"),
        "{ending}"
    );
    assert!(refusal(&["ensemble", "elliptic", "--out", "ends"]).contains("has no ending"));
    let file = refusal(&["run", "elliptic", "--out", "points.csv"]);
    assert!(file.contains("names a directory"), "{file}");
}

#[test]
fn an_ensemble_has_a_record_beside_each_file() {
    let directory = tempfile::tempdir().unwrap();
    let call = |file: &str, range: &str| {
        let mut call = pws(&["ensemble", "elliptic", "--end", "1", "--initial", range]);
        call.arg("--out").arg(directory.path().join(file));
        call
    };
    texts(call("a.csv", "y=-1..-0.9:3"), 0);
    texts(call("b.csv", "y=-1..-0.9:4"), 0);
    texts(call("a.csv", "y=-1..-0.9:3"), 0);
    let [_, error] = texts(call("a.csv", "y=-1..-0.9:4"), 2);
    assert!(error.contains("another initial values"), "{error}");
    let mut forced = call("a.csv", "y=-1..-0.9:4");
    forced.arg("--force");
    texts(forced, 0);
    assert!(directory.path().join("a.csv.run.json").exists());
}

#[test]
fn help_lists_what_is_accepted() {
    for command in ["run", "show", "ensemble", "converge", "conserve", "bench"] {
        let help = said(&[command, "--help"]);
        for problem in dmm_problems::registry::descriptions() {
            assert!(
                help.contains(&format!("\n  {} ", problem.name)),
                "{command}: {help}"
            );
        }
    }
    for command in ["run", "ensemble", "conserve"] {
        let help = said(&[command, "--help"]);
        for scheme in ["symmetric", "taylor", "best"] {
            assert!(help.contains(&format!("- {scheme}")), "{command}: {help}");
        }
    }
    let help = said(&["run", "--help"]);
    for (scheme, also) in [("radau-iia-3", true), ("radau-iia-4", false)] {
        let line = help.lines().find(|line| line.contains(scheme)).unwrap();
        assert_eq!(line.contains("with `--tolerance`"), also, "{line}");
    }
    // none that it would refuse
    assert!(!said(&["ensemble", "--help"]).contains("- composed-4"));
    let help = said(&["stress", "--help"]);
    for study in dmm_problems::stress::STUDIES {
        assert!(
            help.contains(study.name) && help.contains(study.title),
            "{help}"
        );
    }
}

#[test]
fn numbers_are_short_and_read_back() {
    let results = Results::new();
    results.said(&[
        "run",
        "harmonic",
        "--initial",
        "x=1e-130,y=3e120",
        "--end",
        "1",
    ]);
    let (_, rows) = results.table("points.csv");
    for text in rows
        .iter()
        .flatten()
        .filter(|text| text.parse::<f64>().is_ok())
    {
        assert!(text.len() <= 24, "{text}");
    }
    assert_eq!(rows[0][2..4], ["1e-130", "3e120"]);
}
