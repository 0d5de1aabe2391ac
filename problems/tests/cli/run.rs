//! `pws run`: what it writes and what it keeps.

use std::fs;

use super::{Results, pws, refusal, texts};

#[test]
fn run_writes_points_transitions_and_pictures() {
    let results = Results::within("new/folder");
    let scheme = ["--scheme", "symmetric", "--step", "0.01"];
    let text = results.said(&[&["run", "harmonic", "--end", "10"], &scheme[..]].concat());
    assert!(text.contains("transitions: 4"), "{text}");
    assert!(text.contains("Newton iterations a step"));

    let (header, points) = results.table("points.csv");
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

    let (_, transitions) = results.table("transitions.csv");
    assert_eq!(transitions.len(), 4);
    assert_eq!(transitions[0][1..4], ["spring", "above", "below"]);
    let t: f64 = transitions[0][0].parse().unwrap();
    assert!((t - std::f64::consts::FRAC_PI_4).abs() < 1e-4); // τ²·t/12 is 7e-6
    for picture in ["phase.svg", "series.svg", "conservation.svg"] {
        assert!(
            fs::read_to_string(results.path(picture))
                .unwrap()
                .contains("<svg")
        );
    }
}

#[test]
fn run_takes_parameters_initial_state_scheme_and_format() {
    let results = Results::new();
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
    ];
    let text = results.said(&call);
    assert!(text.contains("0.00 Newton iterations"), "{text}");
    let (_, points) = results.table("points.csv");
    assert_eq!(points[0][2..4], ["0.5", "-0.25"]);
    let transitions = results.table("transitions.csv").1.len();
    assert!(transitions > 0);
    assert!(points.len() <= 1 + 10 + 2 * transitions + 1);
    assert_eq!(points.last().unwrap()[0], "5");
    assert!(
        fs::read(results.path("phase.png"))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
}

#[test]
fn a_scheme_that_chooses_its_steps_is_written_at_even_times() {
    let results = Results::new();
    let call = [
        "run",
        "harmonic",
        "--scheme",
        "taylor",
        "--tolerance",
        "1e-9",
        "--step",
        "0.125",
        "--every",
        "2",
        "--end",
        "10",
    ];
    let text = results.said(&call);
    assert!(
        text.contains("t = 10 by taylor with tolerance 1e-9"),
        "{text}"
    );
    let (_, points) = results.table("points.csv");
    let times: Vec<f64> = points.iter().map(|row| row[0].parse().unwrap()).collect();
    let (even, between): (Vec<f64>, Vec<f64>) = times.iter().partition(|t| **t % 0.25 == 0.0);
    // every second multiple of the step, from the start to the end, each once
    let multiples: Vec<f64> = (0..=40).map(|k| 0.25 * f64::from(k)).collect();
    assert_eq!(even, multiples);
    // and both sides of four transitions, where the exact solution has them
    assert_eq!(between.len(), 2 * 4);
    assert!(between.chunks(2).all(|pair| pair[0] == pair[1]));
    assert!((between[0] - std::f64::consts::FRAC_PI_4).abs() < 1e-9);
    assert!(times.is_sorted());
    // x = cos t + sin t until then
    let x: f64 = points[2][2].parse().unwrap();
    assert!((x - (0.5f64.cos() + 0.5f64.sin())).abs() < 1e-9, "{x}");
}

/// Van der Pol's oscillator, ε = 10⁻⁶.
const VAN_DER_POL: &str = "
pub system VanDerPol {
    state x, y;
    der(x) = y;
    der(y) = ((1 - x^2) * y - x) / 1e-6;
}
";

#[test]
fn a_stiff_system_of_a_file_runs_by_embedded_methods() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("van_der_pol.pws");
    fs::write(&path, VAN_DER_POL).unwrap();
    let file = path.to_str().unwrap();
    for scheme in ["radau-iia-3", "radau-iia-5"] {
        let results = Results::new();
        let problem = ["run", file, "--initial", "x=2", "--end", "2"];
        let scheme_options = ["--scheme", scheme, "--tolerance", "1e-8", "--step", "0.5"];
        let text = results.said(&[&problem[..], &scheme_options].concat());
        let by = format!("by {scheme} with tolerance 1e-8");
        assert!(text.contains(&by), "{text}");
        let (_, points) = results.table("points.csv");
        let x: f64 = points.last().unwrap()[2].parse().unwrap();
        assert!((x - 1.706_167_732_170_483).abs() < 1e-7, "{scheme}: {x}");
    }
}

