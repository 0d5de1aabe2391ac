//! Toda lattice of three particles on a ring.
//!
//! q̇ᵢ = pᵢ, ṗᵢ = exp(qᵢ₋₁ − qᵢ) − exp(qᵢ − qᵢ₊₁). The lattice is integrable: the energy, the
//! total momentum and the determinant of its Lax matrix are conserved.
//!
//! Source: M. Toda, *Vibration of a chain with nonlinear interaction*, J. Phys. Soc. Japan 22
//! (1967); H. Flaschka, *The Toda lattice II*, Phys. Rev. B 9 (1974); Hairer, Lubich & Wanner,
//! *Geometric Numerical Integration*, X.1.5.

use dmm_runtime::pws;

use crate::problem::Card;

pws! {
    /// Toda lattice of three particles on a ring.
    pub system Toda {
        /// Displacements.
        state q1, q2, q3;
        /// Momenta.
        state p1, p2, p3;
        let e12 = exp(q1 - q2);
        let e23 = exp(q2 - q3);
        let e31 = exp(q3 - q1);
        der(q1) = p1;
        der(q2) = p2;
        der(q3) = p3;
        der(p1) = e31 - e12;
        der(p2) = e12 - e23;
        der(p3) = e23 - e31;
        conserved energy = (p1^2 + p2^2 + p3^2) / 2 + e12 + e23 + e31;
        conserved momentum = p1 + p2 + p3;
        conserved determinant = p1 * p2 * p3 - p1 * e23 - p2 * e31 - p3 * e12;
    }
}

/// The initial value problem.
pub const CARD: Card = Card {
    name: "toda",
    title: "Toda lattice of three particles on a ring",
    source: "Toda, J. Phys. Soc. Japan 22 (1967); Flaschka, Phys. Rev. B 9 (1974)",
    initial: &[0.0, 0.0, 0.0, -1.5, 1.0, 0.5],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};

#[cfg(test)]
mod tests {
    #[test]
    fn follows_the_accurate_solution() {
        crate::systems::check::against_accurate("toda", 1.0 / 256.0);
    }
}
