//! Interfaces that are met often, or by series that converge more slowly than those of the state.

use dmm_runtime::{Best, Composed, Method, Taylor, Vector, pws};
use dmm_tests::{run, transition_times};

pws! {
    /// An oscillator in the plane, three times stiffer in a disc off the centre.
    pub system Disc {
        state x, y, u, v;
        interface rim = sqrt((x - 0.7)^2 + (y - 0.1)^2) - 0.2;
        region outside where rim > 0 {
            der(x) = u; der(y) = v; der(u) = -x; der(v) = -y;
            conserved energy = (u^2 + v^2 + x^2 + y^2) / 2;
        }
        region inside where rim < 0 {
            der(x) = u; der(y) = v; der(u) = -3*x; der(v) = -3*y;
            conserved energy = (u^2 + v^2 + 3*(x^2 + y^2)) / 2;
        }
    }
}

pws! {
    /// The same with the rim as a polynomial.
    pub system PolynomialDisc {
        state x, y, u, v;
        interface rim = (x - 0.7)^2 + (y - 0.1)^2 - 0.04;
        region outside where rim > 0 {
            der(x) = u; der(y) = v; der(u) = -x; der(v) = -y;
            conserved energy = (u^2 + v^2 + x^2 + y^2) / 2;
        }
        region inside where rim < 0 {
            der(x) = u; der(y) = v; der(u) = -3*x; der(v) = -3*y;
            conserved energy = (u^2 + v^2 + 3*(x^2 + y^2)) / 2;
        }
    }
}

pws! {
    /// A pendulum whose field changes where a wave of the angle changes its sign.
    pub system Wavy {
        state q, p;
        interface wave = sin(500*q);
        region up where wave > 0 { der(q) = p; der(p) = -sin(q); }
        region down where wave < 0 { der(q) = p; der(p) = -1.5*sin(q); }
    }
}

/// Numbers between −1 and 1.
fn random(count: usize) -> impl Iterator<Item = f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    (0..count).map(move |_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    })
}

/// Where a run starts, and where it ends after how many transitions.
struct Known {
    initial: [f64; 4],
    transitions: u64,
    end: Vector<f64, 4>,
}

/// Runs through the disc from random starts. The polynomial tells what is inside.
fn known_discs() -> Vec<Known> {
    let numbers: Vec<f64> = random(4 * 200).collect();
    let starts = numbers.chunks(4);
    let known = starts.filter_map(|start| {
        let initial = [start[0], start[1], start[2], start[3]];
        let exact = run(&PolynomialDisc {}, Taylor::tolerance(1e-15), initial, 20.0).ok()?;
        Some(Known {
            initial,
            transitions: exact.statistics.transitions,
            end: exact.point.x,
        })
    });
    known.collect()
}

fn discs(scheme: impl Method, known: &[Known], bound: f64) {
    let mut clear = 0;
    for exact in known {
        let initial = exact.initial;
        let Ok(found) = run(&Disc {}, scheme.clone(), initial, 20.0) else {
            continue;
        };
        clear += 1;
        assert_eq!(
            found.statistics.transitions, exact.transitions,
            "{initial:?}"
        );
        let distance = (found.point.x - exact.end).norm();
        assert!(distance < bound, "{initial:?}: {distance:e}");
    }
    assert!(clear >= 199, "{clear}");
}

#[test]
fn a_disc_is_the_same_by_its_radius_and_by_its_square() {
    let known = known_discs();
    discs(Taylor::tolerance(1e-12), &known, 1e-8);
    discs(Best::tolerance(1e-12), &known, 1e-8);
}

#[test]
fn a_wave_of_the_state_is_met_at_every_zero() {
    let initial = [1.0, 0.0];
    let exact = transition_times(&Wavy {}, Taylor::tolerance(1e-15), initial, 20.0).unwrap();
    let coarse = transition_times(&Wavy {}, Taylor::tolerance(1e-9), initial, 20.0).unwrap();
    let composed =
        transition_times(&Wavy {}, Composed::<8>::tolerance(1e-12), initial, 20.0).unwrap();
    assert!(exact.len() > 1000);
    assert_eq!((coarse.len(), composed.len()), (exact.len(), exact.len()));
    for (exact, found) in exact.iter().zip(coarse.iter().chain(&composed)) {
        assert!((exact - found).abs() < 1e-6, "{exact} {found}");
    }
}
