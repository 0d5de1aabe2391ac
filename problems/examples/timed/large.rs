//! Larger systems for comparisons: chains of 4 to 64 masses, planets around a star, the outer planets.

use dmm_problems::problem::Description;
use dmm_problems::systems::fput_chain::parabola;
use dmm_runtime::{System, pws};

/// What is done with a problem whose system is a type.
pub(crate) trait Visitor {
    type Output;

    fn visit<Sys: System<N> + Default, const N: usize>(
        self,
        description: &Description,
        initial: [f64; N],
    ) -> Self::Output;
}

macro_rules! large {
    ($($name:literal $title:literal $source:ident $system:path, $states:literal $initial:expr;)*) => {
        /// Does it with the problem of this name, if there is one.
        pub(crate) fn visit<V: Visitor>(name: &str, visitor: V) -> Option<V::Output> {
            match name {
                $($name => {
                    const INITIAL: [f64; $states] = $initial;
                    let description = Description {
                        name: $name,
                        title: $title,
                        source: $source,
                        initial: &INITIAL,
                        t_end: 100.0,
                        step_size: 1e-2,
                        longest: None,
                        reference: None,
                    };
                    Some(visitor.visit::<$system, $states>(&description, INITIAL))
                })*
                _ => None,
            }
        }
    };
}

const CHAIN: &str = "Fermi, Pasta, Ulam & Tsingou, LA-1940 (1955)";
const PLANETS: &str = "Newton (1687)";
const OUTER: &str = "Hairer, Lubich & Wanner, Geometric Numerical Integration (2006), table I.2.2";

large! {
    "chain_4" "chain of 4 masses" CHAIN chain_4::Chain, 8 slanted_parabola();
    "chain_8" "chain of 8 masses" CHAIN chain_8::Chain, 16 slanted_parabola();
    "chain_16" "chain of 16 masses" CHAIN chain_16::Chain, 32 slanted_parabola();
    "chain_32" "chain of 32 masses" CHAIN chain_32::Chain, 64 slanted_parabola();
    "chain_64" "chain of 64 masses" CHAIN chain_64::Chain, 128 slanted_parabola();
    "planets_5" "a star with 4 planets in a plane" PLANETS planets_5::Planets, 20 circles::<5, 20>();
    "planets_8" "a star with 7 planets in a plane" PLANETS planets_8::Planets, 32 circles::<8, 32>();
    "outer_planets" "the outer planets" OUTER OuterPlanets, 36 OUTER_PLANETS;
}

macro_rules! chain {
    ($module:ident $masses:literal) => {
        mod $module {
            use dmm_runtime::pws;
            pws! {
                /// Springs with a quadratic and a cubic part of the force, between two walls.
                pub(super) system Chain {
                    const n = $masses;
                    /// Displacements.
                    state q[n];
                    /// Momenta.
                    state p[n];
                    param alpha = 0.25, beta = 0.5;
                    fn V(r) = r^2 / 2 + alpha * r^3 / 3 + beta * r^4 / 4;
                    hamiltonian energy = sum(i in 0..n, p[i]^2 / 2)
                        + V(q[0]) + sum(i in 1..n, V(q[i] - q[i - 1])) + V(-q[n - 1]) in (q, p);
                }
            }
        }
    };
}

chain!(chain_4 4);
chain!(chain_8 8);
chain!(chain_16 16);
chain!(chain_32 32);
chain!(chain_64 64);

macro_rules! planets {
    ($module:ident $bodies:literal $masses:tt) => {
        mod $module {
            use dmm_runtime::pws;
            pws! {
                /// Bodies in a plane; the first is a thousand times as heavy as the others.
                pub(super) system Planets {
                    const n = $bodies;
                    /// Positions.
                    state x[n], y[n];
                    /// Velocities.
                    state u[n], v[n];
                    /// Masses relative to the first.
                    param m[n] = $masses;
                    fn distance(i, j) = sqrt((x[i] - x[j])^2 + (y[i] - y[j])^2);
                    for i in 0..n {
                        der(x[i]) = u[i];
                        der(y[i]) = v[i];
                        der(u[i]) = sum(k in 1..n, m[(i + k) % n] * (x[(i + k) % n] - x[i])
                            / distance(i, (i + k) % n)^3);
                        der(v[i]) = sum(k in 1..n, m[(i + k) % n] * (y[(i + k) % n] - y[i])
                            / distance(i, (i + k) % n)^3);
                    }
                    conserved energy = sum(i in 0..n, m[i] * (u[i]^2 + v[i]^2) / 2)
                        - sum(i in 0..n, sum(j in 0..i, m[i] * m[j] / distance(i, j)));
                    conserved momentum_x = sum(i in 0..n, m[i] * u[i]);
                    conserved momentum_y = sum(i in 0..n, m[i] * v[i]);
                    conserved angular_momentum = sum(i in 0..n, m[i] * (x[i] * v[i] - y[i] * u[i]));
                }
            }
        }
    };
}

