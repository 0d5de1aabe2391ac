//! Fitted orders of accuracy before and after transitions, against solutions known to 30
//! digits: each scheme's order everywhere, and order 1 where crossings are located with an
//! error O(τ) (Hirani, Wan & Wojtalewicz, Theorem 3.1 and Figs 3, 4, 6, 7).

use std::ops::ControlFlow;

use dmm_problems::convergence::{Plan, Row, Study, study};
use dmm_problems::fit::fitted_order;
use dmm_problems::method::MethodName;
use dmm_problems::perturbed::Perturbed;
use dmm_problems::registry::find;

/// Exponents of step sizes 2⁻ᵏ in the asymptotic regime, far above rounding.
const HALVINGS: std::ops::RangeInclusive<i32> = 7..=11;

/// When smooth systems are compared: before chaos has enlarged the errors.
const T_SMOOTH: f64 = 10.0;

/// What a fitted order may be off by.
const TOLERANCE: f64 = 0.03;

fn measured(
    name: &str,
    method: MethodName,
    after: &[usize],
    halvings: std::ops::RangeInclusive<i32>,
) -> Study {
    let step_sizes = halvings.map(|k| 0.5f64.powi(k)).collect();
    studied(name, method, after, step_sizes)
}

fn studied(name: &str, method: MethodName, after: &[usize], step_sizes: Vec<f64>) -> Study {
    let problem = find(name).unwrap();
    let plan = Plan {
        method,
        initial: problem.description().initial.to_vec(),
        after: after.to_vec(),
        step_sizes,
        t_end: match problem.interfaces() {
            [] => T_SMOOTH,
            _ => problem.description().t_end,
        },
    };
    let study = study(&problem, &plan, &mut |_| ControlFlow::Continue(())).unwrap();
    assert!(study.stopped.is_empty(), "{:?}", study.stopped);
    study
}

fn assert_order(study: &Study, errors: &[f64], order: f64, what: &str) {
    let fitted = fitted_order(&study.step_sizes, errors);
    assert!(
        (fitted - order).abs() <= TOLERANCE,
        "{what}: order {fitted}, {errors:?}"
    );
}

/// A composition, with the exponent of its error, the step size from which its errors are fitted
/// on a problem of frequencies around 2, and what the order may be off by: steps are long, so that
/// the next term of the error still shows (a symmetric scheme is of even order: what is above 7
/// is 8).
struct Composition {
    method: MethodName,
    exponent: f64,
    longest_step: f64,
    tolerance: f64,
}

const COMPOSITIONS: [Composition; 3] = [
    Composition {
        method: MethodName::Composed4,
        exponent: 4.0,
        longest_step: 1.0 / 16.0,
        tolerance: 0.1,
    },
    Composition {
        method: MethodName::Composed6,
        exponent: 6.0,
        longest_step: 1.0 / 8.0,
        tolerance: 0.2,
    },
    Composition {
        method: MethodName::Composed8,
        exponent: 8.0,
        longest_step: 1.0 / 4.0,
        tolerance: 0.75,
    },
];

/// With long steps the next term of an error may still be larger than the first: errors then fall
/// faster than in the limit.
const FASTER: f64 = 1.25;

/// Errors below this are of rounding, and not fitted: a few steps of order 8 come to it.
const ROUNDING: f64 = 2e-14;
/// Errors that a fit takes, of the shortest steps.
const FITTED: usize = 4;
const FEWEST: usize = 3;

impl Composition {
    /// The study on a problem that takes steps longer by `factor`.
    fn study(&self, name: &str, factor: f64, after: &[usize]) -> Study {
        let step_size = |k: i32| factor * self.longest_step * 0.5f64.sqrt().powi(k);
        let step_sizes = (0..6).map(step_size).collect();
        studied(name, self.method, after, step_sizes)
    }

    fn assert_order(&self, study: &Study, errors: &[f64], what: &str) {
        let end = errors.iter().take_while(|error| **error > ROUNDING);
        let end = end.count();
        assert!(end >= FEWEST, "{what}: {errors:?}");
        let fitted = end.saturating_sub(FITTED)..end;
        let fitted = fitted_order(&study.step_sizes[fitted.clone()], &errors[fitted]);
        assert!(
            (-self.tolerance..=FASTER).contains(&(fitted - self.exponent)),
            "{what}: order {fitted} for {}, {errors:?}",
            self.exponent
        );
    }
}

/// The time of the row's crossing is of order 2.
fn assert_crossing_order(study: &Study, row: &Row, name: &str) {
    let crossing = row.crossing.as_ref().unwrap();
    let what = format!("{name}, time of crossing {}", crossing.number);
    assert_order(study, &crossing.errors, 2.0, &what);
}

