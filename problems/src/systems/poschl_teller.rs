//! Particle in the Pöschl–Teller well.
//!
//! q̇ = p, ṗ = −2 λ tanh q / cosh² q; ψ = p²/2 + λ tanh² q (the well −λ/cosh² q, raised by λ).
//! In the well, ψ < λ, sinh q oscillates harmonically with frequency √(2(λ − ψ)).
//!
//! Source: G. Pöschl, E. Teller, *Bemerkungen zur Quantenmechanik des anharmonischen
//! Oszillators*, Z. Phys. 83 (1933); S. Flügge, *Practical Quantum Mechanics*, problem 39.

use crate::problem::Description;

pws! {
    /// Particle in the Pöschl–Teller well.
    pub system PoschlTeller {
        state q, p;
        param lambda = 1;
        der(q) = p;
        der(p) = -2 * lambda * tanh(q) / cosh(q)^2;
        conserved energy = p^2 / 2 + lambda * tanh(q)^2;
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "poschl_teller",
    title: "particle in the Poschl-Teller well",
    source: "Poschl & Teller, Z. Phys. 83 (1933)",
    initial: &[0.5, 0.8],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
