//! Units of time, and sizes: a solution that moves 10⁶⁰ times as fast, or as slowly, is the same one.

use dmm_runtime::{
    Composed, End, Ensemble, ErrorKind, Member, Method, Symmetric, Taylor, Vector, pws,
};
use dmm_tests::run;

pws! {
    /// A mass on a spring whose force grows with the third power: s times as large, it moves s
    /// times as fast.
    pub system Quartic {
        state q, p;
        der(q) = p;
        der(p) = -q^3;
        conserved energy = p^2 / 2 + q^4 / 4;
    }
}

pws! {
    /// An oscillator driven on one side of a line that moves; all rates are multiples of s.
    pub system Driven {
        state x, y;
        param s = 1;
        interface line = x - 0.2 - cos(s * t) / 10;
        region low where line < 0 {
            der(x) = s * y;
            der(y) = s * (0.3 * cos(0.7 * s * t) - sin(x));
        }
        region high where line > 0 {
            der(x) = s * y;
            der(y) = -4 * s * x;
            conserved energy = y^2 + 4 * x^2;
        }
    }
}

/// Powers of two that the rate is changed by.
const EXPONENTS: [i32; 11] = [-490, -400, -232, -150, -100, -50, 50, 84, 100, 250, 490];

/// The state after 2 units of the time that it moves in, of an orbit 2^`exponent` times as large,
/// divided by its scale.
fn quartic(scheme: impl Method, exponent: i32) -> Vector<f64, 2> {
    let scale = f64::from(exponent).exp2();
    let initial = [0.25 * scale, 0.75 * scale * scale];
    let found = run(&Quartic {}, scheme, initial, 2.0 / scale).unwrap();
    assert!(found.statistics.steps < 10_000, "{exponent}");
    let x = found.point.x;
    Vector::from([x[0] / scale, x[1] / (scale * scale)])
}

#[test]
fn a_larger_orbit_in_a_quartic_potential_is_as_accurate() {
    // there the higher coefficients of the solution in the unit of time underflow, or overflow
    for exponent in [-232, -216, -200, -150, -50, 50, 100, 200, 250] {
        let distance = |scheme: fn(i32) -> Vector<f64, 2>| (scheme(exponent) - scheme(0)).norm();
        let symmetric = distance(|exponent| quartic(Symmetric::tolerance(1e-5), exponent));
        let composed = distance(|exponent| quartic(Composed::<8>::tolerance(1e-9), exponent));
        let coarse = distance(|exponent| quartic(Taylor::tolerance(1e-3), exponent));
        let fine = distance(|exponent| quartic(Taylor::tolerance(1e-12), exponent));
        assert!(symmetric < 1e-3, "{exponent}: {symmetric:e}");
        assert!(composed < 1e-10, "{exponent}: {composed:e}");
        assert!(coarse < 3e-3, "{exponent}: {coarse:e}");
        assert!(fine < 1e-11, "{exponent}: {fine:e}");
    }
}

/// The driven oscillator with rates of 2^`exponent`.
fn driven(scheme: impl Method, exponent: i32) -> End<DrivenRegion, 2> {
    let s = f64::from(exponent).exp2();
    run(&Driven { s }, scheme, [0.7, 0.1], 20.0 / s).unwrap()
}

#[test]
fn time_in_formulas_and_transitions_are_the_same_in_every_unit() {
    fn check<Sch: Method>(scheme: &Sch, bound: f64) {
        let plain = driven(scheme.clone(), 0);
        assert!(plain.statistics.transitions > 5);
        for exponent in EXPONENTS {
            let found = driven(scheme.clone(), exponent);
            let distance = (found.point.x - plain.point.x).norm();
            assert!(distance <= bound, "{exponent}: {distance:e}");
            let counts = [&found, &plain].map(|end| end.statistics);
            assert_eq!(counts[0].transitions, counts[1].transitions, "{exponent}");
            let steps = counts[0].steps.abs_diff(counts[1].steps);
            assert!(steps <= counts[1].steps / 8, "{exponent}: {counts:?}");
        }
    }
    check(&Taylor::tolerance(1e-3), 1e-2);
    check(&Taylor::tolerance(1e-12), 1e-12);
    check(&Symmetric::tolerance(1e-5), 1e-12);
    check(&Composed::<8>::tolerance(1e-9), 1e-12);
}

#[test]
fn an_ensemble_does_what_its_members_do_alone_in_every_unit() {
    for exponent in EXPONENTS {
        let s = f64::from(exponent).exp2();
        let t_end = 20.0 / s;
        let member = |k: i32| {
            // the last ones move in another unit of time, and hardly
            let s = if k < 7 { s } else { s * 0.5f64.powi(60) };
            Member::new(Driven { s }, 0.0, [0.7 + 0.01 * f64::from(k), 0.1])
        };
        let members: Vec<_> = (0..9).map(member).collect();
        for (tolerance, bound) in [(1e-4, 1e-2), (1e-12, 1e-12)] {
            let scheme = Taylor::tolerance(tolerance);
            let together = Ensemble::new(scheme).collect_until(t_end, members.iter().cloned());
            for (member, outcome) in members.iter().zip(together) {
                let alone = run(&member.system, scheme, member.x0.into(), t_end).unwrap();
                let found = outcome.unwrap();
                let distance = (found.point.x - alone.point.x).norm();
                assert!(distance <= bound, "{exponent}, {tolerance:e}: {distance:e}");
                let counts = [&found, &alone].map(|end| end.statistics);
                assert_eq!(counts[0].transitions, counts[1].transitions, "{exponent}");
                let steps = counts[0].steps.abs_diff(counts[1].steps);
                assert!(steps <= 2 + counts[1].steps / 4, "{exponent}: {counts:?}");
            }
        }
    }
}

/// Halted where the state is still finite.
fn halts(scheme: impl Method, initial: [f64; 2], t_end: f64) {
    let halted = run(&Quartic {}, scheme, initial, t_end).unwrap_err();
    assert!(matches!(halted.error().kind, ErrorKind::Overflow));
    let end = halted.end().unwrap();
    assert!(end.point.x.iter().all(|x| x.is_finite()), "{end:?}");
}

#[test]
fn a_level_beyond_the_range_of_doubles_is_told() {
    // p² overflows, q and p do not
    let scale = 266f64.exp2();
    let (initial, t_end) = ([0.25 * scale, 0.75 * scale * scale], 2.0 / scale);
    halts(Symmetric::tolerance(1e-5), initial, t_end);
    halts(Composed::<8>::tolerance(1e-9), initial, t_end);
    halts(Symmetric::step_size(1e-3 / scale), initial, t_end);
    halts(Composed::<4>::step_size(1e-3 / scale), initial, t_end);
}
