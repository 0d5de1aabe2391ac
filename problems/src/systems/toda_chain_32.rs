//! Toda ring of thirty-two masses with a crack: [`toda_chain`](super::toda_chain) with more
//! masses.
//!
//! The masses on either side of the crack start displaced towards their neighbours, so that two
//! trains of solitons leave it and run around the ring. 64 states, energy and momentum.
//!
//! Source: as for [`toda_chain`](super::toda_chain).

use crate::problem::Description;

pws! {
    /// Toda ring of thirty-two masses with a crack.
    pub system TodaChain32 {
        const n = 32;
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

/// A quarter of the ring displaced by 1 on either side of the crack, a slope between them, and
/// one mass in motion.
const fn initial() -> [f64; 64] {
    let mut x = [0.0; 64];
    let mut i = 0;
    while i < 32 {
        x[i] = (15.5 - i as f64) / 8.0;
        x[i] = x[i].clamp(-1.0, 1.0);
        i += 1;
    }
    x[32 + 8] = 0.5;
    x
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "toda_chain_32",
    title: "Toda ring of 32 masses with a crack",
    source: "Toda, J. Phys. Soc. Japan 22 (1967); Kuznetsova, Pasternak & Dyskin, Nonlin. \
             Processes Geophys. 24 (2017)",
    initial: &initial(),
    t_end: 100.0,
    step_size: 2e-2,
    longest: None,
    reference: None,
};
