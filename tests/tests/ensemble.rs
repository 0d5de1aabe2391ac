//! Ensembles: every member as if it were alone.

use dmm_problems::systems::Elliptic;
use dmm_runtime::{
    End, Ensemble, ErrorKind, Halted, Integrator, Member, Symmetric, System, Taylor, Vector, pws,
};
use std::ops::ControlFlow;

pws! {
    /// A rotor that is driven on one side of a line that moves, and turned in three dimensions on
    /// the other.
    system Rotor {
        state x, y, z;
        param k = 1, w = 0.7;
        interface line = x - 0.2 - cos(t) / 10;
        region low where line < 0 {
            der(x) = k * y;
            der(y) = -x / k + 0.1 * cos(w * t);
            der(z) = sin(y) + z / (2 + x^2) - exp(-t / 9);
        }
        region high where line > 0 {
            der(x) = y - z / 9;
            der(y) = -x;
            der(z) = x / 9;
            conserved size = x^2 + y^2 + z^2;
            conserved axis = y / 9 + z;
        }
    }
}

pws! {
    /// Rises or falls towards the line y = 0, or through it, or away in finite time.
    system Line {
        state x, y;
        param below = 1, above = 1, growth = 0;
        interface line = y;
        region lower where line < 0 {
            der(x) = 1;
            der(y) = below;
        }
        region upper where line > 0 {
            der(x) = 1;
            der(y) = above + growth * y^2;
        }
    }
}

type Outcome<Sys, const N: usize> =
    Result<End<<Sys as System<N>>::Region, N>, Halted<<Sys as System<N>>::Region, N>>;

/// Each member by itself.
fn alone<Sys: System<N>, const N: usize>(
    tolerance: f64,
    t_end: f64,
    members: &[Member<Sys, N>],
) -> Vec<Outcome<Sys, N>> {
    let one = |member: &Member<Sys, N>| {
        Integrator::new(&member.system, Taylor::tolerance(tolerance))
            .initial(member.t0, member.x0)
            .observe_until(t_end, &mut ())
    };
    members.iter().map(one).collect()
}

/// Asserts that the ensemble does what each member does alone: the same transitions in not many
/// steps more, and end points that differ by `accuracy` at most.
fn assert_as_alone<Sys: System<N>, const N: usize>(
    tolerance: f64,
    t_end: f64,
    members: &[Member<Sys, N>],
    accuracy: f64,
) where
    Sys::Region: PartialEq,
{
    let together =
        Ensemble::new(Taylor::tolerance(tolerance)).collect_until(t_end, members.iter().cloned());
    let expected = alone(tolerance, t_end, members);
    assert_eq!(together.len(), members.len());
    for (number, (one, other)) in together.iter().zip(&expected).enumerate() {
        let (one, other) = match (one, other) {
            (Ok(one), Ok(other)) => (one, other),
            (Err(one), Err(other)) => {
                let kinds = [one, other].map(|halted| std::mem::discriminant(&halted.error().kind));
                assert_eq!(kinds[0], kinds[1], "{number}: {one} / {other}");
                assert_eq!(one.end().is_some(), other.end().is_some(), "{number}");
                continue;
            }
            _ => panic!("{number}: {one:?} / {other:?}"),
        };
        assert_eq!(one.point.t, other.point.t, "{number}");
        assert_eq!(one.point.region, other.point.region, "{number}");
        let counts = [one, other].map(|end| end.statistics);
        assert_eq!(counts[0].transitions, counts[1].transitions, "{number}");
        let steps = counts[0].steps.abs_diff(counts[1].steps);
        // lanes have an order of their own, and cut other steps near an interface
        assert!(steps <= 2 + counts[1].steps / 2, "{number}: {counts:?}");
        let distance = (one.point.x - other.point.x).norm();
        assert!(distance <= accuracy, "{number}: {distance:e}");
    }
}

/// Elliptic curves around those of the problem.
fn curves(count: usize) -> Vec<Member<Elliptic, 2>> {
    let member = |i: usize| {
        let (u, v) = ((i % 8) as f64 / 8.0, (i / 8) as f64 / 8.0);
        let system = Elliptic {
            a_inside: -3.0 - 0.1 * v,
            a_outside: -2.0 + 0.05 * u,
        };
        Member::new(system, 0.0, [-1.0 - 0.04 * v, -1.0 + 0.05 * u])
    };
    (0..count).map(member).collect()
}

#[test]
fn lanes_do_what_each_trajectory_does_alone() {
    // ten periods enlarge the truncation errors, which depend on the last bits of the steps, a
    // few hundred times
    for (tolerance, accuracy) in [(1e-5, 1e-1), (1e-8, 1e-4), (1e-11, 1e-8), (1e-15, 1e-11)] {
        assert_as_alone(tolerance, 20.0, &curves(37), accuracy);
    }
}

#[test]
fn lanes_reach_the_reference() {
    // x, y at t = 100 from (-1, -1) in 60-digit arithmetic
    let reference = Vector::from([-0.319_869_065_985_265_8, -0.694_145_184_033_406_7]);
    let member = Member::new(Elliptic::default(), 0.0, [-1.0, -1.0]);
    let members = std::iter::repeat_n(member, 5);
    for outcome in Ensemble::new(Taylor::tolerance(1e-13)).collect_until(100.0, members) {
        let end = outcome.unwrap();
        assert_eq!(end.statistics.transitions, 105);
        assert_eq!(end.statistics.crossed, 105);
        assert!((end.point.x - reference).norm() < 1e-10, "{}", end.point.x);
    }
}

