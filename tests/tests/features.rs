//! What the features `serde` and `ndarray` add.

use dmm_runtime::{Best, Integrator, Statistics, pws};
use serde_json::{from_value, json, to_value};

pws! {
    /// A ball that falls into a spring.
    pub system Ball {
        state x, v;
        param k = 4;
        interface spring = x;
        region free where spring > 0 { der(x) = v; der(v) = -1; }
        region pressed where spring < 0 { der(x) = v; der(v) = -1 - k*x; }
    }
}

#[test]
fn a_solution_is_serialised_with_the_names_of_its_system() {
    let solution = Integrator::new(&Ball::default(), Best::tolerance(1e-12))
        .initial(0.0, [0.5, 0.0])
        .output_times([0.0, 0.25])
        .run_until(1.5)
        .unwrap();
    let value = to_value(&solution).unwrap();
    assert_eq!(value["system"], "Ball");
    assert_eq!(value["states"], json!(["x", "v"]));
    assert_eq!(value["discrete"], json!([]));
    assert_eq!(value["parameters"], json!({"k": 4.0}));
    let points = json!([
        {"t": 0.0, "region": "free", "x": [0.5, 0.0]},
        {"t": 0.25, "region": "free", "x": [0.46875, -0.25]},
    ]);
    assert_eq!(value["points"], points);
    let transition = &value["transitions"][0];
    assert_eq!(transition["interface"], "spring");
    assert_eq!(
        (&transition["from"], &transition["to"]),
        (&json!("free"), &json!("pressed"))
    );
    assert!((transition["t"].as_f64().unwrap() - 1.0).abs() < 1e-15);
    assert_eq!(value["ended_by"], "end time");
    let statistics: Statistics = from_value(value["statistics"].clone()).unwrap();
    assert_eq!(statistics, *solution.statistics());
    // by themselves they do not know the names
    let alone = to_value(solution.transitions()[0]).unwrap();
    assert_eq!(
        (&alone["interface"], &alone["to"]),
        (&json!(0), &json!("Pressed"))
    );
    let alone = to_value(solution.points()[1]).unwrap();
    assert_eq!(
        alone,
        json!({"t": 0.25, "region": "Free", "x": [0.46875, -0.25]})
    );
}

pws! {
    /// A ball that bounces, counts, and is pushed at times.
    pub system Bounces {
        state y, v;
        discrete bounces = 0;
        interface floor = y;
        der(y) = v;
        der(v) = -1;
        every 4 { v = v + 1; }
        on floor falling {
            v = -v / 2;
            bounces = bounces + 1;
        }
    }
}

#[test]
fn discrete_states_and_both_sides_of_a_jump_are_serialised() {
    let solution = Integrator::new(&Bounces {}, Best::tolerance(1e-12))
        .initial(0.0, [0.5, 0.0])
        .output_times([0.5, 1.5])
        .run_until(1.5)
        .unwrap();
    let value = to_value(&solution).unwrap();
    // what counts periodic events is not declared
    assert_eq!(value["discrete"], json!(["bounces"]));
    let points = json!([
        {"t": 0.5, "region": "everywhere", "x": [0.375, -0.5], "discrete": [0.0]},
        {"t": 1.5, "region": "everywhere", "x": [0.125, 0.0], "discrete": [1.0]},
    ]);
    assert_eq!(value["points"], points);
    let transition = &value["transitions"][0];
    assert_eq!(transition["kind"], "jumped");
    assert_eq!(transition["x"], json!([0.0, -1.0]));
    assert_eq!(transition["after"], json!([0.0, 0.5]));
    assert_eq!(transition["discrete"], json!([0.0]));
    assert_eq!(transition["discrete_after"], json!([1.0]));
}

#[test]
fn a_solution_is_two_arrays() {
    let solution = Integrator::new(&Ball::default(), Best::tolerance(1e-12))
        .initial(0.0, [0.5, 0.0])
        .run_until(10.0)
        .unwrap();
    let (times, states) = solution.to_arrays();
    assert_eq!(times.len(), solution.points().len());
    assert_eq!(states.dim(), (times.len(), 2));
    for (row, point) in solution.points().iter().enumerate() {
        assert_eq!((times[row], states[[row, 1]]), (point.t, point.x[1]));
    }
}
