//! Switching functions that change several times in a step.

use dmm_runtime::{Composed, Method, Symmetric, Taylor, pws};
use dmm_tests::run;

pws! {
    /// A mass under a force that changes its sign with a wave of the time.
    pub system Driven {
        state x, v;
        param omega = 1;
        interface wave = sin(omega*t);
        region up where wave > 0 { der(x) = v; der(v) = 1; }
        region down where wave < 0 { der(x) = v; der(v) = -1; }
    }
}

pws! {
    /// Three sheets close to each other.
    pub system Sheets {
        state x, v;
        param d = 1e-4;
        interface sheets = x*(x - d)*(x + d);
        region right where sheets > 0 { der(x) = v; der(v) = -x; }
        region left where sheets < 0 { der(x) = v; der(v) = -x - 1; }
    }
}

/// x(T) and the number of transitions of a force that is 1 and −1 for half a period each.
fn driven(omega: f64, t_end: f64) -> (f64, u64) {
    let half = std::f64::consts::PI / omega;
    let (mut t, mut x, mut v, mut sign, mut count) = (0.0, 0.0, 0.0, 1.0, 0);
    while t < t_end {
        let next = half * (count + 1) as f64;
        let step = if next < t_end { next - t } else { t_end - t };
        x += v * step + 0.5 * sign * step * step;
        v += sign * step;
        t += step;
        if next < t_end {
            sign = -sign;
            count += 1;
        } else {
            break;
        }
    }
    (x, count)
}

fn waves(scheme: impl Method) {
    for (omega, t_end) in [(1.0, 100.0), (100.0, 10.0)] {
        // just after the first zero, at the start
        let start = 1e-3 / omega;
        let found = dmm_runtime::Integrator::new(&Driven { omega }, scheme.clone())
            .initial(start, [0.0, 0.0])
            .observe_until(t_end, &mut ())
            .unwrap();
        let (mut x, count) = driven(omega, t_end);
        // without what happens until the start
        x -= start * (t_end - start) + 0.5 * start * start;
        assert_eq!(found.statistics.transitions, count, "{omega}");
        assert!((found.point.x[0] - x).abs() < 1e-9 * x.abs(), "{omega}");
    }
}

#[test]
fn every_zero_of_a_wave_of_the_time_is_met() {
    waves(Composed::<6>::tolerance(1e-9));
    waves(Symmetric::tolerance(1e-3));
    waves(Symmetric::step_size(1.7));
    waves(Composed::<4>::step_size(5.0));
    waves(Taylor::tolerance(1e-6));
}

#[test]
fn sheets_that_are_close_are_crossed_one_after_the_other() {
    let exact = run(
        &Sheets::default(),
        Taylor::tolerance(1e-15),
        [1.0, 0.0],
        20.0,
    )
    .unwrap();
    assert!(exact.statistics.transitions >= 9);
    let composed = Composed::<6>::tolerance(1e-9);
    let symmetric = Symmetric::tolerance(1e-6);
    for found in [
        run(&Sheets::default(), composed, [1.0, 0.0], 20.0).unwrap(),
        run(&Sheets::default(), symmetric, [1.0, 0.0], 20.0).unwrap(),
        run(
            &Sheets::default(),
            Symmetric::step_size(1e-2),
            [1.0, 0.0],
            20.0,
        )
        .unwrap(),
        run(
            &Sheets::default(),
            Composed::<4>::step_size(0.1),
            [1.0, 0.0],
            20.0,
        )
        .unwrap(),
    ] {
        assert_eq!(found.statistics.transitions, exact.statistics.transitions);
        assert!((found.point.x - exact.point.x).norm() < 1e-2);
    }
}
