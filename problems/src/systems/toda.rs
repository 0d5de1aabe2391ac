//! Toda lattice of three particles on a ring.
//!
//! H = Σ p²/2 + Σ exp(qᵢ − qᵢ₊₁), that is ṗᵢ = exp(qᵢ₋₁ − qᵢ) − exp(qᵢ − qᵢ₊₁). The lattice is
//! integrable: the energy, the total momentum and the determinant of its Lax matrix are
//! conserved.
//!
//! Source: M. Toda, *Vibration of a chain with nonlinear interaction*, J. Phys. Soc. Japan 22
//! (1967); H. Flaschka, *The Toda lattice II*, Phys. Rev. B 9 (1974); Hairer, Lubich & Wanner,
//! *Geometric Numerical Integration*, X.1.5.

use crate::problem::Description;

pws! {
    /// Toda lattice of three particles on a ring.
    pub system Toda {
        /// Displacements.
        state q[3];
        /// Momenta.
        state p[3];
        /// Toda's exponential of the bond from mass i to the next.
        fn bond(i) = exp(q[i] - q[(i + 1) % 3]);
        hamiltonian energy = sum(i in 0..3, p[i]^2 / 2 + bond(i)) in (q, p);
        conserved momentum = sum(i in 0..3, p[i]);
        conserved determinant = p[0] * p[1] * p[2]
            - sum(i in 0..3, p[i] * bond((i + 1) % 3));
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "toda",
    title: "Toda lattice of three particles on a ring",
    source: "Toda, J. Phys. Soc. Japan 22 (1967); Flaschka, Phys. Rev. B 9 (1974)",
    initial: &[0.0, 0.0, 0.0, -1.5, 1.0, 0.5],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
