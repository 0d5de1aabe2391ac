//! Switching functions whose series converge more slowly than those of the state.

use dmm_runtime::{
    Best, Composed, Ensemble, ErrorKind, Integrator, Member, Method, Symmetric, System, Taylor,
    Vector, pws,
};
use dmm_tests::run;

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
    /// An oscillator in the plane, three times stiffer in a disc off the centre.
    pub system Disc {
        state x, y, u, v;
        interface rim = sqrt((x - 0.7)^2 + (y - 0.1)^2) - 0.2;
        region outside where rim > 0 {
            der(x) = u; der(y) = v; der(u) = -x; der(v) = -y;
            conserved energy = (u^2 + v^2 + x^2 + y^2) / 2;
        }
        region inside where rim < 0 {
            der(x) = u; der(y) = v; der(u) = -3*x; der(v) = -3*y;
            conserved energy = (u^2 + v^2 + 3*(x^2 + y^2)) / 2;
        }
    }
}

pws! {
    /// The same with the rim as a polynomial.
    pub system PolynomialDisc {
        state x, y, u, v;
        interface rim = (x - 0.7)^2 + (y - 0.1)^2 - 0.04;
        region outside where rim > 0 {
            der(x) = u; der(y) = v; der(u) = -x; der(v) = -y;
            conserved energy = (u^2 + v^2 + x^2 + y^2) / 2;
        }
        region inside where rim < 0 {
            der(x) = u; der(y) = v; der(u) = -3*x; der(v) = -3*y;
            conserved energy = (u^2 + v^2 + 3*(x^2 + y^2)) / 2;
        }
    }
}

pws! {
    /// A pendulum whose field changes where a wave of the angle changes its sign.
    pub system Wavy {
        state q, p;
        interface wave = sin(500*q);
        region up where wave > 0 { der(q) = p; der(p) = -sin(q); }
        region down where wave < 0 { der(q) = p; der(p) = -1.5*sin(q); }
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

/// Times of transitions.
fn times<Sys: System<N>, const N: usize>(
    system: &Sys,
    scheme: impl Method,
    initial: [f64; N],
    t_end: f64,
) -> Vec<f64> {
    let solution = Integrator::new(system, scheme)
        .initial(0.0, initial)
        .run_until(t_end)
        .unwrap();
    let times = solution.transitions().iter().map(|transition| transition.t);
    times.collect()
}

#[test]
fn the_radius_of_free_flight_is_met() {
    // |(0.1 + t, 0.2 + 0.3 t)| = 1
    let (a, b, c): (f64, f64, f64) = (1.09, 0.32, 0.05 - 1.0);
    let exact = (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
    let initial = [0.1, 0.2, 1.0, 0.3];
    let first = |found: Vec<f64>| (found[0] - exact).abs();
    assert!(first(times(&Circle {}, Taylor::tolerance(1e-12), initial, 6.0)) < 1e-14);
    assert!(first(times(&Circle {}, Taylor::tolerance(1e-3), initial, 6.0)) < 1e-14);
    assert!(first(times(&Circle {}, Best::tolerance(1e-12), initial, 6.0)) < 1e-14);
    assert!(first(times(&Circle {}, Symmetric::step_size(0.3), initial, 6.0)) < 1e-14);
    assert!(first(times(&Circle {}, Symmetric::tolerance(1e-6), initial, 6.0)) < 1e-14);
    assert!(
        first(times(
            &Circle {},
            Composed::<6>::tolerance(1e-6),
            initial,
            6.0
        )) < 1e-14
    );
    let outcomes = Ensemble::new(Taylor::tolerance(1e-12))
        .collect_until(6.0, (0..8).map(|_| Member::new(Circle {}, 0.0, initial)));
    let alone = run(&Circle {}, Taylor::tolerance(1e-12), initial, 6.0).unwrap();
    for outcome in outcomes {
        let end = outcome.unwrap();
        assert_eq!(end.statistics.transitions, alone.statistics.transitions);
        assert!((end.point.x - alone.point.x).norm() < 1e-10);
    }
}

/// Numbers between −1 and 1.
fn random(count: usize) -> impl Iterator<Item = f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    (0..count).map(move |_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    })
}

/// Where a run starts, and where it ends after how many transitions.
struct Known {
    initial: [f64; 4],
    transitions: u64,
    end: Vector<f64, 4>,
}

/// Runs through the disc from random starts. The polynomial tells what is inside.
fn known_discs() -> Vec<Known> {
    let numbers: Vec<f64> = random(4 * 200).collect();
    let starts = numbers.chunks(4);
    let known = starts.filter_map(|start| {
        let initial = [start[0], start[1], start[2], start[3]];
        let exact = run(&PolynomialDisc {}, Taylor::tolerance(1e-15), initial, 20.0).ok()?;
        Some(Known {
            initial,
            transitions: exact.statistics.transitions,
            end: exact.point.x,
        })
    });
    known.collect()
}

fn discs(scheme: impl Method, known: &[Known], bound: f64) {
    let mut clear = 0;
    for exact in known {
        let initial = exact.initial;
        let Ok(found) = run(&Disc {}, scheme.clone(), initial, 20.0) else {
            continue;
        };
        clear += 1;
        assert_eq!(
            found.statistics.transitions, exact.transitions,
            "{initial:?}"
        );
        let distance = (found.point.x - exact.end).norm();
        assert!(distance < bound, "{initial:?}: {distance:e}");
    }
    assert!(clear >= 199, "{clear}");
}

#[test]
fn a_disc_is_the_same_by_its_radius_and_by_its_square() {
    let known = known_discs();
    discs(Taylor::tolerance(1e-12), &known, 1e-8);
    discs(Best::tolerance(1e-12), &known, 1e-8);
}

#[test]
fn a_wave_of_the_state_is_met_at_every_zero() {
    let initial = [1.0, 0.0];
    let exact = times(&Wavy {}, Taylor::tolerance(1e-15), initial, 20.0);
    let coarse = times(&Wavy {}, Taylor::tolerance(1e-9), initial, 20.0);
    let composed = times(&Wavy {}, Composed::<8>::tolerance(1e-12), initial, 20.0);
    assert!(exact.len() > 1000);
    assert_eq!((coarse.len(), composed.len()), (exact.len(), exact.len()));
    for (exact, found) in exact.iter().zip(coarse.iter().chain(&composed)) {
        assert!((exact - found).abs() < 1e-6, "{exact} {found}");
    }
}

#[test]
fn a_corner_is_no_reason_to_look_away() {
    let exact = times(&Corner {}, Taylor::tolerance(1e-15), [1.0, 0.3], 50.0);
    // half a turn of either oscillator after the other, between the same points of the curve
    assert!(exact.len() > 15);
    for window in exact.windows(3).skip(2) {
        assert!(window[2] - window[0] < 7.0 && window[2] - window[0] > 4.0);
    }
    let composed = times(
        &Corner {},
        Composed::<8>::tolerance(1e-13),
        [1.0, 0.3],
        50.0,
    );
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
