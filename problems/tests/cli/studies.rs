//! `pws converge` and `pws conserve`.

use super::{Results, texts};

#[test]
fn converge_prints_orders_and_writes_errors() {
    let results = Results::new();
    let text = results.said(&["converge", "elliptic", "--after", "0,3", "--halvings", "3"]);
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
    let (header, rows) = results.table("convergence.csv");
    assert_eq!(header, ["transitions", "quantity", "step_size", "error"]);
    assert_eq!(rows.len(), 6 * 4);
    assert!(results.path("convergence.svg").exists());
}

#[test]
fn bench_measures_time_against_error() {
    let results = Results::new();
    let call = ["bench", "elliptic", "--end", "2", "--rounds", "2"];
    // ten times as long as the run takes whose error is asked for
    let schemes = ["--scheme", "symmetric,taylor", "--longest", "0.3"];
    let text = results.said(&[&call[..], &schemes].concat());
    assert!(text.contains("elliptic, t = 2"), "{text}");
    let (header, rows) = results.table("work_precision.csv");
    let column = |name: &str| header.iter().position(|known| known == name).unwrap();
    for scheme in ["symmetric", "taylor"] {
        let own: Vec<_> = rows
            .iter()
            .filter(|row| row[column("scheme")] == scheme)
            .collect();
        let value = |row: &[String], name| row[column(name)].parse::<f64>().unwrap();
        assert!(own.iter().all(|row| value(row, "transitions") == 2.0));
        assert!(own.iter().all(|row| value(row, "seconds_min") > 0.0));
        // Taylor's last setting reaches rounding; the other's is the last that is not too long
        let last = value(own[own.len() - 1], "error");
        assert!(
            last < if scheme == "taylor" { 1e-13 } else { 1e-8 },
            "{last:e}"
        );
    }
    assert!(results.path("work_precision.svg").exists());
}

#[test]
fn the_studies_take_a_scheme() {
    let results = Results::new();
    let call = ["converge", "elliptic", "--after", "0", "--halvings", "2"];
    let text = results.said(&[&call[..], &["--scheme", "explicit-midpoint"]].concat());
    assert!(text.contains("x at t = "), "{text}");
    let call = [
        "conserve", "elliptic", "--scheme", "taylor", "--steps", "5000",
    ];
    let results = Results::new();
    results.said(&[&call[..], &["--tolerance", "1e-9"]].concat());
    let (header, rows) = results.table("conservation.csv");
    let column = |name: &str| header.iter().position(|known| known == name).unwrap();
    let value = |name: &str| rows[0][column(name)].parse::<f64>().unwrap();
    // 5 units of time: some ten steps of Taylor's method a period of 1.9
    assert!(value("steps") < 500.0);
    assert!(value("ulps_corrected") <= 64.0);
    assert!(value("relative_drift_uncorrected") > 1e-12);
}

#[test]
fn a_study_keeps_the_step_sizes_that_worked() {
    let results = Results::new();
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
    let [text, error] = texts(results.pws(&call), 1);
    assert!(error.contains("with step size 8"), "{error}");
    // nothing is fitted to what is unknown without saying so
    assert!(
        text.contains(" of 13)") && text.contains("unknown"),
        "{text}"
    );
    assert!(text.contains("k of n: fitted to"), "{text}");
    let (_, rows) = results.table("convergence.csv");
    let errors: Vec<f64> = rows.iter().map(|row| row[3].parse().unwrap()).collect();
    assert!(errors.iter().any(|error| error.is_nan()));
    assert!(errors.iter().any(|error| *error < 1e-5));
}

#[test]
fn conserve_measures_in_ulps() {
    let results = Results::new();
    results.said(&["conserve", "harmonic", "rigid_body", "--steps", "20000"]);
    let (header, rows) = results.table("conservation.csv");
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