#[test]
fn the_level_is_left_to_rounding_on_request() {
    let errors = |options: &[&str]| {
        let results = Results::new();
        let call = [
            "run",
            "elliptic",
            "--scheme",
            "taylor",
            "--tolerance",
            "1e-6",
        ];
        results.said(&[&call[..], options].concat());
        let (header, points) = results.table("points.csv");
        let column = header
            .iter()
            .position(|name| name == "curve_error")
            .unwrap();
        let errors = points.iter().map(|row| row[column].parse::<f64>().unwrap());
        errors.fold(0.0, |worst: f64, error| worst.max(error.abs()))
    };
    let options = ["--end", "10", "--step", "0.1"];
    let bare = [&options[..], &["--no-level-correction"]].concat();
    assert!(errors(&options) < 1e-14);
    assert!(errors(&bare) > 1e-10);
}

#[test]
fn a_smooth_problem_has_no_file_of_transitions() {
    let results = Results::new();
    results.said(&["run", "henon-heiles", "--end", "1"]);
    assert!(results.path("points.csv").exists() && !results.path("transitions.csv").exists());
}

#[test]
fn elements_of_groups_are_given_by_their_index() {
    let results = Results::new();
    results.said(&[
        "run",
        "three_body",
        "--param",
        "m[1]=2",
        "--initial",
        "x[2]=0.125,v[ 0 ]=-0.5",
        "--end",
        "0.1",
    ]);
    let (header, points) = results.table("points.csv");
    let first = |name: &str| {
        let column = header.iter().position(|known| known == name).unwrap();
        points[0][column].parse::<f64>().unwrap()
    };
    assert_eq!((first("x[2]"), first("v[0]")), (0.125, -0.5));
    // Σ mᵢ uᵢ with m = (1, 2, 1) and u as on the figure eight: 0.466…
    assert!((first("momentum_x") - 0.466_203_685).abs() < 1e-12);
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
    let results = Results::new();
    // from (2, 3) the elliptic curve goes to infinity in finite time
    let call = ["run", "elliptic", "--initial", "x=2,y=3", "--end", "5"];
    let [_, text] = texts(results.pws(&call), 1);
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    let (_, points) = results.table("points.csv");
    assert!(points.len() > 100);
    assert!(results.path("phase.svg").exists());
}

/// A declaration alone.
const BALL: &str = "system Ball {
    state x, v;
    param k = 4;
    interface spring = x;
    region free where spring > 0 {
        der(x) = v; der(v) = -1; conserved energy = v^2/2 + x;
    }
    region pressed where spring < 0 {
        der(x) = v; der(v) = -1 - k*x; conserved energy = v^2/2 + x + k*x^2/2;
    }
}
";

#[test]
fn a_system_of_a_file_runs() {
    let results = Results::within("out");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ball.pws");
    fs::write(&path, BALL).unwrap();
    let file = path.to_str().unwrap();
    let text = results.said(&[
        "run",
        file,
        "--initial",
        "x=1",
        "--param",
        "k=9",
        "--end",
        "50",
        "--tolerance",
        "1e-12",
    ]);
    assert!(
        text.contains("Ball") && text.contains("best with tolerance"),
        "{text}"
    );
    let (header, points) = results.table("points.csv");
    assert_eq!(header, ["t", "region", "x", "v", "energy", "energy_error"]);
    let energy: f64 = points.last().unwrap()[4].parse().unwrap();
    assert!((energy - 1.0).abs() < 1e-13, "{energy}");
    let (_, transitions) = results.table("transitions.csv");
    // free fall from 1 takes √2
    let t: f64 = transitions[0][0].parse().unwrap();
    assert!((t - 2f64.sqrt()).abs() < 1e-14, "{t}");
    assert!(transitions.len() > 20);

    let errors = refusal(&["run", file, "--initial", "y=1"]);
    assert!(
        errors.contains("unknown state `y`; there are x, v"),
        "{errors}"
    );
    let errors = refusal(&["run", file, "--param", "m=1"]);
    assert!(
        errors.contains("unknown parameter `m`; there are k"),
        "{errors}"
    );
    fs::write(&path, BALL.replace("v^2/2 + x;", "v^2/2 - x;")).unwrap();
    let [_, errors] = texts(pws(&["run", file]), 2);
    assert!(errors.contains("ball.pws:6:"), "{errors}");
    assert!(
        errors.contains("[PWS300]") && errors.contains("1 error in"),
        "{errors}"
    );
}