planets!(planets_5 5 [1, 1e-3, 1e-3, 1e-3, 1e-3]);
planets!(planets_8 8 [1, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3]);

pws! {
    /// The sun with the inner planets, and the five outer ones; times in hundreds of days.
    system OuterPlanets {
        const n = 6;
        /// Positions, in astronomical units.
        state x[n], y[n], z[n];
        /// Velocities.
        state u[n], v[n], w[n];
        /// The constant of gravitation.
        param G = 2.95912208286;
        /// Masses relative to the sun.
        param m[n] = [
            1.00000597682, 0.000954786104043, 0.000285583733151,
            0.0000437273164546, 0.0000517759138449, 7.692307692307693e-9
        ];
        fn distance(i, j) = sqrt((x[i] - x[j])^2 + (y[i] - y[j])^2 + (z[i] - z[j])^2);
        for i in 0..n {
            der(x[i]) = u[i];
            der(y[i]) = v[i];
            der(z[i]) = w[i];
            der(u[i]) = sum(k in 1..n, G * m[(i + k) % n] * (x[(i + k) % n] - x[i])
                / distance(i, (i + k) % n)^3);
            der(v[i]) = sum(k in 1..n, G * m[(i + k) % n] * (y[(i + k) % n] - y[i])
                / distance(i, (i + k) % n)^3);
            der(w[i]) = sum(k in 1..n, G * m[(i + k) % n] * (z[(i + k) % n] - z[i])
                / distance(i, (i + k) % n)^3);
        }
        conserved energy = sum(i in 0..n, m[i] * (u[i]^2 + v[i]^2 + w[i]^2) / 2)
            - sum(i in 0..n, sum(j in 0..i, G * m[i] * m[j] / distance(i, j)));
        conserved momentum_x = sum(i in 0..n, m[i] * u[i]);
        conserved momentum_y = sum(i in 0..n, m[i] * v[i]);
        conserved momentum_z = sum(i in 0..n, m[i] * w[i]);
    }
}

/// By component, the bodies as in the table; velocities per hundred days.
const OUTER_PLANETS: [f64; 36] = [
    0.0,
    -3.5023653,
    9.0755314,
    8.3101420,
    11.4707666,
    -15.5387357,
    0.0,
    -3.8169847,
    -3.0458353,
    -16.2901086,
    -25.7294829,
    -25.2225594,
    0.0,
    -1.5507963,
    -1.6483708,
    -7.2521278,
    -10.8169456,
    -3.1902382,
    0.0,
    0.565429,
    0.168318,
    0.354178,
    0.288930,
    0.276725,
    0.0,
    -0.412490,
    0.483525,
    0.137102,
    0.114527,
    -0.170702,
    0.0,
    -0.190589,
    0.192462,
    0.055029,
    0.039677,
    -0.136504,
];

/// At rest, the masses of a chain displaced as a parabola, a third higher at its end: no spring has its
/// length at rest, where a power has no series that every integrator can compute.
const fn slanted_parabola<const STATES: usize>() -> [f64; STATES] {
    let mut x = parabola(1.0);
    let mut i = 0;
    while i < STATES / 2 {
        x[i] *= 1.0 + (i + 1) as f64 / (3 * (STATES / 2 + 1)) as f64;
        i += 1;
    }
    x
}

/// Planets on circles around the star, of radii s² with s = 1, 1.25, 1.5, … and velocities 1/s, a quarter
/// of a turn apart.
const fn circles<const BODIES: usize, const STATES: usize>() -> [f64; STATES] {
    let mut state = [0.0; STATES];
    let mut i = 1;
    while i < BODIES {
        let s = 0.75 + 0.25 * i as f64;
        let sign = if i % 4 < 2 { 1.0 } else { -1.0 };
        let (radius, speed) = (sign * s * s, sign / s);
        if i.is_multiple_of(2) {
            state[BODIES + i] = radius;
            state[2 * BODIES + i] = -speed;
        } else {
            state[i] = radius;
            state[3 * BODIES + i] = speed;
        }
        i += 1;
    }
    state
}
