//! One-step schemes with steps by a tolerance: errors follow it, conservation does not depend on
//! it, transitions and outputs are those of uniform steps, and what cannot go on ends typed.

use dmm_problems::systems::elliptic::Elliptic;
use dmm_runtime::{Composed, ErrorKind, Integrator, Method, Symmetric, Taylor, Vector, pws};
use dmm_tests::run;

pws! {
    /// A planet.
    pub system Planet {
        state x, y, u, v;
        let r = sqrt(x^2 + y^2);
        der(x) = u;
        der(y) = v;
        der(u) = -x / r^3;
        der(v) = -y / r^3;
        conserved energy = (u^2 + v^2) / 2 - 1 / r;
        conserved angular_momentum = x * v - y * u;
    }
}

pws! {
    /// ẋ = x², which is infinite at t = 1/x(0).
    pub system Blowup {
        state x;
        der(x) = x^2;
    }
}

/// Eccentricity 0.9, at the far end.
const PLANET: [f64; 4] = [1.9, 0.0, 0.0, 0.229_415_733_870_561_77];

/// The error of the elliptic problem at t = 10, after ten transitions.
fn error(scheme: impl Method) -> f64 {
    let system = Elliptic::default();
    let exact = run(&system, Taylor::tolerance(1e-15), [-1.0, -1.0], 10.0).unwrap();
    let found = run(&system, scheme, [-1.0, -1.0], 10.0).unwrap();
    assert_eq!(found.statistics.transitions, 10);
    (found.point.x - exact.point.x).norm()
}

#[test]
fn errors_follow_the_tolerance() {
    // some hundred steps, whose errors add up; phase errors grow with the time on top
    let errors = [
        (1e-4, error(Symmetric::tolerance(1e-4))),
        (1e-6, error(Symmetric::tolerance(1e-6))),
        (1e-6, error(Composed::<4>::tolerance(1e-6))),
        (1e-8, error(Composed::<4>::tolerance(1e-8))),
        (1e-8, error(Composed::<6>::tolerance(1e-8))),
        (1e-10, error(Composed::<6>::tolerance(1e-10))),
        (1e-8, error(Composed::<8>::tolerance(1e-8))),
        (1e-11, error(Composed::<8>::tolerance(1e-11))),
    ];
    for (tolerance, error) in errors {
        assert!(error < 2000.0 * tolerance, "{tolerance:e}: {error:e}");
        assert!(error > 1e-2 * tolerance, "{tolerance:e}: {error:e}");
    }
}

#[test]
fn steps_are_short_where_the_solution_is_fast() {
    let solution = Integrator::new(&Planet {}, Composed::<4>::tolerance(1e-7))
        .initial(0.0, PLANET)
        .run_until(20.0)
        .unwrap();
    let points = solution.points();
    let steps: Vec<(f64, f64)> = points
        .windows(2)
        .map(|pair| (pair[0].x.fixed_rows::<2>(0).norm(), pair[1].t - pair[0].t))
        .collect();
    let mean = |near: bool| {
        let chosen = steps.iter().filter(|(r, _)| (*r < 0.2) == near);
        let (sum, count) = chosen.fold((0.0, 0.0), |(s, n), (_, tau)| (s + tau, n + 1.0));
        sum / count
    };
    // Kepler's third law: 19 times nearer is 83 times faster
    assert!(mean(false) > 10.0 * mean(true));
    let level = |x: &Vector<f64, 4>| {
        let r = x.fixed_rows::<2>(0).norm();
        [
            x.fixed_rows::<2>(2).norm_squared() / 2.0 - 1.0 / r,
            x[0] * x[3] - x[1] * x[2],
        ]
    };
    let [energy, momentum] = level(&points[0].x);
    for point in points {
        let [e, l] = level(&point.x);
        // the terms of the energy are as large as 10 at the near end, and rounded each
        assert!(
            (e - energy).abs() < 2e-14 && (l - momentum).abs() < 5e-15,
            "{e} {l}"
        );
    }
}

#[test]
fn outputs_and_solutions_in_between_conserve() {
    let solution = Integrator::new(&Elliptic::default(), Composed::<6>::tolerance(1e-9))
        .initial(0.0, [-1.0, -1.0])
        .output_times([0.1, 0.25, 1.0, 4.0])
        .run_until(5.0)
        .unwrap();
    let times: Vec<f64> = solution.points().iter().map(|point| point.t).collect();
    assert_eq!(times, [0.1, 0.25, 1.0, 4.0]);
    let exact = run(
        &Elliptic::default(),
        Taylor::tolerance(1e-15),
        [-1.0, -1.0],
        4.0,
    )
    .unwrap();
    let at = solution.at(4.0).unwrap();
    assert!((at - exact.point.x).norm() < 1e-6);
    let last = solution.points().last().unwrap();
    assert!((last.x - exact.point.x).norm() < 1e-6);
}

#[test]
fn a_singularity_ends_in_a_typed_error() {
    for tolerance in [1e-3, 1e-6] {
        let halted = run(&Blowup {}, Symmetric::tolerance(tolerance), [1.0], 2.0).unwrap_err();
        assert!(matches!(
            halted.error().kind,
            ErrorKind::LeftDomain | ErrorKind::NewtonFailed { .. }
        ));
        let end = halted.end().unwrap();
        assert!((end.point.t - 1.0).abs() < 0.01, "{}", end.point.t);
        assert!(end.statistics.rejected > 0 && end.statistics.steps < 100_000);
    }
}

#[test]
fn tolerances_that_make_no_sense_are_refused() {
    for tolerance in [0.0, -1.0, 1.0, f64::NAN, 1e-20] {
        let error = Integrator::new(&Blowup {}, Composed::<8>::tolerance(tolerance))
            .initial(0.0, [1.0])
            .run_until(0.5)
            .unwrap_err();
        let what = match &error.error().kind {
            ErrorKind::InvalidInput { what, .. } => *what,
            other => panic!("{other}"),
        };
        assert_eq!(what, "tolerance");
    }
}
