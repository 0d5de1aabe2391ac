//! The program `pws` as its user meets it.

use std::fs;
use std::path::Path;

use assert_cmd::Command;

fn pws(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("pws").unwrap();
    command.args(arguments);
    command
}

/// Standard output of a successful call.
fn said(arguments: &[&str]) -> String {
    let output = pws(arguments).assert().success().get_output().clone();
    String::from_utf8(output.stdout).unwrap()
}

/// The one line on standard error of a call that is refused with exit status 2.
fn refusal(arguments: &[&str]) -> String {
    let output = pws(arguments).assert().code(2).get_output().clone();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    assert!(text.starts_with("pws: "), "{text}");
    text
}

/// The rows of a CSV file, without the header, and the header.
fn table(path: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let strings = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let header = strings(reader.headers().unwrap());
    (
        header,
        reader
            .records()
            .map(|record| strings(&record.unwrap()))
            .collect(),
    )
}

#[test]
fn list_names_every_problem() {
    let text = said(&["list"]);
    for problem in dmm_problems::registry::all() {
        assert!(
            text.lines()
                .any(|line| line.starts_with(problem.card().name))
        );
    }
}

#[test]
fn show_prints_declaration_and_scheme() {
    let text = said(&["show", "elliptic"]);
    assert!(text.contains("der(y) = 3 * x^2 + a_inside;"));
    assert!(text.contains("discrete vector field f^τ"));
    assert!(text.contains("skew pairing"));
}

