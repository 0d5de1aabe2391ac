//! Switching functions whose series converge more slowly than those of the state.

use dmm_runtime::{Best, Composed, Ensemble, ErrorKind, Member, Symmetric, Taylor, pws};
use dmm_tests::{run, transition_times};

pws! {
    /// Free flight out of a circle, told by its radius, into a force.
    pub system Circle {
        state x, y, u, v;
        interface wall = sqrt(x^2 + y^2) - 1;
        region inside where wall < 0 { der(x) = u; der(y) = v; der(u) = 0; der(v) = 0; }
        region outside where wall > 0 { der(x) = u; der(y) = v; der(u) = -x; der(v) = -y; }
    }
}

pws! {
    /// A curve with a corner in its second derivative.
    pub system Corner {
        state x, y;
        interface curve = x + 0.3*y*sqrt(y^2);
        region right where curve > 0 { der(x) = y; der(y) = -x; }
        region left where curve < 0 { der(x) = y; der(y) = -2*x; }
    }
}

#[test]
fn the_radius_of_free_flight_is_met() {
    // |(0.1 + t, 0.2 + 0.3 t)| = 1
    let (a, b, c): (f64, f64, f64) = (1.09, 0.32, 0.05 - 1.0);
    let exact = (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
    let initial = [0.1, 0.2, 1.0, 0.3];
    let times = [
        transition_times(&Circle {}, Taylor::tolerance(1e-12), initial, 6.0),
        transition_times(&Circle {}, Taylor::tolerance(1e-3), initial, 6.0),
        transition_times(&Circle {}, Best::tolerance(1e-12), initial, 6.0),
        transition_times(&Circle {}, Symmetric::step_size(0.3), initial, 6.0),
        transition_times(&Circle {}, Symmetric::tolerance(1e-6), initial, 6.0),
        transition_times(&Circle {}, Composed::<6>::tolerance(1e-6), initial, 6.0),
    ];
    for times in times {
        assert!((times.unwrap()[0] - exact).abs() < 1e-14);
    }
    let outcomes = Ensemble::new(Taylor::tolerance(1e-12))
        .collect_until(6.0, (0..8).map(|_| Member::new(Circle {}, 0.0, initial)));
    let alone = run(&Circle {}, Taylor::tolerance(1e-12), initial, 6.0).unwrap();
    for outcome in outcomes {
        let end = outcome.unwrap();
        assert_eq!(end.statistics.transitions, alone.statistics.transitions);
        assert!((end.point.x - alone.point.x).norm() < 1e-10);
    }
}

#[test]
fn a_corner_is_no_reason_to_look_away() {
    let exact = transition_times(&Corner {}, Taylor::tolerance(1e-15), [1.0, 0.3], 50.0).unwrap();
    // half a turn of either oscillator after the other, between the same points of the curve
    assert!(exact.len() > 15);
    for window in exact.windows(3).skip(2) {
        assert!(window[2] - window[0] < 7.0 && window[2] - window[0] > 4.0);
    }
    let composed = transition_times(
        &Corner {},
        Composed::<8>::tolerance(1e-13),
        [1.0, 0.3],
        50.0,
    )
    .unwrap();
    assert_eq!(exact.len(), composed.len());
    for (exact, found) in exact.iter().zip(&composed) {
        assert!((exact - found).abs() < 1e-8, "{exact} {found}");
    }
}

pws! {
    /// A switching function that ends: its root is not real beyond x = 1.
    pub system Ends {
        state x;
        interface end = 0.1 + sqrt(1 - x);
        region before where end > 0 { der(x) = 1; }
        region after where end < 0 { der(x) = 2; }
    }
}

#[test]
fn a_switching_function_without_a_value_is_told() {
    for error in [
        run(&Ends {}, Taylor::tolerance(1e-9), [0.0], 2.0).unwrap_err(),
        run(&Ends {}, Best::tolerance(1e-9), [0.0], 2.0).unwrap_err(),
        run(&Ends {}, Symmetric::step_size(0.3), [0.0], 2.0).unwrap_err(),
        run(&Ends {}, Composed::<4>::tolerance(1e-3), [0.0], 2.0).unwrap_err(),
    ] {
        assert!(
            matches!(
                error.error().kind,
                ErrorKind::Undecided { interface: "end" }
            ),
            "{error}"
        );
    }
}
