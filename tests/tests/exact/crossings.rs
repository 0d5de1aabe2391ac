//! Every root of g is found: several in a step, nearly tangential ones, touches.

use std::f64::consts::PI;

use dmm_runtime::pws;

use super::{assert_near, solve, start, times};

pws! {
    /// An oscillator with a wall that changes nothing.
    system Wall {
        state x, y;
        param level = 0.5;
        interface wall = x - level;
        region low where wall < 0 {
            der(x) = y;
            der(y) = -x;
            conserved energy = x^2 + y^2;
        }
        region high where wall > 0 {
            der(x) = y;
            der(y) = -x;
            conserved energy = x^2 + y^2;
        }
    }
}

#[test]
fn nearly_tangential_crossings_are_counted_right() {
    // x = sin t reaches 1 − depth: the cap above is 2 acos(1 − depth) wide
    for exponent in 1..=12 {
        let depth = 10f64.powi(-exponent);
        let level = 1.0 - depth;
        let depth = 1.0 - level;
        let half = 2.0 * (0.5 * depth).sqrt().asin();
        let exact: Vec<f64> = (0..100)
            .flat_map(|turn| {
                let top = 0.5 * PI + 2.0 * PI * f64::from(turn);
                [top - half, top + half]
            })
            .collect();
        let found = times(&Wall { level }, [0.0, 1.0], 200.0 * PI);
        // dx/dt = sin(half) there; the last bit of t = 600 is 10⁻¹³
        assert_near(&found, &exact, 2e-13 + 2e-15 / half);
    }
}

#[test]
fn a_crossing_soon_after_another_is_not_taken_for_it() {
    for k in 0..200 {
        let angle = 0.5 * 10f64.powf(-f64::from(k) / 50.0);
        let wall = Wall { level: angle.cos() };
        let exact: Vec<f64> = (0..5)
            .flat_map(|turn| [-angle, angle].map(|a| PI * (f64::from(2 * turn) + 0.5) + a))
            .collect();
        // an error of the level is one of the angle, times 1/sin
        let error = 1e-15 / angle.sin() + 1e-14;
        assert_near(&times(&wall, [0.0, 1.0], 9.75 * PI), &exact, error);
    }
}

#[test]
fn a_tangential_touch_is_no_transition() {
    for level in [
        1.0,
        1.0 + 1e-13,
        1.0 + 1e-12,
        1.0 + 1e-6,
        -1.0,
        -1.0 - 1e-12,
    ] {
        let solution = solve(&Wall { level }, [0.0, 1.0], 20.0 * PI);
        assert!(solution.transitions().is_empty(), "{level}");
        let touches = (level.abs() - 1.0).abs() < 2e-15;
        let grazes = solution.statistics().grazes;
        // where rounding leaves the minimum just inside, it is none
        assert!(
            if touches { grazes >= 3 } else { grazes == 0 },
            "{level}: {grazes}"
        );
    }
}

#[test]
fn a_start_on_the_interface_does_not_cross_it() {
    let level = 0.6;
    let solution = solve(&Wall { level }, [level, 0.8], 2.0 * PI);
    let rise = level.asin();
    let exact = [PI - 2.0 * rise, 2.0 * PI];
    let found: Vec<f64> = solution.transitions().iter().map(|t| t.t).collect();
    assert_near(&found[..1], &exact[..1], 1e-15);
    // t = 2π is the last bit of the run, and may be either side of its end
    assert!(found.len() <= 2);
}

pws! {
    /// A wall that moves.
    system Moving {
        state x, y;
        param speed = 0.3;
        interface wall = x - speed * t;
        region behind where wall < 0 {
            der(x) = y;
            der(y) = -x;
            conserved energy = x^2 + y^2;
        }
        region ahead where wall > 0 {
            der(x) = y;
            der(y) = -x;
            conserved energy = x^2 + y^2;
        }
    }
}

#[test]
fn a_moving_interface_is_met() {
    // sin t = t/8: its roots by bisection of the very function
    let speed = 0.125;
    let g = |t: f64| t.sin() - speed * t;
    let mut exact = Vec::new();
    for i in 1..1000 {
        let (mut a, mut b) = (f64::from(i) * 0.01, f64::from(i + 1) * 0.01);
        if g(a) * g(b) <= 0.0 {
            for _ in 0..60 {
                let middle = f64::midpoint(a, b);
                if g(a) * g(middle) <= 0.0 {
                    b = middle;
                } else {
                    a = middle;
                }
            }
            exact.push(a);
        }
    }
    assert_eq!(exact.len(), 3);
    assert_near(&times(&Moving { speed }, [0.0, 1.0], 10.0), &exact, 1e-14);
}

#[test]
fn output_times_are_on_the_flow() {
    let wanted: Vec<f64> = (0..=500).map(|k| 0.1 * f64::from(k)).collect();
    let solution = start(&Wall { level: 0.3 }, [0.0, 1.0])
        .output_times(&wanted[..])
        .run_until(50.0)
        .unwrap();
    assert_eq!(solution.points().len(), wanted.len());
    for (point, t) in solution.points().iter().zip(wanted) {
        assert_eq!(point.t, t);
        assert_near(point.x.as_slice(), &[t.sin(), t.cos()], 1e-14);
        assert_near(
            solution.at(t).unwrap().as_slice(),
            &[t.sin(), t.cos()],
            1e-14,
        );
    }
}
