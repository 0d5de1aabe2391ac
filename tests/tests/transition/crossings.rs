//! What is a transition, and where it is.

use dmm_problems::perturbed::Perturbed;
use dmm_runtime::{Composed, Integrator, Symmetric, pws};

use super::{Drift, DriftRegion, Moving, Parabola, ParabolaRegion, Turning, start};

#[test]
fn a_dip_within_one_step_is_two_transitions() {
    // x = 0.01 − 0.2 t + t²/2 is negative between t = 0.2 ± √0.02
    let solution = start(&Parabola::default(), 0.5, [0.01, -0.2])
        .run_until(1.0)
        .unwrap();
    let times: Vec<f64> = solution.transitions().iter().map(|t| t.t).collect();
    assert_eq!(times.len(), 2);
    for (t, exact) in times
        .iter()
        .zip([0.2 - 0.02f64.sqrt(), 0.2 + 0.02f64.sqrt()])
    {
        // two Newton iterations on numbers of size 1
        assert!((t - exact).abs() < 1e-15, "{t} {exact}");
    }
    assert_eq!(solution.transitions()[0].to, ParabolaRegion::Below);
    assert_eq!(solution.transitions()[1].to, ParabolaRegion::Above);
    assert!((solution.last().unwrap().x[0] - (0.01 - 0.2 + 0.5)).abs() < 1e-15);
}

#[test]
fn a_tangential_touch_is_no_transition() {
    // x = (t − 0.2)²/2
    let solution = start(&Parabola::default(), 0.5, [0.02, -0.2])
        .run_until(1.0)
        .unwrap();
    assert!(solution.transitions().is_empty());
    assert_eq!(solution.statistics().grazes, 1);
}

#[test]
fn a_near_miss_is_nothing() {
    let solution = start(&Parabola::default(), 0.5, [0.020001, -0.2])
        .run_until(1.0)
        .unwrap();
    assert!(solution.transitions().is_empty());
    assert_eq!(solution.statistics().grazes, 0);
}

#[test]
fn a_touch_at_a_node_is_no_transition() {
    // x = (t − 0.5)²/2
    let solution = start(&Parabola::default(), 0.5, [0.125, -0.5])
        .run_until(2.0)
        .unwrap();
    assert!(solution.transitions().is_empty());
}

#[test]
fn a_zero_at_the_end_of_a_step_is_one_transition_there() {
    let solution = start(&Drift::default(), 0.25, [1.0])
        .run_until(2.0)
        .unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert_eq!(solution.transitions()[0].t, 1.0);
    assert_eq!(solution.last().unwrap().x[0], -2.0);
}

#[test]
fn a_zero_at_the_end_time_belongs_to_the_last_step() {
    let solution = start(&Drift::default(), 0.25, [1.0])
        .run_until(1.0)
        .unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert_eq!(solution.last().unwrap().region, DriftRegion::Below);
}

#[test]
fn the_located_point_does_not_fire_again() {
    // every step size puts rounding errors of another sign on the interface
    let half_turns = |tau: f64| {
        start(&Turning::default(), tau, [1.0, 0.5])
            .observe_until(20.0, &mut ())
            .unwrap()
            .statistics
            .transitions
    };
    // half turns of π above and π/2 below; the first ends at π − atan(1/2)
    let exact = 8;
    for k in 0..100 {
        let tau = 0.01 + 1e-4 * f64::from(k);
        assert_eq!(half_turns(tau), exact, "tau = {tau}");
    }
}

