//! The rules of transitions, each on a system whose solution is known in closed form.

use dmm_runtime::{
    Crossing, Error, Flow, Integrator, Located, Locator, NewtonLocator, Scheme, Statistics,
    Symmetric, pws,
};

pws! {
    /// Constant acceleration on both sides of x = 0: the symmetric scheme is exact for it.
    system Parabola {
        state x, v;
        param a = 1;
        interface floor = x;
        region above where floor > 0 {
            der(x) = v;
            der(v) = a;
            conserved energy = v^2 / 2 - a * x;
        }
        region below where floor < 0 {
            der(x) = v;
            der(v) = a;
            conserved energy = v^2 / 2 - a * x;
        }
    }
}

pws! {
    /// Constant velocities on both sides of x = 0.
    system Drift {
        state x;
        param up = -1, down = -2;
        interface wall = x;
        region above where wall > 0 { der(x) = up; }
        region below where wall < 0 { der(x) = down; }
    }
}

pws! {
    /// A straight line through a moving interface.
    system Moving {
        state x;
        interface front = x - 2 * t + 1;
        region ahead where front > 0 { der(x) = 1; }
        region behind where front < 0 { der(x) = 1 / 2; }
    }
}

pws! {
    /// x² = 1 − t: the solution ends at t = 1.
    system Vanishing {
        state x;
        der(x) = -1 / (2 * x);
    }
}

pws! {
    /// A circle, turning the other way below y = 0.
    system Turning {
        state x, y;
        interface axis = y;
        region above where axis > 0 {
            der(x) = -y;
            der(y) = x;
            conserved radius = x^2 + y^2;
        }
        region below where axis < 0 {
            der(x) = -2 * y;
            der(y) = 2 * x;
            conserved radius = x^2 + y^2;
        }
    }
}

#[test]
fn a_dip_within_one_step_is_two_transitions() {
    // x = 0.01 − 0.2 t + t²/2 is negative between t = 0.2 ± √0.02
    let system = Parabola::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.5))
        .initial(0.0, [0.01, -0.2])
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
    let system = Parabola::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.5))
        .initial(0.0, [0.02, -0.2])
        .run_until(1.0)
        .unwrap();
    assert!(solution.transitions().is_empty());
    assert_eq!(solution.statistics().grazes, 1);
}

#[test]
fn a_near_miss_is_nothing() {
    let system = Parabola::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.5))
        .initial(0.0, [0.020001, -0.2])
        .run_until(1.0)
        .unwrap();
    assert!(solution.transitions().is_empty());
    assert_eq!(solution.statistics().grazes, 0);
}

#[test]
fn a_zero_at_the_end_of_a_step_is_one_transition_there() {
    let system = Drift::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.25))
        .initial(0.0, [1.0])
        .run_until(2.0)
        .unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert_eq!(solution.transitions()[0].t, 1.0);
    assert_eq!(solution.last().unwrap().x[0], -2.0);
}

#[test]
fn a_zero_at_the_end_time_belongs_to_the_last_step() {
    let system = Drift::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.25))
        .initial(0.0, [1.0])
        .run_until(1.0)
        .unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert_eq!(solution.last().unwrap().region, DriftRegion::Below);
}

#[test]
fn the_located_point_does_not_fire_again() {
    // every step size puts rounding errors of another sign on the interface
    let system = Turning::default();
    let half_turns = |tau: f64| {
        Integrator::new(&system, Symmetric::step_size(tau))
            .initial(0.0, [1.0, 0.5])
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
fn points_at_a_transition_are_one_sided() {
    let system = Drift::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.3))
        .initial(0.0, [1.0])
        .run_until(2.0)
        .unwrap();
    let at: Vec<_> = solution
        .points()
        .iter()
        .filter(|point| point.t == 1.0)
        .collect();
    assert_eq!(at.len(), 2);
    assert_eq!(
        (at[0].region, at[1].region),
        (DriftRegion::Above, DriftRegion::Below)
    );
    assert!(solution.points().is_sorted_by(|a, b| a.t <= b.t));
}

#[test]
fn sliding_is_refused_with_both_rates() {
    let system = Drift {
        up: -1.0,
        down: 2.0,
    };
    let interrupted = Integrator::new(&system, Symmetric::step_size(0.3))
        .initial(0.0, [1.0])
        .run_until(2.0)
        .unwrap_err();
    assert!(
        matches!(
            interrupted.error(),
            Error::Sliding { interface: "wall", from: "above", to: "below", rate_from, rate_to, t, .. }
                if *rate_from == -1.0 && *rate_to == 2.0 && (t - 1.0).abs() < 1e-15
        ),
        "{interrupted:?}"
    );
    // nothing that was computed is lost
    let reached = interrupted.solution().last().unwrap();
    assert!((reached.t - 1.0).abs() < 1e-15 && reached.x[0].abs() < 1e-15);
    assert_eq!(interrupted.solution().statistics().steps, 4);
}