#[test]
fn times_functions_and_several_quantities_in_lanes() {
    let member = |i: u32| {
        let u = f64::from(i) / 30.0;
        let system = Rotor {
            k: 1.0 + u,
            w: 0.7 - u,
        };
        Member::new(system, u, [0.9 - u, 0.3, u])
    };
    let members: Vec<_> = (0..30).map(member).collect();
    // z grows a few thousandfold, and with it the errors of the steps
    assert_as_alone(1e-12, 15.0, &members, 1e-8);
    assert_as_alone(1e-6, 15.0, &members, 1e-3);
}

#[test]
fn a_start_on_an_interface_and_no_time_at_all() {
    let mut members = curves(6);
    members[2].x0 = [-0.6, 0.8].into();
    members[3].x0 = [0.0, -1.0].into();
    assert_as_alone(1e-12, 10.0, &members, 1e-10);
    members.iter_mut().for_each(|member| member.t0 = 3.0);
    assert_as_alone(1e-12, 3.0, &members, 0.0);
}

#[test]
fn one_failure_does_not_lose_the_others() {
    let member = |below: f64, above: f64, growth: f64, y: f64| {
        let system = Line {
            below,
            above,
            growth,
        };
        Member::new(system, 0.0, [0.0, y])
    };
    let members = [
        member(1.0, 1.0, 0.0, -1.5),
        // slides
        member(1.0, -1.0, 0.0, -1.5),
        // infinite at about y = tan t
        member(1.0, 1.0, 1.0, -0.5),
        member(1.0, 1.0, 0.0, f64::NAN),
        // starts between two regions that are both left
        member(-1.0, 1.0, 0.0, 0.0),
        member(-1.0, 1.0, 0.0, -1.0),
        member(f64::INFINITY, 1.0, 0.0, -1.0),
        member(1.0, 2.0, 0.0, -0.25),
        // tangential
        member(1.0, 0.0, 0.0, -0.25),
    ];
    assert_as_alone(1e-9, 4.0, &members, 1e-12);
    let outcomes = Ensemble::new(Taylor::tolerance(1e-9)).collect_until(4.0, members);
    let failed = |index: usize| outcomes[index].as_ref().unwrap_err().error();
    assert!(matches!(failed(1).kind, ErrorKind::Sliding { .. }));
    assert!(matches!(failed(3).kind, ErrorKind::InvalidInput { .. }));
    assert!(matches!(failed(8).kind, ErrorKind::Tangential { .. }));
    let slid = outcomes[1].as_ref().unwrap_err().end().unwrap();
    assert!((slid.point.t - 1.5).abs() < 1e-15);
    assert_eq!(slid.point.region, LineRegion::Lower);
    let through = outcomes[7].as_ref().unwrap();
    assert!((through.point.x[1] - 2.0 * 3.75).abs() < 1e-14);
}

#[test]
fn results_come_in_order_from_all_threads() {
    let members = || (0..700).map(|i| Member::new(Line::default(), 0.0, [f64::from(i), -1.0]));
    for threads in [1, 3] {
        let mut next = 0;
        let ensemble = Ensemble::new(Taylor::tolerance(1e-6)).threads(threads);
        let count = ensemble.run_until(2.0, members(), |index, outcome| {
            assert_eq!(index, next);
            let x = outcome.unwrap().point.x[0];
            assert!((x - (index as f64 + 2.0)).abs() < 1e-9);
            next += 1;
            ControlFlow::Continue(())
        });
        assert_eq!(count, 700);
    }
}

#[test]
fn every_scheme_and_an_observer_for_each_member() {
    let members = curves(5);
    let outcomes = Ensemble::new(Symmetric::step_size(1e-2))
        .threads(2)
        .collect_until(2.0, members.clone());
    for (member, outcome) in members.iter().zip(&outcomes) {
        let expected = Integrator::new(&member.system, Symmetric::step_size(1e-2))
            .initial(member.t0, member.x0)
            .observe_until(2.0, &mut ())
            .unwrap();
        assert_eq!(*outcome.as_ref().unwrap(), expected);
    }

    /// The times of the transitions.
    struct Times(Vec<f64>);

    impl<R, const N: usize> dmm_runtime::Observer<R, N> for Times {
        fn transition(&mut self, transition: &dmm_runtime::Transition<R, N>) -> ControlFlow<()> {
            self.0.push(transition.t);
            ControlFlow::Continue(())
        }
    }

    let observed = members
        .into_iter()
        .map(|member| (member, Times(Vec::new())));
    let ensemble = Ensemble::new(Taylor::tolerance(1e-12)).threads(2);
    let count = ensemble.observe_until(5.0, observed, |index, times, outcome| {
        let transitions = outcome.unwrap().statistics.transitions;
        assert!(transitions >= 4, "{index}");
        assert_eq!(times.0.len() as u64, transitions);
        assert!(times.0.is_sorted());
        ControlFlow::Continue(())
    });
    assert_eq!(count, 5);
}