/// What is printed can be pasted into the declaration.
#[test]
fn invariants_are_found_and_accepted() {
    let text = said(&["show", "pendulum", "--find-invariants", "2"]);
    assert!(text.contains("in all regions:\n    none up to degree 2"));
    assert!(
        text.contains("in the region `left`:\n    conserved invariant_1 = p^2 - 2*k_left*cos(q);")
    );

    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("duffing.pws");
    let system = "system Duffing { state x, v; der(x) = v; der(v) = -x - x^3; ";
    fs::write(&file, format!("{system} }}")).unwrap();
    let path = file.to_str().unwrap();
    let text = said(&["show", path, "--find-invariants", "4"]);
    let found = text
        .lines()
        .find(|line| line.contains("conserved"))
        .unwrap();
    assert_eq!(found.trim(), "conserved invariant_1 = 2*x^2 + 2*v^2 + x^4;");
    fs::write(&file, format!("{system} {found} }}")).unwrap();
    assert!(said(&["show", path]).contains("invariant_1"));

    for degree in ["0", "-1", "two", "1.5"] {
        let option = format!("--find-invariants={degree}");
        assert!(refusal(&["show", path, &option]).contains("--find-invariants"));
    }
    let refused = refusal(&["show", "fput_chain_32", "--find-invariants", "3"]);
    assert!(refused.contains("ask for a degree up to 2"));
    fs::write(&file, "system S { state x; der(x) = y; }").unwrap();
    let output = pws(&["show", path, "--find-invariants", "2"])
        .assert()
        .code(2);
    let text = String::from_utf8(output.get_output().stderr.clone()).unwrap();
    assert!(
        text.contains("duffing.pws:1:30: `y` is not declared"),
        "{text}"
    );
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

#[test]
fn run_writes_points_transitions_and_pictures() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("new").join("folder");
    let text = said(&[
        "run",
        "harmonic",
        "--step",
        "0.01",
        "--end",
        "10",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(text.contains("transitions: 4"), "{text}");
    assert!(text.contains("Newton iterations a step"));

    let (header, points) = table(&out.join("points.csv"));
    assert_eq!(header, ["t", "region", "x", "y", "energy", "energy_error"]);
    // the start, 1000 steps, and both sides of 4 transitions
    assert_eq!(points.len(), 1 + 1000 + 2 * 4);
    assert_eq!(points[0], ["0", "above", "1", "1", "1", "0"]);
    assert_eq!(points.last().unwrap()[0], "10");
    let sides: Vec<_> = points
        .windows(2)
        .filter(|pair| pair[0][0] == pair[1][0])
        .collect();
    assert_eq!(sides.len(), 4);
    assert!(
        sides
            .iter()
            .all(|pair| pair[0][1] != pair[1][1] && pair[0][2..4] == pair[1][2..4])
    );

    let (_, transitions) = table(&out.join("transitions.csv"));
    assert_eq!(transitions.len(), 4);
    assert_eq!(transitions[0][1..4], ["spring", "above", "below"]);
    let t: f64 = transitions[0][0].parse().unwrap();
    assert!((t - std::f64::consts::FRAC_PI_4).abs() < 1e-4); // τ²·t/12 is 7e-6
    for picture in ["phase.svg", "series.svg", "conservation.svg"] {
        assert!(
            fs::read_to_string(out.join(picture))
                .unwrap()
                .contains("<svg")
        );
    }
}

#[test]
fn run_takes_parameters_initial_state_scheme_and_format() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path();
    let call = [
        "run",
        "pendulum",
        "--param",
        "k_left=2.5",
        "--param",
        "k_right=0.5",
        "--initial",
        "p=-0.25",
        "--scheme",
        "explicit-midpoint",
        "--every",
        "50",
        "--step",
        "0.01",
        "--end",
        "5",
        "--format",
        "png",
        "--out",
        out.to_str().unwrap(),
    ];
    let text = said(&call);
    assert!(text.contains("0.00 Newton iterations"), "{text}");
    let (_, points) = table(&out.join("points.csv"));
    assert_eq!(points[0][2..4], ["0.5", "-0.25"]);
    let transitions = table(&out.join("transitions.csv")).1.len();
    assert!(transitions > 0);
    assert!(points.len() <= 1 + 10 + 2 * transitions + 1);
    assert_eq!(points.last().unwrap()[0], "5");
    assert!(
        fs::read(out.join("phase.png"))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
}

#[test]
fn a_smooth_problem_has_no_file_of_transitions() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path();
    said(&[
        "run",
        "henon-heiles",
        "--end",
        "1",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(out.join("points.csv").exists() && !out.join("transitions.csv").exists());
}

#[test]
fn converge_prints_orders_and_writes_errors() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path();
    let text = said(&[
        "converge",
        "elliptic",
        "--after",
        "0,3",
        "--halvings",
        "3",
        "--out",
        out.to_str().unwrap(),
    ]);
    let orders: Vec<f64> = text
        .lines()
        .filter(|line| line.contains(" at t = ") || line.contains("time of crossing"))
        .map(|line| line.split_whitespace().last().unwrap().parse().unwrap())
        .collect();
    assert_eq!(orders.len(), 6);
    // three halvings from 1/64: what is left of O(τ) in the order is a few hundredths
    assert!(
        orders.iter().all(|order| (order - 2.0).abs() < 0.05),
        "{text}"
    );
    let (header, rows) = table(&out.join("convergence.csv"));
    assert_eq!(header, ["transitions", "quantity", "step_size", "error"]);
    assert_eq!(rows.len(), 6 * 4);
    assert!(out.join("convergence.svg").exists());
}

#[test]
fn conserve_measures_in_ulps() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().to_str().unwrap();
    said(&[
        "conserve",
        "harmonic",
        "rigid_body",
        "--steps",
        "20000",
        "--out",
        out,
    ]);
    let (header, rows) = table(&directory.path().join("conservation.csv"));
    assert_eq!(rows.len(), 2);
    let ulps = header
        .iter()
        .position(|name| name == "ulps_corrected")
        .unwrap();
    assert!(
        rows.iter()
            .all(|row| row[ulps].parse::<f64>().unwrap() <= 8.0)
    );
}

#[test]
fn unknown_names_get_a_suggestion() {
    assert!(refusal(&["run", "harmonc"]).contains("did you mean `harmonic`?"));
    assert!(refusal(&["show", "toad"]).contains("did you mean `toda`?"));
    assert!(
        refusal(&["run", "harmonic", "--param", "k_abov=2"]).contains("did you mean `k_above`?")
    );
    assert!(refusal(&["run", "harmonic", "--initial", "z=2"]).contains("there are x, y"));
    assert!(refusal(&["rnu", "harmonic"]).contains("run"));
    assert!(refusal(&["conserve", "harmonc"]).contains("did you mean `harmonic`?"));
    assert!(refusal(&["conserve", "nosuch"]).contains("`pws list` names those there are"));
    assert!(refusal(&["run", "toda_chain", "--initial", "z=2"]).contains("there are q[8], p[8]"));
    assert!(refusal(&["run", "toda_chain", "--initial", "q[8]=2"]).contains("did you mean `q["));
    assert!(refusal(&["run", "harmonic", "--stpe", "1"]).contains("--step"));
}

#[test]
fn senseless_values_are_refused() {
    for (option, value) in [
        ("--step", "0"),
        ("--step", "-1"),
        ("--step", "nan"),
        ("--step", "fast"),
        ("--end", "-1"),
        ("--every", "0"),
        ("--param", "k_above"),
        ("--param", "k_above=inf"),
        ("--initial", "x=one"),
        ("--scheme", "euler"),
        ("--format", "gif"),
        ("--plane", "x"),
    ] {
        refusal(&["run", "harmonic", option, value]);
    }
    assert!(refusal(&["run", "harmonic", "--step", "-1"]).contains("must be positive"));
    assert!(refusal(&["converge", "harmonic", "--after", "5000"]).contains("transitions"));
    refusal(&["converge", "harmonic", "--step=-1"]);
}

#[test]
fn what_is_given_twice_is_refused() {
    let parameters = ["--param", "k_above=2", "--param", "k_above=2"];
    let text = refusal(&[&["run", "harmonic"][..], &parameters].concat());
    assert!(
        text.contains("parameter `k_above` is given twice"),
        "{text}"
    );
    for command in ["run", "converge"] {
        let text = refusal(&[command, "harmonic", "--initial", "x=1,y=2, x=1"]);
        assert!(text.contains("state `x` is given twice"), "{text}");
    }
}

#[test]
fn numbers_in_messages_are_short() {
    let text = refusal(&["run", "harmonic", "--step", "1e-300"]);
    assert!(
        text.contains("1e-300 (is below the rounding error of the time)"),
        "{text}"
    );
    let text = refusal(&["run", "harmonic", "--every", "0"]);
    assert!(
        text.contains("must be a whole number, 1 at least"),
        "{text}"
    );
    assert!(!text.contains("18446744073709551615"), "{text}");
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
fn elements_of_groups_are_given_by_their_index() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path();
    said(&[
        "run",
        "three_body",
        "--param",
        "m[1]=2",
        "--initial",
        "x[2]=0.125,v[ 0 ]=-0.5",
        "--end",
        "0.1",
        "--out",
        out.to_str().unwrap(),
    ]);
    let (header, points) = table(&out.join("points.csv"));
    let first = |name: &str| {
        let column = header.iter().position(|known| known == name).unwrap();
        points[0][column].parse::<f64>().unwrap()
    };
    assert_eq!((first("x[2]"), first("v[0]")), (0.125, -0.5));
    // Σ mᵢ uᵢ with m = (1, 2, 1) and u as on the figure eight: 0.466…
    assert!((first("momentum_x") - 0.466_203_685).abs() < 1e-12);
}

#[test]
fn every_command_takes_every_problem() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().to_str().unwrap();
    for problem in dmm_problems::registry::all() {
        let name = problem.card().name;
        let shown = said(&["show", name]);
        assert!(shown.contains("discrete vector field"), "{name}");
        let text = said(&["run", name, "--step", "0.02", "--end", "1", "--out", out]);
        assert!(text.contains("reached t = 1 with step size 0.02"), "{text}");
        let halvings = [
            "--after",
            "0",
            "--end",
            "1",
            "--halvings",
            "2",
            "--step",
            "0.01",
        ];
        let text = said(&[&["converge", name, "--out", out][..], &halvings].concat());
        assert!(text.contains("order"), "{text}");
    }
    let text = said(&["conserve", "--steps", "200", "--out", out]);
    for problem in dmm_problems::registry::all() {
        assert!(
            text.lines()
                .any(|line| line.starts_with(problem.card().name))
        );
    }
}

