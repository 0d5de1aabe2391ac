//! Rest: starts at an equilibrium or at zero, and solutions that come to rest.

use dmm_runtime::{Best, Composed, Method, Symmetric, Taylor, pws};
use dmm_tests::run;

pws! {
    /// A mass on a spring with its rest at x = 1/2.
    pub system Spring {
        state x, v;
        der(x) = v;
        der(v) = 1 - 2*x;
        conserved energy = v^2/2 + x^2 - x;
    }
}

pws! {
    /// Motion to the right, faster beyond zero.
    pub system Line {
        state x;
        interface zero = x;
        region left where zero < 0 { der(x) = 1; }
        region right where zero > 0 { der(x) = 1 + x; }
    }
}

pws! {
    /// Decay towards the interface, which is never reached.
    pub system Decay {
        state x;
        interface zero = x;
        region right where zero > 0 { der(x) = -x; }
        region left where zero < 0 { der(x) = -x; }
    }
}

fn spring(scheme: impl Method, bound: f64) {
    let found = run(&Spring {}, scheme, [0.0, 0.0], 10.0).unwrap();
    let omega = 2f64.sqrt();
    let exact = 0.5 * (1.0 - (omega * 10.0).cos());
    let error = (found.point.x[0] - exact).abs();
    assert!(error < bound, "{error:e}");
}

#[test]
fn a_start_at_the_origin_is_like_any_other() {
    spring(Symmetric::tolerance(1e-9), 1e-5);
    spring(Composed::<4>::tolerance(1e-9), 1e-7);
    spring(Composed::<6>::tolerance(1e-9), 1e-7);
    spring(Composed::<8>::tolerance(1e-12), 1e-10);
    spring(Taylor::tolerance(1e-12), 1e-10);
    spring(Best::tolerance(1e-12), 1e-13);
}

fn line(scheme: impl Method, bound: f64) {
    let found = run(&Line {}, scheme, [-1.0], 3.0).unwrap();
    assert_eq!(found.statistics.transitions, 1);
    let error = (found.point.x[0] - (2f64.exp() - 1.0)).abs();
    assert!(error < bound, "{error:e}");
}

#[test]
fn zero_is_crossed_in_one_dimension() {
    line(Symmetric::tolerance(1e-9), 1e-5);
    line(Composed::<4>::tolerance(1e-9), 1e-7);
    line(Composed::<8>::tolerance(1e-12), 1e-10);
    line(Taylor::tolerance(1e-12), 1e-10);
    line(Best::tolerance(1e-12), 1e-13);
}

fn decay(scheme: impl Method) {
    for t_end in [10.0, 100.0, 2000.0] {
        let found = run(&Decay {}, scheme.clone(), [1.0], t_end).unwrap();
        assert_eq!(found.statistics.transitions, 0, "{t_end}");
        assert!((0.0..1e-4).contains(&found.point.x[0]), "{t_end}");
    }
}

#[test]
fn what_never_arrives_does_not_arrive() {
    decay(Symmetric::tolerance(1e-6));
    decay(Composed::<4>::tolerance(1e-6));
    decay(Composed::<6>::tolerance(1e-9));
    decay(Composed::<8>::tolerance(1e-3));
    decay(Taylor::tolerance(1e-9));
    decay(Best::tolerance(1e-9));
}

#[test]
fn an_equilibrium_stays() {
    for found in [
        run(&Spring {}, Symmetric::tolerance(1e-6), [0.5, 0.0], 100.0).unwrap(),
        run(
            &Spring {},
            Composed::<6>::tolerance(1e-6),
            [0.5, 0.0],
            100.0,
        )
        .unwrap(),
        run(&Spring {}, Taylor::tolerance(1e-6), [0.5, 0.0], 100.0).unwrap(),
    ] {
        assert_eq!(found.point.x.as_slice(), [0.5, 0.0]);
    }
}