#[test]
fn a_start_on_the_interface_is_decided_by_the_rates() {
    let run = |up: f64, down: f64| {
        Integrator::new(&Drift { up, down }, Symmetric::step_size(0.3))
            .initial(0.0, [0.0])
            .run_until(1.0)
    };
    assert_eq!(
        run(1.0, 2.0).unwrap().points()[0].region,
        DriftRegion::Above
    );
    assert_eq!(
        run(-1.0, -2.0).unwrap().points()[0].region,
        DriftRegion::Below
    );
    assert!(matches!(
        run(-1.0, 2.0).unwrap_err().error(),
        Error::Sliding { .. }
    ));
    assert!(matches!(
        run(1.0, -2.0).unwrap_err().error(),
        Error::AmbiguousStart { .. }
    ));
    assert!(matches!(
        run(0.0, -2.0).unwrap_err().error(),
        Error::Tangential { .. }
    ));
}

#[test]
fn an_ambiguous_start_follows_the_region_that_is_named() {
    let system = Drift {
        up: 1.0,
        down: -2.0,
    };
    let run = |region| {
        Integrator::new(&system, Symmetric::step_size(0.3))
            .initial(0.0, [0.0])
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
        let result = Integrator::new(&system, Symmetric::step_size(0.3))
            .initial(0.0, [x])
            .region(region)
            .run_until(1.0);
        assert!(matches!(
            result.unwrap_err().error(),
            Error::InvalidInput { what: "region", .. }
        ));
    }
}

#[test]
fn an_interface_may_move() {
    // from x = 1: x = 1 + t meets x = 2t − 1 at t = 2, then x = 3 + (t − 2)/2
    let system = Moving::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.37))
        .initial(0.0, [1.0])
        .run_until(4.0)
        .unwrap();
    assert_eq!(solution.transitions().len(), 1);
    assert!((solution.transitions()[0].t - 2.0).abs() < 1e-15);
    assert!((solution.last().unwrap().x[0] - 4.0).abs() < 1e-14);
}

#[test]
fn the_end_of_a_solution_is_a_typed_error_with_the_solution_before_it() {
    let system = Vanishing::default();
    let interrupted = Integrator::new(&system, Symmetric::step_size(0.01))
        .initial(0.0, [1.0])
        .run_until(2.0)
        .unwrap_err();
    assert!(
        matches!(
            interrupted.error(),
            Error::NewtonFailed {
                region: "everywhere",
                ..
            } | Error::LeftDomain {
                region: "everywhere",
                ..
            }
        ),
        "{interrupted:?}"
    );
    let solution = interrupted.solution();
    assert!(solution.last().unwrap().t > 0.95);
    assert!((solution.at(0.75).unwrap()[0] - 0.5).abs() < 1e-3);
}

#[test]
fn output_times_do_not_change_the_steps() {
    let system = Turning::default();
    let problem = || Integrator::new(&system, Symmetric::step_size(0.01)).initial(0.0, [1.0, 0.5]);
    let times: Vec<f64> = (0..=37).map(|k| 0.27 * f64::from(k)).collect();
    let all = problem().run_until(10.0).unwrap();
    let some = problem()
        .output_times(times.clone())
        .run_until(10.0)
        .unwrap();
    assert_eq!(some.points().len(), times.len());
    assert_eq!(all.transitions(), some.transitions());
    for (point, &t) in some.points().iter().zip(&times) {
        assert_eq!(point.t, t);
        let x = all.at(t).unwrap();
        // the same step, but for the last place of the time (1.8e-15, at a speed of 2.3) and
        // of the state
        assert!((point.x - x).amax() < 5e-15, "{t}");
        assert!((point.x.norm_squared() - 1.25).abs() < 2e-15);
    }
}

#[test]
fn thinned_points_keep_both_sides_of_transitions() {
    let system = Turning::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.01))
        .initial(0.0, [1.0, 0.5])
        .every(50)
        .run_until(10.0)
        .unwrap();
    for transition in solution.transitions() {
        let sides: Vec<_> = solution
            .points()
            .iter()
            .filter(|p| p.t == transition.t)
            .map(|p| p.region)
            .collect();
        assert_eq!(sides, [transition.from, transition.to]);
    }
    assert!(solution.points().len() < 50);
    assert_eq!(solution.points().last().unwrap().t, 10.0);
}

