//! Exact flows: no crossing is located again.

use dmm_runtime::{Best, Taylor, pws};
use dmm_tests::run;

pws! {
    /// A damped oscillator that is pulled back on one side.
    pub system Pulled {
        state x, v;
        param damping = 0.02, force = 5;
        interface middle = x;
        region right where middle > 0 { der(x) = v; der(v) = -x - damping*v - force; }
        region left where middle < 0 { der(x) = v; der(v) = -x - damping*v; }
    }
}

#[test]
fn the_root_at_the_entry_is_not_located_again() {
    let initial = [-0.1, 0.5];
    let system = Pulled::default();
    let exact = run(&system, Taylor::tolerance(1e-15), initial, 100.0).unwrap();
    let found = run(&system, Best::tolerance(1e-12), initial, 100.0).unwrap();
    assert_eq!(found.statistics.transitions, exact.statistics.transitions);
    assert!((found.point.x - exact.point.x).norm() < 1e-11);
}

#[test]
fn random_oscillators_agree_with_the_series() {
    let mut number = 0.5;
    let mut random = || {
        number = (number * 9301.0 + 0.618) % 1.0;
        number
    };
    for case in 0..300 {
        let system = Pulled {
            damping: 0.2 * random(),
            force: 0.01 * 1000f64.powf(random()),
        };
        let initial = [-random(), 2.0 * random() - 1.0];
        let exact = run(&system, Taylor::tolerance(1e-14), initial, 30.0).unwrap();
        let found = run(&system, Best::tolerance(1e-12), initial, 30.0).unwrap();
        assert_eq!(
            found.statistics.transitions, exact.statistics.transitions,
            "{case}: {system:?} {initial:?}"
        );
        assert!((found.point.x - exact.point.x).norm() < 1e-9, "{case}");
    }
}
