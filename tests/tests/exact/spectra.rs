//! A of every kind: oscillating, growing, decaying, singular, nilpotent, defective, zero.

use std::f64::consts::{PI, SQRT_2};

use dmm_runtime::{ErrorKind, pws};

use super::{assert_near, solve, start, times};

pws! {
    /// An oscillator whose spring stiffens below y = 0.
    system Harmonic {
        state x, y;
        param k_above = 1, k_below = 3;
        interface spring = y;
        region above where spring > 0 {
            der(x) = y;
            der(y) = -k_above * x;
            conserved energy = (y^2 + k_above * x^2) / 2;
        }
        region below where spring < 0 {
            der(x) = y;
            der(y) = -k_below * x;
            conserved energy = (y^2 + k_below * x^2) / 2;
        }
    }
}

#[test]
fn an_oscillator_keeps_its_phase_and_its_level() {
    let solution = solve(&Harmonic::default(), [1.0, 1.0], 1e4);
    let transitions = solution.transitions();
    assert_eq!(transitions.len(), 4036);
    let period = PI * (1.0 + 1.0 / 3f64.sqrt());
    for (number, transition) in transitions.iter().enumerate() {
        // half an ellipse below follows each quarter or half circle above
        let turns = (number / 2) as f64;
        let below = if number % 2 == 1 {
            PI / 3f64.sqrt()
        } else {
            0.0
        };
        let exact = 0.75 * PI - 0.5 * PI + turns * period + below;
        assert!(
            (transition.t - exact).abs() < 1e-11,
            "{number}: {} {exact}",
            transition.t
        );
        assert!((transition.x[0].abs() - SQRT_2).abs() < 1e-14, "{number}");
    }
    // by 60-digit arithmetic
    let exact = [1.018_728_153_023_950_8, 0.980_914_343_985_442_2];
    let x = solution.last().unwrap().x;
    assert_near(x.as_slice(), &exact, 2e-14);
}

pws! {
    /// A ball in a field that turns with its sign: parabolas, of a nilpotent A and b ≠ 0.
    system Parabolas {
        state x, v;
        interface floor = x;
        region above where floor > 0 {
            der(x) = v;
            der(v) = -1;
            conserved energy = v^2 / 2 + x;
        }
        region below where floor < 0 {
            der(x) = v;
            der(v) = 1;
            conserved energy = v^2 / 2 - x;
        }
    }
}

#[test]
fn of_a_nilpotent_matrix_the_flow_is_a_polynomial() {
    let exact: Vec<f64> = (1..=500).map(|k| 2.0 * f64::from(k)).collect();
    assert_eq!(times(&Parabolas {}, [0.0, 1.0], 1001.0), exact);
    let solution = solve(&Parabolas {}, [0.0, 1.0], 1001.0);
    let end = solution.last().unwrap().x;
    assert!(end[0] == 0.5 && end[1].abs() < 1e-20, "{end}");
    assert_eq!(solution.at(2.5).unwrap().as_slice(), [-0.375, -0.5]);
}

pws! {
    /// A constant field: A = 0.
    system Drift {
        state x;
        interface wall = x - 1;
        region left where wall < 0 { der(x) = 0.25; }
        region right where wall > 0 { der(x) = 2; }
    }
}

#[test]
fn of_a_constant_field_the_flow_is_a_line() {
    assert_eq!(times(&Drift {}, [0.0], 1e6), [4.0]);
    assert_eq!(
        solve(&Drift {}, [0.0], 1e6).last().unwrap().x[0],
        1.0 + 2.0 * (1e6 - 4.0)
    );
    // an end on the interface belongs to the step before
    let solution = solve(&Drift {}, [0.0], 4.0);
    assert_eq!(solution.transitions().len(), 1);
}

pws! {
    /// A damped oscillator: critically, with a defective A, while x > 0.
    system Critical {
        state x, v;
        interface middle = x;
        region out where middle > 0 {
            der(x) = v;
            der(v) = -x - 2 * v;
            // x′ = v has (x + v) eᵗ constant, and v/(x + v) + t
            conserved amplitude = (x + v) * exp(t);
        }
        region back where middle < 0 {
            der(x) = v;
            der(v) = 0;
            conserved speed = v;
        }
    }
}

