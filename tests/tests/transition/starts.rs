//! The region that a solution starts in, and input that makes no sense.

use dmm_runtime::{ErrorKind, Integrator, Symmetric};

use super::{Drift, DriftRegion, start};

#[test]
fn a_start_on_the_interface_is_decided_by_the_rates() {
    let run = |up: f64, down: f64| start(&Drift { up, down }, 0.3, [0.0]).run_until(1.0);
    assert_eq!(
        run(1.0, 2.0).unwrap().points()[0].region,
        DriftRegion::Above
    );
    assert_eq!(
        run(-1.0, -2.0).unwrap().points()[0].region,
        DriftRegion::Below
    );
    assert!(matches!(
        run(-1.0, 2.0).unwrap_err().error().kind,
        ErrorKind::Sliding { .. }
    ));
    assert!(matches!(
        run(1.0, -2.0).unwrap_err().error().kind,
        ErrorKind::Ambiguous { .. }
    ));
    assert!(matches!(
        run(0.0, -2.0).unwrap_err().error().kind,
        ErrorKind::Tangential { .. }
    ));
}

#[test]
fn an_ambiguous_start_follows_the_region_that_is_named() {
    let system = Drift {
        up: 1.0,
        down: -2.0,
    };
    let run = |region| {
        start(&system, 0.3, [0.0])
            .region(region)
            .run_until(1.0)
            .unwrap()
            .last()
            .unwrap()
            .x[0]
    };
    assert!((run(DriftRegion::Above) - 1.0).abs() < 1e-15);
    assert!((run(DriftRegion::Below) + 2.0).abs() < 1e-15);
}

#[test]
fn a_region_that_does_not_hold_the_start_is_refused() {
    let system = Drift::default();
    for (x, region) in [(1.0, DriftRegion::Below), (0.0, DriftRegion::Above)] {
        let result = start(&system, 0.3, [x]).region(region).run_until(1.0);
        assert!(matches!(
            result.unwrap_err().error().kind,
            ErrorKind::InvalidInput { what: "region", .. }
        ));
    }
}

#[test]
fn bad_input_is_named() {
    let run = |tau: f64, t0: f64, x: f64, t_end: f64| {
        let result = Integrator::new(&Drift::default(), Symmetric::step_size(tau))
            .initial(t0, [x])
            .run_until(t_end);
        result.unwrap_err().to_string()
    };
    assert!(run(0.0, 0.0, 1.0, 1.0).starts_with("step size: 0"));
    assert!(run(-0.1, 0.0, 1.0, 1.0).starts_with("step size: -0.1"));
    assert!(run(f64::NAN, 0.0, 1.0, 1.0).starts_with("step size: NaN"));
    assert!(run(1e-20, 1.0, 1.0, 2.0).contains("below the rounding error of the time"));
    assert!(run(0.1, f64::INFINITY, 1.0, 1.0).starts_with("initial time: inf"));
    assert!(run(0.1, 0.0, f64::NAN, 1.0).starts_with("initial state: x = NaN"));
    assert!(run(0.1, 2.0, 1.0, 1.0).starts_with("the end time 1 is before the initial time 2"));
    let strange = Drift {
        up: f64::NAN,
        down: 1.0,
    };
    let error = start(&strange, 0.1, [1.0]).run_until(1.0).unwrap_err();
    assert!(error.to_string().starts_with("parameter: up = NaN"));
}
