//! Fermi–Pasta–Ulam–Tsingou chain of thirty-two masses with a bond of broken-linear force.
//!
//! H = Σ p²/2 + Σ V(rᵢ), V(r) = r²/2 + α r³/3 with α = 1/4 (the α-chain of the report, with its
//! number of masses), between fixed ends. The report's third law of force is linear with a
//! slope that changes at a given extension: here one bond follows it on top of the others', and
//! is stiffer by κ beyond the extension d. Force and energy are continuous there; the energy is
//! conserved on both sides.
//!
//! Source: E. Fermi, J. Pasta, S. Ulam (and M. Tsingou), *Studies of nonlinear problems I*, Los
//! Alamos report LA-1940 (1955).

use super::fput_chain::parabola;
use crate::problem::Description;

pws! {
    /// Fermi–Pasta–Ulam–Tsingou chain of thirty-two masses with a bond of broken-linear force.
    pub system FputChain32 {
        const n = 32;
        /// Displacements.
        state q[n];
        /// Momenta.
        state p[n];
        /// Strength of the quadratic force.
        param alpha = 1/4;
        /// The bond's additional stiffness, and the extension beyond which it has it.
        param kappa = 1, d = 0.03;
        fn V(r) = r^2 / 2 + alpha * r^3 / 3;
        let chain = sum(i in 0..n, p[i]^2 / 2)
            + V(q[0]) + sum(i in 1..n, V(q[i] - q[i - 1])) + V(-q[n - 1]);
        let excess = q[8] - q[7] - d;
        interface limit = excess;
        region below where limit < 0 {
            hamiltonian energy = chain in (q, p);
        }
        region beyond where limit > 0 {
            hamiltonian energy = chain + kappa * excess^2 / 2 in (q, p);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "fput_chain_32",
    title: "Fermi-Pasta-Ulam-Tsingou chain of 32 masses with a broken-linear bond",
    source: "Fermi, Pasta, Ulam & Tsingou, LA-1940 (1955)",
    initial: &parabola::<64>(1.0),
    t_end: 300.0,
    step_size: 5e-2,
    longest: None,
    reference: None,
};
