//! What stops an integration before its end time, and what is kept of it.

use dmm_runtime::ErrorKind;

use super::{Drift, Growing, Vanishing, start};

#[test]
fn sliding_is_refused_with_both_rates() {
    let system = Drift {
        up: -1.0,
        down: 2.0,
    };
    let interrupted = start(&system, 0.3, [1.0]).run_until(2.0).unwrap_err();
    assert!(
        matches!(
            interrupted.error().kind,
            ErrorKind::Sliding { interface: "wall", from: "above", to: "below", rate_from, rate_to }
                if rate_from == -1.0 && rate_to == 2.0
        ),
        "{interrupted:?}"
    );
    let place = interrupted.error().place().unwrap();
    assert!((place.t - 1.0).abs() < 1e-15 && place.step_size.is_none());
    // nothing that was computed is lost
    let reached = interrupted.solution().last().unwrap();
    assert!((reached.t - 1.0).abs() < 1e-15 && reached.x[0].abs() < 1e-15);
    assert_eq!(interrupted.solution().statistics().steps, 4);
}

#[test]
fn the_end_of_a_solution_is_a_typed_error_with_the_solution_before_it() {
    let interrupted = start(&Vanishing::default(), 0.01, [1.0])
        .run_until(2.0)
        .unwrap_err();
    assert!(
        matches!(
            interrupted.error().kind,
            ErrorKind::NewtonFailed { .. } | ErrorKind::LeftDomain
        ),
        "{interrupted:?}"
    );
    let solution = interrupted.solution();
    assert!(solution.last().unwrap().t > 0.95);
    assert!((solution.at(0.75).unwrap()[0] - 0.5).abs() < 1e-3);
}

#[test]
fn no_point_is_ever_not_finite() {
    let interrupted = start(&Growing::default(), 0.01, [1.0])
        .run_until(100.0)
        .unwrap_err();
    assert!(matches!(interrupted.error().kind, ErrorKind::Overflow));
    let solution = interrupted.solution();
    assert!(solution.points().iter().all(|point| point.x[0].is_finite()));
    assert_eq!(solution.points().last(), solution.last());
}