#[test]
fn an_unwritable_place_is_refused_before_the_work() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("file");
    fs::write(&file, "keep me").unwrap();
    let inside = file.join("results");
    let text = refusal(&["run", "harmonic", "--out", inside.to_str().unwrap()]);
    assert!(text.contains("cannot write"), "{text}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "keep me");
}

#[test]
fn what_was_computed_before_a_failure_is_kept() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path();
    // from (2, 3) the elliptic curve goes to infinity in finite time
    let call = [
        "run",
        "elliptic",
        "--initial",
        "x=2,y=3",
        "--end",
        "5",
        "--out",
        out.to_str().unwrap(),
    ];
    let output = pws(&call).assert().code(1).get_output().clone();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    let (_, points) = table(&out.join("points.csv"));
    assert!(points.len() > 100);
    assert!(out.join("phase.svg").exists());
}

#[test]
fn a_study_keeps_the_step_sizes_that_worked() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path();
    // a step of 8 leads to negative populations, which have no logarithm
    let call = [
        "converge",
        "lotka_volterra_periodic",
        "--after",
        "0",
        "--step",
        "8",
        "--halvings",
        "12",
    ];
    let output = pws(&[&call[..], &["--out", out.to_str().unwrap()]].concat())
        .assert()
        .code(1)
        .get_output()
        .clone();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("with step size 8"), "{said}");
    // nothing is fitted to what is unknown without saying so
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains(" of 13)") && text.contains("unknown"),
        "{text}"
    );
    assert!(text.contains("k of n: fitted to"), "{text}");
    let (_, rows) = table(&out.join("convergence.csv"));
    let errors: Vec<f64> = rows.iter().map(|row| row[3].parse().unwrap()).collect();
    assert!(errors.iter().any(|error| error.is_nan()));
    assert!(errors.iter().any(|error| *error < 1e-5));
}
