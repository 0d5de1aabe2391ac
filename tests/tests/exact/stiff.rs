//! Stiff regions: the steps are those of g, not those of what has decayed.

use std::f64::consts::PI;

use dmm_runtime::pws;

use super::{assert_near, solve, times};

/// The ratio of the rates.
const FAST: f64 = 1e8;

pws! {
    /// x follows cos t at a rate of 10⁸, as if it were at once.
    system Follower {
        state x, c, s;
        param rate = 1e8, level = 0.5;
        interface wall = x - level;
        region low where wall < 0 {
            der(x) = rate * (c - x);
            der(c) = -s;
            der(s) = c;
            conserved radius = c^2 + s^2;
        }
        region high where wall > 0 {
            der(x) = rate * (c - x);
            der(c) = -s;
            der(s) = c;
            conserved radius = c^2 + s^2;
        }
    }
}

#[test]
fn a_fast_mode_costs_only_while_it_decays() {
    // x = (cos t + ε sin t)/(1 + ε²), ε = 1/rate, once e^{−rate t} is gone
    let t_end = 100.0;
    let solution = solve(&Follower::default(), [1.0, 1.0, 0.0], t_end);
    let shift = (1.0 / FAST).atan();
    let exact: Vec<f64> = (0..40)
        .map(|k| {
            let turn = 2.0 * PI * f64::from(k / 2);
            let angle = PI / 3.0;
            shift
                + if k % 2 == 0 {
                    turn + angle
                } else {
                    turn + 2.0 * PI - angle
                }
        })
        .filter(|t| *t < t_end)
        .collect();
    let found: Vec<f64> = solution.transitions().iter().map(|t| t.t).collect();
    assert_near(&found, &exact, 1e-13);
    // each crossing starts the transient anew, some 30 doublings of the step
    let steps = solution.statistics().steps;
    assert!(steps < 250 * (1 + exact.len() as u64), "{steps}");
    let x = solution.last().unwrap().x;
    assert!((x[0] - (t_end - shift).cos()).abs() < 1e-13);
}

#[test]
fn crossings_in_the_transient_are_found() {
    // from 0 to 1 at the rate 10⁸: through 1/2 after ln 2/rate, and slowly back after π/3
    let found = times(&Follower::default(), [0.0, 1.0, 0.0], 2.0);
    assert_eq!(found.len(), 2);
    assert!((found[0] * FAST - 2f64.ln()).abs() < 1e-7, "{found:?}");
    assert!(
        (found[1] - PI / 3.0 - 1.0 / FAST).abs() < 1e-15,
        "{found:?}"
    );
    // down through the wall and up again, in 10⁻⁸, then slowly down
    let x0 = [0.6, 0.55, -0.835_164_654_424_903_6];
    let found = times(
        &Follower {
            rate: FAST,
            level: 0.56,
        },
        x0,
        0.5,
    );
    let decay = (0.05f64 / 0.01).ln() / FAST;
    assert!((found[0] - decay).abs() < 1e-14, "{found:?} {decay}");
}

pws! {
    /// A slow oscillator beside a fast one, of which the interface sees a part.
    system Beside {
        state x, y, u, w;
        param part = 0, fast = 1000;
        interface wall = x + part * u;
        region low where wall < 0 {
            der(x) = y; der(y) = -x; der(u) = fast * w; der(w) = -fast * u;
            conserved slow = x^2 + y^2;
            conserved quick = u^2 + w^2;
        }
        region high where wall > 0 {
            der(x) = y; der(y) = -x; der(u) = fast * w; der(w) = -fast * u;
            conserved slow = x^2 + y^2;
            conserved quick = u^2 + w^2;
        }
    }
}

#[test]
fn every_crossing_of_a_fast_oscillation_is_found() {
    // sin t + part sin(fast t): around t = kπ it crosses many times
    let (part, fast, t_end) = (0.05, 1000.0, 10.0);
    let g = |t: f64| t.sin() + part * (fast * t).sin();
    let samples = 4_000_000;
    let signs = (1..=samples).map(|k| g(t_end * f64::from(k) / f64::from(samples)) > 0.0);
    let count = signs
        .clone()
        .zip(signs.skip(1))
        .filter(|(a, b)| a != b)
        .count();
    assert!(count > 90, "{count}");
    let found = times(&Beside { part, fast }, [0.0, 1.0, 0.0, 1.0], t_end);
    assert_eq!(found.len(), count);
    for t in found {
        assert!(g(t).abs() < 1e-11, "{t}: {}", g(t));
    }
}

#[test]
fn an_oscillation_that_no_interface_sees_costs_nothing() {
    let (part, fast) = (0.0, 1e6);
    let solution = solve(&Beside { part, fast }, [0.0, 1.0, 0.0, 1.0], 100.0);
    let exact: Vec<f64> = (1..=31).map(|k| PI * f64::from(k)).collect();
    let found: Vec<f64> = solution.transitions().iter().map(|t| t.t).collect();
    assert_near(&found, &exact, 1e-13);
    let steps = solution.statistics().steps;
    assert!(steps < 32 * 120, "{steps}");
    let x = solution.last().unwrap().x;
    // the phase of the fast one is 10⁸
    assert_near(
        x.as_slice(),
        &[100f64.sin(), 100f64.cos(), 1e8f64.sin(), 1e8f64.cos()],
        1e-12,
    );
}
