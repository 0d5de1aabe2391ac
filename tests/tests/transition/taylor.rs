//! The same rules for Taylor's method, whose steps are as long as the solution allows: of a
//! parabola one step is the whole of it.

use dmm_runtime::{ErrorKind, InitialValueProblem, Integrator, System, Taylor};

use super::{Drift, DriftRegion, Growing, Moving, Parabola, ParabolaRegion, Turning, Vanishing};

/// The problem from `x` at t = 0, to rounding.
fn start<Sys: System<N>, const N: usize>(
    system: &Sys,
    x: [f64; N],
) -> InitialValueProblem<'_, Sys, Taylor, N> {
    Integrator::new(system, Taylor::tolerance(1e-15)).initial(0.0, x)
}

/// The times of the transitions until `t_end`.
fn times<Sys: System<N>, const N: usize>(system: &Sys, x: [f64; N], t_end: f64) -> Vec<f64> {
    let solution = start(system, x).run_until(t_end).unwrap();
    solution.transitions().iter().map(|t| t.t).collect()
}

#[test]
fn every_root_of_a_step_is_found() {
    let system = Parabola::default();
    for (r1, r2) in [
        (0.2 - 0.02f64.sqrt(), 0.2 + 0.02f64.sqrt()),
        (0.25, 0.5),
        (0.25, 0.25 + 1e-3),
        (1e-6, 1.9),
    ] {
        let times = times(&system, [0.5 * r1 * r2, -0.5 * (r1 + r2)], 2.0);
        assert_eq!(times.len(), 2, "{r1} {r2}: {times:?}");
        // x is flat between close roots: an error of 1e-16 in it moves them by more
        let error = 1e-15 / (r2 - r1).min(1.0);
        assert!((times[0] - r1).abs() < error, "{times:?}");
        assert!((times[1] - r2).abs() < error, "{times:?}");
    }
}

#[test]
fn a_tangential_touch_is_no_transition() {
    // x = (t − 0.2)²/2, and a near miss
    for (x, grazes) in [(0.02, 1), (0.020_001, 0)] {
        let solution = start(&Parabola::default(), [x, -0.2])
            .run_until(1.0)
            .unwrap();
        assert!(solution.transitions().is_empty());
        assert_eq!(solution.statistics().grazes, grazes, "{x}");
    }
}

#[test]
fn a_zero_at_the_end_time_belongs_to_the_last_step() {
    let solution = start(&Drift::default(), [1.0]).run_until(1.0).unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert_eq!(solution.transitions()[0].t, 1.0);
    assert_eq!(solution.last().unwrap().region, DriftRegion::Below);
}

#[test]
fn the_located_point_does_not_fire_again() {
    for k in 0..100 {
        let y = 0.3 + 1e-3 * f64::from(k);
        let times = times(&Turning::default(), [1.0, y], 20.0);
        // half turns of π above and π/2 below; the first ends at π − atan(y)
        let pi = std::f64::consts::PI;
        let mut exact = pi - y.atan();
        for (number, t) in times.iter().enumerate() {
            assert!((t - exact).abs() < 1e-13, "{y}: {t} {exact}");
            exact += if number % 2 == 0 { pi / 2.0 } else { pi };
        }
        assert_eq!(times.len(), 8);
    }
}

#[test]
fn an_interface_may_move() {
    // from x = 1: x = 1 + t meets x = 2t − 1 at t = 2, then x = 3 + (t − 2)/2
    let solution = start(&Moving::default(), [1.0]).run_until(4.0).unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert!((solution.transitions()[0].t - 2.0).abs() < 1e-15);
    assert!((solution.last().unwrap().x[0] - 4.0).abs() < 1e-14);
}

#[test]
fn both_sides_of_a_transition_are_points() {
    let solution = start(&Parabola::default(), [0.01, -0.2])
        .run_until(1.0)
        .unwrap();
    let regions: Vec<_> = solution.points().iter().map(|point| point.region).collect();
    use ParabolaRegion::{Above, Below};
    assert_eq!(regions, [Above, Above, Below, Below, Above, Above]);
}

#[test]
fn the_solution_is_known_at_every_time() {
    // y at t, in the first turn and in the second
    let y = 0.5f64;
    let (radius, first) = ((1.0 + y * y).sqrt(), std::f64::consts::PI - y.atan());
    let exact = |t: f64| {
        if t <= first {
            radius * (y.atan() + t).sin()
        } else {
            -radius * (2.0 * (t - first)).sin()
        }
    };
    let times: Vec<f64> = (0..=40).map(|k| 0.1 * f64::from(k)).collect();
    let asked = start(&Turning::default(), [1.0, y])
        .output_times(times.clone())
        .run_until(4.0)
        .unwrap();
    let kept = start(&Turning::default(), [1.0, y])
        .every(1000)
        .run_until(4.0)
        .unwrap();
    assert_eq!(asked.points().len(), times.len());
    for (point, &t) in asked.points().iter().zip(&times) {
        assert!((point.x[1] - exact(t)).abs() < 2e-15, "{t}");
        // from the last point kept, over several steps
        assert!((kept.at(t).unwrap()[1] - exact(t)).abs() < 4e-15, "{t}");
    }
}

#[test]
fn sliding_is_refused() {
    let system = Drift {
        up: -1.0,
        down: 2.0,
    };
    let interrupted = start(&system, [1.0]).run_until(2.0).unwrap_err();
    let error = interrupted.error();
    assert!(matches!(
        error.kind,
        ErrorKind::Sliding {
            interface: "wall",
            ..
        }
    ));
    assert_eq!(error.place().unwrap().t, 1.0);
    assert_eq!(interrupted.solution().last().unwrap().t, 1.0);
}

#[test]
fn the_end_of_a_solution_is_a_typed_error_with_the_solution_before_it() {
    let interrupted = start(&Vanishing::default(), [1.0])
        .run_until(2.0)
        .unwrap_err();
    assert!(
        matches!(interrupted.error().kind, ErrorKind::LeftDomain),
        "{interrupted:?}"
    );
    let solution = interrupted.solution();
    assert!((solution.last().unwrap().t - 1.0).abs() < 1e-12);
    // some errors of a step, 10⁻¹⁵ of the state each, which the flow enlarges near the end
    let error = (solution.at(0.75).unwrap()[0] - 0.5).abs();
    assert!(error < 3e-14, "{error:e}");
    let interrupted = start(&Growing::default(), [1.0])
        .run_until(100.0)
        .unwrap_err();
    assert!(matches!(interrupted.error().kind, ErrorKind::Overflow));
    assert!(interrupted.solution().last().unwrap().x[0] > 1e280);
}

#[test]
fn senseless_tolerances_are_refused() {
    for tolerance in [0.0, -1e-6, 1e-17, 0.2, f64::NAN, f64::INFINITY] {
        let interrupted = Integrator::new(&Drift::default(), Taylor::tolerance(tolerance))
            .initial(0.0, [1.0])
            .run_until(1.0)
            .unwrap_err();
        assert!(
            matches!(
                interrupted.error().kind,
                ErrorKind::InvalidInput {
                    what: "tolerance",
                    ..
                }
            ),
            "{tolerance}"
        );
    }
}