#[test]
fn a_defective_matrix_is_like_any_other() {
    // x = (x₀ + (x₀ + v₀) t) e⁻ᵗ
    for (x0, v0) in [(1.0, -3.0), (1.0, -1.5), (1.0, -1.01), (0.25, -100.0)] {
        let t = -x0 / (x0 + v0);
        let solution = solve(&Critical {}, [x0, v0], t + 1.0);
        let crossing = &solution.transitions()[0];
        assert!(
            (crossing.t - t).abs() < 1e-15 * (1.0 + t),
            "{} {t}",
            crossing.t
        );
        let speed = (x0 + v0) * (-t).exp();
        // the rounding error of t is one of e⁻ᵗ
        let error = 1e-15 * (1.0 + t) * speed.abs();
        assert!((crossing.x[1] - speed).abs() < error);
        assert!((solution.last().unwrap().x[0] - speed).abs() < error);
    }
}

pws! {
    /// A spiral that grows, and turns faster below; the half-planes are its regions.
    system Spiral {
        state x, y;
        param rate = 0.1;
        interface axis = y;
        region above where axis > 0 {
            der(x) = rate * x - 2 * y;
            der(y) = 2 * x + rate * y;
            conserved growth = (x^2 + y^2) * exp(-2 * rate * t);
        }
        region below where axis < 0 {
            der(x) = rate * x - 5 * y;
            der(y) = 5 * x + rate * y;
            conserved growth = (x^2 + y^2) * exp(-2 * rate * t);
        }
    }
}

#[test]
fn growth_and_decay_turn_as_they_should() {
    for rate in [0.1, -0.1, 3.0, -3.0] {
        let t_end = 40.0;
        let solution = solve(&Spiral { rate }, [1.0, 0.0], t_end);
        let mut t = 0.0;
        for (number, crossing) in solution.transitions().iter().enumerate() {
            t += if number % 2 == 0 { PI / 2.0 } else { PI / 5.0 };
            assert!(
                (crossing.t - t).abs() < 1e-13,
                "{rate} {number}: {} {t}",
                crossing.t
            );
            let radius = (rate * t).exp();
            assert!((crossing.x[0].abs() - radius).abs() < 1e-13 * radius);
        }
        let turn = PI / 2.0 + PI / 5.0;
        let rest = t_end - turn * (t_end / turn).floor();
        let number = 2.0 * (t_end / turn).floor() + f64::from(u8::from(rest > PI / 2.0));
        assert_eq!(solution.transitions().len() as f64, number, "{rate}");
        let radius = (rate * t_end).exp();
        let x = solution.at(t_end).unwrap();
        assert!((x.norm() - radius).abs() < 1e-13 * radius, "{rate}");
    }
}

pws! {
    /// Two modes, e⁻ᵗ and e⁻²ᵗ, and a saddle beyond.
    system Modes {
        state u, w;
        param level = 0.2;
        interface line = u + w - level;
        region near where line < 0 {
            der(u) = -u;
            der(w) = -2 * w;
            conserved ratio = w / u^2;
        }
        region far where line > 0 {
            der(u) = -u;
            der(w) = -2 * w;
            conserved ratio = w / u^2;
        }
    }
}

#[test]
fn real_modes_cross_once_or_twice() {
    // s + c s² = level, s = e⁻ᵗ: with c < 0 it rises to 1/(4|c|) first
    for (c, level) in [
        (-1.5, 0.15),
        (-0.9, 0.12),
        (-1.5, 0.1666),
        (-2.0, 0.125 - 1e-10),
    ] {
        let root = (1.0f64 + 4.0 * c * level).sqrt();
        let mut exact: Vec<f64> = [(-1.0 - root) / (2.0 * c), (-1.0 + root) / (2.0 * c)]
            .into_iter()
            .filter(|s| *s < 1.0)
            .map(|s| -s.ln())
            .collect();
        exact.sort_by(f64::total_cmp);
        assert!(!exact.is_empty());
        let found = times(&Modes { level }, [1.0, c], 10.0);
        // the roots are as flat as they are close: rounding errors of g move them
        assert_near(&found, &exact, 1e-15 / root);
    }
}

pws! {
    /// Growth beyond all bounds.
    system Explosion {
        state x;
        interface wall = x + 1;
        region left where wall < 0 { der(x) = 0; }
        region right where wall > 0 { der(x) = 1000 * x; }
    }
}

#[test]
fn what_overflows_is_refused_where_it_does() {
    let halted = start(&Explosion {}, [1.0])
        .observe_until(10.0, &mut ())
        .unwrap_err();
    assert!(
        matches!(halted.error().kind, ErrorKind::Overflow),
        "{}",
        halted.error()
    );
    let end = halted.end().unwrap();
    let exact = (1000.0 * end.point.t).exp();
    assert!(end.point.t > 0.35 && (end.point.x[0] / exact - 1.0).abs() < 1e-12);
}
