//! Toda ring of eight masses with a crack.
//!
//! H = Σ p²/2 + Σ V(rᵢ) with the extensions rᵢ = qᵢ − qᵢ₋₁ of the bonds between neighbours and
//! Toda's V(r) = e⁻ʳ + r − 1. The bond between the last mass and the first is cracked: under
//! compression its faces touch and it is κ times as stiff as under tension, V → κ V where
//! r < 0. Force and energy are continuous there (V(0) = V′(0) = 0). Energy and total momentum
//! are conserved on both sides; the other invariants of Toda's lattice are lost at the crack.
//!
//! Source: M. Toda, *Vibration of a chain with nonlinear interaction*, J. Phys. Soc. Japan 22
//! (1967); bonds with two moduli: M. S. Kuznetsova, E. Pasternak, A. V. Dyskin, *Analysis of
//! wave propagation in a discrete chain of bilinear oscillators*, Nonlin. Processes Geophys. 24
//! (2017).

use crate::problem::Description;

pws! {
    /// Toda ring of eight masses with a crack.
    pub system TodaChain {
        const n = 8;
        /// Displacements.
        state q[n];
        /// Momenta.
        state p[n];
        /// Stiffness of the closed crack relative to the other bonds.
        param kappa = 3;
        fn V(r) = exp(-r) + r - 1;
        let extension = q[0] - q[n - 1];
        let intact = sum(i in 0..n, p[i]^2 / 2) + sum(i in 1..n, V(q[i] - q[i - 1]));
        interface crack = extension;
        conserved momentum = sum(i in 0..n, p[i]);
        region open where crack > 0 {
            hamiltonian energy = intact + V(extension) in (q, p);
        }
        region closed where crack < 0 {
            hamiltonian energy = intact + kappa * V(extension) in (q, p);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "toda_chain",
    title: "Toda ring of 8 masses with a crack",
    source: "Toda, J. Phys. Soc. Japan 22 (1967); Kuznetsova, Pasternak & Dyskin, Nonlin. \
             Processes Geophys. 24 (2017)",
    initial: &[
        0.25, 0.5, 0.75, 0.25, -0.25, -0.5, -0.75, -0.25, // q
        0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, // p
    ],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
