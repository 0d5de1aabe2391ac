//! Trajectories in lanes are those of `Taylor` one at a time, to the last bit.
//!
//! Where the fused operation of lanes is that of doubles: on x86-64 in builds with the target
//! features avx2 and fma. At tolerances at which `Taylor` is of the order of lanes. No transition
//! time is told of lanes, but every bit of it enters the state after it.

#![cfg(any(
    all(target_feature = "fma", target_feature = "avx2"),
    target_arch = "aarch64"
))]

use dmm_runtime::{Ensemble, Integrator, Member, System, Taylor, pws};

pws! { system Pendulum {
    state q, p;
    param k = 1;
    der(q) = p;
    der(p) = -k * sin(q);
    conserved energy = p^2 / 2 - k * cos(q);
} }

pws! { system Top {
    state x, y, z;
    param k = 1;
    der(x) = k * y * z / 2;
    der(y) = -k * z * x;
    der(z) = k * x * y / 2;
    conserved size = x^2 + y^2 + z^2;
    conserved energy = x^2 + y^2 / 2;
} }

pws! { system Pursuit {
    state x, y;
    param k = 1;
    der(x) = y / (1 + x^2) - x * k / 3;
    der(y) = cos(t) - x;
} }

pws! { system Harmonic {
    state x, y;
    param k = 3;
    interface line = y;
    region above where line > 0 { der(x) = y; der(y) = -x; conserved e = x^2 + y^2; }
    region below where line < 0 { der(x) = y; der(y) = -k * x; conserved e = k * x^2 + y^2; }
} }

pws! { system Elliptic {
    state x, y;
    param k = -2;
    interface circle = x^2 + y^2 - 1;
    region inside where circle < 0 {
        der(x) = 2 * y;
        der(y) = 3 * x^2 - 3;
        conserved curve = y^2 - x^3 + 3 * x;
    }
    region outside where circle > 0 {
        der(x) = 2 * y;
        der(y) = 3 * x^2 + k;
        conserved curve = y^2 - x^3 - k * x;
    }
} }

pws! { system Relay {
    state x, y;
    param k = 0.1;
    interface line = x;
    region right where line > 0 { der(x) = y; der(y) = -1 - k * y; }
    region left where line < 0 { der(x) = y; der(y) = 1 - k * y * x; }
} }

pws! { system Driven {
    state x, y;
    param k = 1;
    interface line = x - cos(t) / 10;
    region right where line > 0 { der(x) = y; der(y) = -k * sin(x) - exp(-t / 9) / 4; }
    region left where line < 0 { der(x) = y; der(y) = -k * x; conserved e = k * x^2 + y^2; }
} }

/// Integrates members with parameters and initial states next to each other both ways, for times
/// that grow.
fn assert_same<Sys: System<N>, const N: usize>(system: Sys, initial: [f64; N], spread: f64) {
    let member = |i: u32| {
        let share = f64::from(i) / 21.0;
        let mut system = system.clone();
        if let Some(k) = system.parameter_mut(0) {
            *k *= 1.0 + spread * share;
        }
        Member::new(system, 0.0, initial.map(|x| x * (1.0 - spread * share)))
    };
    let members: Vec<_> = (0..21).map(member).collect();
    for tolerance in [5e-8, 1e-9, 3e-12] {
        for level_correction in [true, false] {
            let method = Taylor::tolerance(tolerance).level_correction(level_correction);
            for t_end in [0.7, 1.9, 3.1, 4.6, 7.3, 11.7, 40.0] {
                let together = Ensemble::new(method).collect_until(t_end, members.iter().cloned());
                for (number, (lane, member)) in together.iter().zip(&members).enumerate() {
                    let lane = lane.as_ref().expect("a lane that ends");
                    let alone = Integrator::new(&member.system, method)
                        .initial(member.t0, member.x0)
                        .observe_until(t_end, &mut ())
                        .expect("a run that ends");
                    let what = format!(
                        "{} {number} to {t_end} by {tolerance:e}, {level_correction}",
                        system.metadata().name
                    );
                    assert_eq!(
                        lane.statistics.transitions, alone.statistics.transitions,
                        "{what}"
                    );
                    assert_eq!(lane.statistics.steps, alone.statistics.steps, "{what}");
                    assert_eq!(lane.point.time, alone.point.time, "{what}");
                    assert_eq!(lane.point.x, alone.point.x, "{what}");
                    assert_eq!(lane.remainder, alone.remainder, "{what}");
                }
            }
        }
    }
}

#[test]
fn smooth_systems() {
    assert_same(Pendulum::default(), [0.5, 1.0], 0.3);
    assert_same(Top::default(), [0.5, 1.0, 0.3], 0.3);
    assert_same(Pursuit::default(), [0.5, 1.0], 0.3);
}

#[test]
fn one_interface_and_quadratic_quantities() {
    assert_same(Harmonic::default(), [1.0, 1.0], 0.3);
}

#[test]
fn one_interface_and_cubic_quantities() {
    assert_same(Elliptic::default(), [-1.0, -1.0], 0.03);
}

#[test]
fn one_interface_without_quantities() {
    assert_same(Relay::default(), [1.0, 0.5], 0.2);
}

#[test]
fn an_interface_that_moves() {
    assert_same(Driven::default(), [1.0, 0.5], 0.2);
}