#[test]
fn only_a_falling_root_is_a_crossing() {
    // roots r₁, r₂ of x in the first step: a root at its end, near its end, and near its start
    let system = Parabola::default();
    for (r1, r2) in [
        (0.25, 0.5),
        (0.25, 0.5 + 1e-11),
        (0.5 - 1e-12, 0.7),
        (0.1, 0.3),
    ] {
        let solution = start(&system, 0.5, [0.5 * r1 * r2, -0.5 * (r1 + r2)])
            .run_until(2.0)
            .unwrap();
        let times: Vec<f64> = solution.transitions().iter().map(|t| t.t).collect();
        assert_eq!(times.len(), 2, "{r1} {r2}: {times:?}");
        // x is flat between close roots: an error of 1e-16 in it moves them by more
        assert!(
            (times[0] - r1).abs() < 1e-14 && (times[1] - r2).abs() < 1e-14,
            "{times:?}"
        );
    }
    // a ball thrown up from just above the interface
    let down = Parabola { a: -1.0 };
    let solution = start(&down, 0.5, [1e-12, 0.1])
        .output_times([0.0, 0.1, 0.3])
        .run_until(1.0)
        .unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert!((solution.transitions()[0].t - 0.2).abs() < 1e-10);
    assert_eq!(solution.points().len(), 3);
}

#[test]
fn a_transition_just_before_a_node_leaves_the_next_step_alone() {
    for k in 0..2000 {
        // roots 1.5 (a node, up to rounding) and 1.7
        let a = 0.7 + 1e-5 * f64::from(k);
        let system = Parabola { a };
        let solution = start(&system, 0.3, [a * 1.5 * 1.7 / 2.0, -a * (1.5 + 1.7) / 2.0])
            .run_until(3.0)
            .unwrap();
        assert_eq!(solution.transitions().len(), 2, "a = {a}");
    }
}

#[test]
fn an_interface_may_move() {
    // from x = 1: x = 1 + t meets x = 2t − 1 at t = 2, then x = 3 + (t − 2)/2
    let solution = start(&Moving::default(), 0.37, [1.0])
        .run_until(4.0)
        .unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert!((solution.transitions()[0].t - 2.0).abs() < 1e-15);
    assert!((solution.last().unwrap().x[0] - 4.0).abs() < 1e-14);
}

#[test]
fn the_locator_can_be_replaced() {
    let system = Drift::default();
    // within the step, at its end, and beyond it
    for delay in [0.05, 0.125, 0.2] {
        let late = Perturbed {
            amplitude: delay,
            power: 0,
        };
        let solution = Integrator::new(&system, Symmetric::step_size(0.25).locator(late))
            .initial(0.0, [1.125])
            .run_until(2.0)
            .unwrap();
        assert_eq!(solution.transitions().len(), 1);
        let t = solution.transitions()[0].t;
        assert!((t - 1.125 - delay).abs() < 1e-15);
        let exact = -delay - 2.0 * (2.0 - t);
        assert!((solution.last().unwrap().x[0] - exact).abs() < 1e-14);
    }
}

pws! {
    /// An oscillator that passes three interfaces close to each other.
    system Sheets {
        state x, v;
        param b = 0, gap = 1e-4;
        interface sheets = (x - b) * (x - b - gap) * (x - b + gap);
        der(x) = v;
        der(v) = -x;
        region low where sheets < 0 {}
        region high where sheets > 0 {}
    }
}

#[test]
fn the_first_of_three_zeros_is_taken_where_the_dense_output_is_off() {
    // x = sin t, from t = −1.2; the dense output of a step of 0.1 is off by up to 10⁻⁶
    for i in 0..400 {
        let b = -0.7 + 1.4 * f64::from(i) / 400.0;
        let system = Sheets {
            b,
            ..Sheets::default()
        };
        let solution = Integrator::new(&system, Composed::<8>::step_size(0.1))
            .initial(-1.2, [(-1.2f64).sin(), 1.2f64.cos()])
            .run_until(1.2)
            .unwrap();
        let times = solution.transitions().iter().map(|transition| transition.t);
        let expected = [b - system.gap, b, b + system.gap].map(f64::asin);
        assert_eq!(times.len(), 3, "{b}");
        for (t, expected) in times.zip(expected) {
            assert!((t - expected).abs() < 1e-8, "{b}: {t} {expected}");
        }
    }
}
