//! The elliptic billiard: energy and the product of the angular momenta about the foci.

use std::ops::ControlFlow;

use super::{Failure, Passage, Scheme, assert_close, follow, model, run};

const BILLIARD: &str = include_str!("../../../problems/hybrid/elliptic_billiard.pws");
/// The squares of the semi-axes.
const AXES: [f64; 2] = [4.0, 1.0];
/// Between the foci, where lines touch a hyperbola, and around them, where they touch an ellipse.
const STARTS: [[f64; 4]; 2] = [[0.3, 0.1, 0.8, 0.6], [1.9, 0.0, 0.1, 1.0]];

/// (u² + v²)/2, and (x v − y u)² − c² v² with the foci at (±c, 0).
fn conserved(x: &[f64]) -> [f64; 2] {
    let (energy, momentum) = ((x[2] * x[2] + x[3] * x[3]) / 2.0, x[0] * x[3] - x[1] * x[2]);
    [
        energy,
        momentum * momentum - (AXES[0] - AXES[1]) * x[3] * x[3],
    ]
}

/// The next impact after one: the time until then, the place, and the velocity after it. A line from
/// a point of the ellipse meets it again after −2 (x u/a² + y v/b²)/(u²/a² + v²/b²).
fn reflected([x, y, u, v]: [f64; 4]) -> (f64, [f64; 4]) {
    let [a, b] = AXES;
    let t = -2.0 * (x * u / a + y * v / b) / (u * u / a + v * v / b);
    (t, turned([x + t * u, y + t * v, u, v]))
}

/// The velocity after an impact at (x, y).
fn turned([x, y, u, v]: [f64; 4]) -> [f64; 4] {
    let normal = [x / AXES[0], y / AXES[1]];
    let size = normal[0] * normal[0] + normal[1] * normal[1];
    let factor = 2.0 * (u * normal[0] + v * normal[1]) / size;
    [x, y, u - factor * normal[0], v - factor * normal[1]]
}

#[test]
fn impacts_are_those_of_the_billiard_map() -> Result<(), Failure> {
    let billiard = model(BILLIARD, &[])?;
    for start in STARTS {
        let way = run(&billiard, Scheme::Taylor, &start, 100.0)?;
        assert!(way.passages.len() > 40, "{}", way.passages.len());
        // the first impact: x = x₀ + t w on the ellipse, a quadratic equation
        let [x, y, u, v] = start;
        let [a, b] = AXES;
        let (p, q) = (u * u / a + v * v / b, x * u / a + y * v / b);
        let mut t = ((q * q - p * (x * x / a + y * y / b - 1.0)).sqrt() - q) / p;
        let mut at = turned([x + t * u, y + t * v, u, v]);
        for impact in &way.passages {
            assert_close("time", &[impact.t], &[t], 1e-12);
            assert_close("impact", &impact.after, &at, 1e-12);
            let (time, next) = reflected(at);
            t += time;
            at = next;
        }
    }
    Ok(())
}

/// The time of a piece of a long run: a step is as long as the run, because its Taylor series is
/// finite, and the search for the wall begins with all of it.
const PIECE: f64 = 20.0;

/// The largest relative errors of both quantities over a number of impacts.
fn drift(start: [f64; 4], impacts: u32) -> Result<[f64; 2], Failure> {
    let levels = conserved(&start);
    let (mut errors, mut count) = ([0.0_f64; 2], 0);
    let billiard = model(BILLIARD, &[])?;
    let mut x = start.to_vec();
    while count < impacts {
        let mut look = |impact: Passage| {
            let values = conserved(&impact.after);
            for (error, (value, level)) in errors.iter_mut().zip(values.iter().zip(levels)) {
                *error = error.max((value / level - 1.0).abs());
            }
            count += 1;
            ControlFlow::Continue(())
        };
        (_, x) = follow(&billiard, Scheme::Taylor, (&x, PIECE), &mut look)?;
    }
    Ok(errors)
}

#[test]
fn many_impacts_conserve_both_quantities() -> Result<(), Failure> {
    for start in STARTS {
        assert_close("drift", &drift(start, 2_000)?, &[0.0; 2], 1e-13);
    }
    Ok(())
}

#[test]
#[ignore = "takes minutes"]
fn a_million_impacts_conserve_both_quantities() -> Result<(), Failure> {
    for start in STARTS {
        let errors = drift(start, 1_000_000)?;
        println!("from {start:?}: {:e} {:e}", errors[0], errors[1]);
        assert_close("drift", &errors, &[0.0; 2], 1e-12);
    }
    Ok(())
}
