//! The points of a solution, and the solution between them.

use dmm_runtime::{ErrorKind, Integrator, Symmetric};

use super::{Drift, DriftRegion, Turning, start};

#[test]
fn points_at_a_transition_are_one_sided() {
    let solution = start(&Drift::default(), 0.3, [1.0]).run_until(2.0).unwrap();
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
fn output_times_do_not_change_the_steps() {
    let system = Turning::default();
    let problem = || start(&system, 0.01, [1.0, 0.5]);
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
    let solution = start(&Turning::default(), 0.01, [1.0, 0.5])
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
fn the_solution_does_not_depend_on_which_points_are_kept() {
    let system = Turning::default();
    let problem = || start(&system, 0.1, [1.0, 0.5]);
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

#[test]
fn the_solution_is_known_only_where_it_was_integrated() {
    let solution = start(&Drift::default(), 0.3, [1.0]).run_until(2.0).unwrap();
    for t in [-0.1, 2.1, f64::NAN] {
        assert!(matches!(
            solution.at(t).unwrap_err().kind,
            ErrorKind::OutOfRange { .. }
        ));
    }
}

#[test]
fn an_integration_over_no_time_is_its_start() {
    let solution = Integrator::new(&Drift::default(), Symmetric::step_size(0.3))
        .initial(1.0, [1.0])
        .run_until(1.0)
        .unwrap();
    assert_eq!(solution.points().len(), 1);
    assert_eq!(solution.at(1.0).unwrap()[0], 1.0);
}

#[test]
fn a_step_longer_than_the_run_is_cut_to_it() {
    let solution = start(&Drift::default(), 1e6, [1.0]).run_until(0.5).unwrap();
    assert_eq!(
        (solution.last().unwrap().t, solution.last().unwrap().x[0]),
        (0.5, 0.5)
    );
}
