//! Many transitions, and pairs of them that almost meet.

use dmm_runtime::{Best, Composed, Integrator, Taylor, pws};
use dmm_tests::run;

pws! {
    /// A mass under a force of constant size towards the middle.
    pub system Constant {
        state x, v;
        interface middle = x;
        region right where middle > 0 { der(x) = v; der(v) = -1; }
        region left where middle < 0 { der(x) = v; der(v) = 1; }
    }
}

#[test]
fn a_long_run_of_a_polynomial_flow_has_as_many_transitions_as_it_has() {
    // parabolas of duration 2√2 from x = 1 at rest
    let found = run(&Constant {}, Best::tolerance(1e-12), [1.0, 0.0], 1e4).unwrap();
    let count = ((1e4 / 2f64.sqrt() + 1.0) / 2.0).floor() as u64;
    assert_eq!(found.statistics.transitions, count);
    let found = run(&Constant {}, Taylor::tolerance(1e-12), [1.0, 0.0], 1e4).unwrap();
    assert_eq!(found.statistics.transitions, count);
    let found = run(
        &Constant {},
        Composed::<4>::tolerance(1e-9),
        [1.0, 0.0],
        1e4,
    )
    .unwrap();
    assert_eq!(found.statistics.transitions, count);
}

pws! {
    /// Two oscillators about different centres.
    pub system Turning {
        state x, v;
        interface wall = x - 1;
        region left where wall < 0 { der(x) = v; der(v) = -x; }
        region right where wall > 0 { der(x) = v; der(v) = -x; }
    }
}

#[test]
fn a_turn_just_behind_an_interface_crosses_it_twice_or_touches_it() {
    for exponent in 8..17 {
        let depth = 10f64.powi(-exponent);
        let found = Integrator::new(&Turning {}, Taylor::tolerance(1e-12))
            .initial(0.0, [0.0, 1.0 + depth])
            .observe_until(3.0, &mut ())
            .unwrap();
        let transitions = found.statistics.transitions;
        assert!(
            transitions == 2 || transitions == 0,
            "{depth:e}: {transitions}"
        );
        assert!(depth < 2e-15 || transitions == 2, "{depth:e}");
        assert!((found.point.x[0] - (1.0 + depth) * 3f64.sin()).abs() < 1e-12);
    }
}
