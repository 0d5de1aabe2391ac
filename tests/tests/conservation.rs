//! Conservation on every problem, and the work that it takes.
//!
//! The long runs (a million steps each) are `pws conserve --scheme symmetric`; here are ten thousand
//! steps of each (of the largest chains, whose steps cost most, two thousand), with the same
//! bounds.

use std::ops::ControlFlow;

use dmm_problems::conservation::{Conservation, measure};
use dmm_problems::method::MethodName;
use dmm_problems::registry::{all, find};

const STEPS: f64 = 10_000.0;
/// Of systems of more than 16 states.
const STEPS_OF_LARGE: f64 = 2_000.0;

fn conservation(name: &str, level_correction: bool, step_size: f64) -> Conservation {
    let problem = find(name).unwrap();
    let mut run = problem.default_run();
    run.method = MethodName::Symmetric;
    run.level_correction = level_correction;
    run.step_size = step_size;
    run.t_end = step_size
        * match problem.states().len() {
            ..=16 => STEPS,
            _ => STEPS_OF_LARGE,
        };
    measure(&problem, &run, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// Levels are kept to a few units in the last place.
fn assert_kept(step_size: f64) {
    for problem in all() {
        let name = problem.description().name;
        // evaluating ψ costs two or three roundings of its terms, the state's own one each
        let kept = conservation(name, true, step_size);
        assert!(kept.ulps <= 8.0, "{name}, {step_size}: {} ulp", kept.ulps);
    }
}

#[test]
fn levels_are_kept_at_fine_steps() {
    assert_kept(1e-3);
}

#[test]
fn levels_are_kept_at_longer_steps() {
    assert_kept(7.3e-3);
}

#[test]
fn levels_are_kept_whatever_the_tolerance() {
    for problem in all() {
        let settings = [1e-3, 1e-8, 1e-15].map(|tolerance| (MethodName::Taylor, tolerance));
        for (method, tolerance) in settings.into_iter().chain([(MethodName::Best, 1e-12)]) {
            let name = format!("{}, {}", problem.description().name, method.name());
            let mut run = problem.default_run();
            run.method = method;
            run.tolerance = tolerance;
            let kept = measure(&problem, &run, &mut |_| ControlFlow::Continue(())).unwrap();
            // the truncation error of a step is taken off whole, at every tolerance; what is left
            // are the roundings of the state and of evaluating ψ here and in the correction
            assert!(kept.ulps <= 4.0, "{name}, {tolerance:e}: {} ulp", kept.ulps);
        }
    }
}

#[test]
fn levels_are_kept_at_coarse_steps() {
    // some twenty steps a period, where the flow turns ∇ψ by a third of a radian a step
    for name in [
        "harmonic",
        "pendulum",
        "toda",
        "henon_heiles",
        "relativistic_oscillator",
        "poschl_teller",
        "saturating_spring",
        "lotka_volterra_periodic",
        "rigid_body",
        "saturating_inductor",
        "food_chain",
        "fput_chain",
        "toda_chain",
        "double_pendulum",
    ] {
        let kept = conservation(name, true, 0.2);
        // ten thousand coarse steps, each with roundings of the size of the state
        assert!(kept.ulps <= 64.0, "{name}: {} ulp", kept.ulps);
    }
}

#[test]
fn conservation_is_by_construction_not_by_repair() {
    for problem in all() {
        let name = problem.description().name;
        // without correction the roundings of 10⁴ steps add up like a random walk
        let bare = conservation(name, false, 1e-3);
        assert!(bare.relative() <= 1e-14, "{name}: {:e}", bare.relative());
    }
}

#[test]
fn explicit_midpoint_does_not_conserve() {
    // the bounds above mean something: a method of the same order is far from them
    let problem = find("elliptic").unwrap();
    let mut run = problem.default_run();
    run.method = MethodName::ExplicitMidpoint;
    run.level_correction = false;
    run.step_size = 1e-3;
    run.t_end = 10.0;
    let midpoint = measure(&problem, &run, &mut |_| ControlFlow::Continue(())).unwrap();
    assert!(midpoint.ulps > 1e6);
}

/// Counters of systems whose formulas have no functions of the platform's library: a change
/// of them is a change of the algorithm.
#[test]
fn the_work_is_what_it_was() {
    let counts = |name: &str| {
        let statistics = conservation(name, true, 1e-3).statistics;
        (
            statistics.steps,
            statistics.newton_iterations,
            statistics.sweeps,
            statistics.transitions,
            statistics.bracketed,
        )
    };
    let names = ["harmonic", "elliptic", "rigid_body", "kepler_refraction"];
    assert_eq!(names.map(counts), COUNTS);
}

/// Steps, Newton iterations, sweeps, transitions, crossings that had to be bracketed.
const COUNTS: [(u64, u64, u64, u64, u64); 4] = [
    (10004, 0, 0, 4, 0),
    (10010, 464, 10946, 10, 0),
    (10001, 337, 9694, 1, 0),
    (10002, 351, 9975, 2, 0),
];