#[test]
fn the_solution_is_known_only_where_it_was_integrated() {
    let system = Drift::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.3))
        .initial(0.0, [1.0])
        .run_until(2.0)
        .unwrap();
    for t in [-0.1, 2.1, f64::NAN] {
        assert!(matches!(solution.at(t), Err(Error::OutOfRange { .. })));
    }
}

/// Takes the crossing to be `delay` later than it is.
struct Late {
    delay: f64,
}

impl Locator for Late {
    fn locate<Sch: Scheme, const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        crossing: &Crossing<'_, Sch, F, N>,
        statistics: &mut Statistics,
    ) -> Option<Located<N>> {
        let located = NewtonLocator.locate(crossing, statistics)?;
        let elapsed = located.elapsed + self.delay;
        let increment = crossing.increment::<M>(elapsed, statistics).ok()?;
        Some(Located { elapsed, increment })
    }
}

#[test]
fn the_locator_can_be_replaced() {
    let system = Drift::default();
    // within the step, at its end, and beyond it
    for delay in [0.05, 0.125, 0.2] {
        let solution = Integrator::new(&system, Symmetric::step_size(0.25))
            .locator(Late { delay })
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

#[test]
fn bad_input_is_named() {
    let system = Drift::default();
    let run = |tau: f64, t0: f64, x: f64, t_end: f64| {
        let result = Integrator::new(&system, Symmetric::step_size(tau))
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
    assert!(run(0.1, 2.0, 1.0, 1.0).starts_with("end time: 1"));
    let strange = Drift {
        up: f64::NAN,
        down: 1.0,
    };
    let error = Integrator::new(&strange, Symmetric::step_size(0.1))
        .initial(0.0, [1.0])
        .run_until(1.0)
        .unwrap_err();
    assert!(error.to_string().starts_with("parameter: up = NaN"));
}

#[test]
fn an_integration_over_no_time_is_its_start() {
    let system = Drift::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.3))
        .initial(1.0, [1.0])
        .run_until(1.0)
        .unwrap();
    assert_eq!(solution.points().len(), 1);
    assert_eq!(solution.at(1.0).unwrap()[0], 1.0);
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
        let solution = Integrator::new(&system, Symmetric::step_size(0.5))
            .initial(0.0, [0.5 * r1 * r2, -0.5 * (r1 + r2)])
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
    let solution = Integrator::new(&down, Symmetric::step_size(0.5))
        .initial(0.0, [1e-12, 0.1])
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
        let solution = Integrator::new(&system, Symmetric::step_size(0.3))
            .initial(0.0, [a * 1.5 * 1.7 / 2.0, -a * (1.5 + 1.7) / 2.0])
            .run_until(3.0)
            .unwrap();
        assert_eq!(solution.transitions().len(), 2, "a = {a}");
    }
}

#[test]
fn a_touch_at_a_node_is_no_transition() {
    // x = (t − 0.5)²/2
    let system = Parabola::default();
    let solution = Integrator::new(&system, Symmetric::step_size(0.5))
        .initial(0.0, [0.125, -0.5])
        .run_until(2.0)
        .unwrap();
    assert!(solution.transitions().is_empty());
}

#[test]
fn a_step_longer_than_the_run_is_cut_to_it() {
    let system = Drift::default();
    let solution = Integrator::new(&system, Symmetric::step_size(1e6))
        .initial(0.0, [1.0])
        .run_until(0.5)
        .unwrap();
    assert_eq!(
        (solution.last().unwrap().t, solution.last().unwrap().x[0]),
        (0.5, 0.5)
    );
}

#[test]
fn the_solution_does_not_depend_on_which_points_are_kept() {
    let system = Turning::default();
    let problem = || Integrator::new(&system, Symmetric::step_size(0.1)).initial(0.0, [1.0, 0.5]);
    let all = problem().run_until(10.0).unwrap();
    let few = problem().every(7).run_until(10.0).unwrap();
    let none = problem().output_times([5.0]).run_until(10.0).unwrap();
    for point in all.points() {
        for thinned in [&few, &none] {
            // from a kept point on, the same steps without remainders and levels
            let x = thinned.at(point.t).unwrap();
            assert!((x - point.x).amax() < 1e-13, "t = {}", point.t);
        }
    }
}

pws! {
    /// Grows until it overflows.
    system Growing {
        state x;
        der(x) = 50 * x;
    }
}

#[test]
fn no_point_is_ever_not_finite() {
    let system = Growing::default();
    let interrupted = Integrator::new(&system, Symmetric::step_size(0.01))
        .initial(0.0, [1.0])
        .run_until(100.0)
        .unwrap_err();
    assert!(matches!(interrupted.error(), Error::LeftDomain { .. }));
    let solution = interrupted.solution();
    assert!(solution.points().iter().all(|point| point.x[0].is_finite()));
    assert_eq!(solution.points().last(), solution.last());
}