#[test]
fn the_papers_systems_have_order_2_before_and_after_transitions() {
    for name in ["harmonic", "elliptic"] {
        let study = measured(name, MethodName::Symmetric, &[0, 10, 20, 30], HALVINGS);
        for row in &study.rows {
            for (i, errors) in row.components.iter().enumerate() {
                let what = format!("{name}, component {i} after {}", row.transitions);
                assert_order(&study, errors, 2.0, &what);
            }
            assert_crossing_order(&study, row, name);
        }
    }
}

#[test]
fn compositions_keep_their_order_across_thirty_transitions() {
    for (name, factor) in [("elliptic", 0.5), ("pendulum", 2.0)] {
        for composition in &COMPOSITIONS {
            let study = composition.study(name, factor, &[0, 10, 20, 30]);
            for row in &study.rows {
                let after = row.transitions;
                for (i, errors) in row.components.iter().enumerate() {
                    let what = format!("{name}, component {i} after {after}");
                    composition.assert_order(&study, errors, &what);
                }
                let crossing = row.crossing.as_ref().unwrap();
                let what = format!("{name}, time of crossing {}", crossing.number);
                composition.assert_order(&study, &crossing.errors, &what);
            }
        }
    }
}

#[test]
fn compositions_keep_their_order_with_every_strategy() {
    // ln; time-dependent ψ; minimal norm with M = 3; cross product; no interface
    for (name, factor, after) in [
        // before the first transition there is hardly time for an error
        ("lotka_volterra_periodic", 2.0, &[3, 6][..]),
        ("damped", 2.0, &[3, 6]),
        ("kepler_refraction", 1.0, &[3, 6]),
        ("rigid_body", 8.0, &[3, 6]),
        ("henon_heiles", 1.5, &[0]),
    ] {
        for composition in &COMPOSITIONS {
            let study = composition.study(name, factor, after);
            for row in &study.rows {
                let what = format!("{name}, after {}", row.transitions);
                composition.assert_order(&study, &row.norms(), &what);
            }
        }
    }
}

#[test]
fn every_strategy_keeps_the_order_across_transitions() {
    // skew pairing with ln, with sin; minimal norm with M = 1 and M = 3; cross product
    for name in [
        "lotka_volterra_periodic",
        "pendulum",
        "damped",
        "kepler_refraction",
        "rigid_body",
    ] {
        let study = measured(name, MethodName::Symmetric, &[0, 3, 6], HALVINGS);
        for row in &study.rows {
            // a single component may happen to have a small leading coefficient
            let what = format!("{name}, after {}", row.transitions);
            assert_order(&study, &row.norms(), 2.0, &what);
        }
    }
}

#[test]
fn chains_and_circuits_keep_the_order_across_transitions() {
    // the chains' shortest period is π: step sizes of a 200th of it are small enough
    for (name, after, halvings) in [
        ("saturating_inductor", &[0, 3, 6][..], HALVINGS),
        ("food_chain", &[0, 3, 6], HALVINGS),
        ("fput_chain", &[0, 3, 6], 6..=9),
        ("toda_chain", &[0, 3, 6], 6..=9),
        ("fput_chain_32", &[0, 1], 5..=7),
        ("toda_chain_32", &[0, 3], 5..=7),
    ] {
        let study = measured(name, MethodName::Symmetric, after, halvings);
        for row in &study.rows {
            let what = format!("{name}, after {}", row.transitions);
            assert_order(&study, &row.norms(), 2.0, &what);
            assert_crossing_order(&study, row, name);
        }
    }
}

#[test]
fn smooth_systems_have_order_2() {
    for name in [
        "toda",
        "henon_heiles",
        "relativistic_oscillator",
        "poschl_teller",
        "saturating_spring",
        "double_pendulum",
        "three_body",
    ] {
        let study = measured(name, MethodName::Symmetric, &[0], 7..=10);
        let row = &study.rows[0];
        assert_order(&study, &row.norms(), 2.0, name);
    }
}

#[test]
fn crossings_located_to_first_order_cost_an_order() {
    let late = MethodName::Perturbed(Perturbed {
        amplitude: 1.0 / 16.0,
        power: 1,
    });
    for name in ["harmonic", "elliptic"] {
        // so small that the error O(τ) has left the scheme's own O(τ²) behind
        let study = measured(name, late, &[0, 10], 12..=15);
        assert_order(
            &study,
            &study.rows[0].norms(),
            2.0,
            &format!("{name}, before"),
        );
        assert_order(
            &study,
            &study.rows[1].norms(),
            1.0,
            &format!("{name}, after 10"),
        );
    }
}
