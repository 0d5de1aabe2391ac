//! Harmonic oscillator at relativistic speed.
//!
//! q̇ = p/√(1 + p²/c²), ṗ = −k q, in units of the rest mass; ψ = c² √(1 + p²/c²) + k q²/2.
//! At large amplitude the particle runs at nearly the speed of light between sharp turns.
//!
//! Source: the energy and momentum of L. D. Landau, E. M. Lifshitz, *The Classical Theory of
//! Fields*, §9, with a harmonic potential.

use crate::problem::Description;

pws! {
    /// Harmonic oscillator at relativistic speed.
    pub system RelativisticOscillator {
        state q, p;
        param c = 1, k = 1;
        let gamma = sqrt(1 + p^2 / c^2);
        der(q) = p / gamma;
        der(p) = -k * q;
        conserved energy = c^2 * gamma + k * q^2 / 2;
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "relativistic_oscillator",
    title: "harmonic oscillator at relativistic speed",
    source: "Landau & Lifshitz, The Classical Theory of Fields, 9",
    initial: &[0.0, 3.0],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
