//! Fermi–Pasta–Ulam–Tsingou chain of eight masses whose first mass meets a stop.
//!
//! H = Σ p²/2 + Σ V(rᵢ), V(r) = r²/2 + β r⁴/4 (the β-chain), between fixed ends. Where the first
//! mass is displaced by more than d it touches a spring of stiffness κ, which adds
//! κ (q₀ − d)²/2: force and energy are continuous. The energy is conserved on both sides.
//!
//! Source: E. Fermi, J. Pasta, S. Ulam (and M. Tsingou), *Studies of nonlinear problems I*, Los
//! Alamos report LA-1940 (1955); the stop: S. W. Shaw, P. J. Holmes, *A periodically forced
//! piecewise linear oscillator*, J. Sound Vib. 90 (1983).

use crate::problem::Description;

pws! {
    /// Fermi–Pasta–Ulam–Tsingou chain of eight masses whose first mass meets a stop.
    pub system FputChain {
        const n = 8;
        /// Displacements.
        state q[n];
        /// Momenta.
        state p[n];
        /// Strength of the cubic force.
        param beta = 1;
        /// Stiffness of the stop, and the displacement at which it is met.
        param kappa = 2, d = 0.3;
        fn V(r) = r^2 / 2 + beta * r^4 / 4;
        let chain = sum(i in 0..n, p[i]^2 / 2)
            + V(q[0]) + sum(i in 1..n, V(q[i] - q[i - 1])) + V(q[n - 1]);
        interface stop = q[0] - d;
        region free where stop < 0 {
            hamiltonian energy = chain in (q, p);
        }
        region stopped where stop > 0 {
            hamiltonian energy = chain + kappa * (q[0] - d)^2 / 2 in (q, p);
        }
    }
}

/// At rest, the masses of a chain displaced as a parabola of `height`.
pub const fn parabola<const STATES: usize>(height: f64) -> [f64; STATES] {
    let n = STATES / 2;
    let mut x = [0.0; STATES];
    let mut i = 0;
    while i < n {
        let (numerator, denominator) = (4 * (i + 1) * (n - i), (n + 1) * (n + 1));
        x[i] = height * numerator as f64 / denominator as f64;
        i += 1;
    }
    x
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "fput_chain",
    title: "Fermi-Pasta-Ulam-Tsingou chain of 8 masses with a stop",
    source: "Fermi, Pasta, Ulam & Tsingou, LA-1940 (1955); Shaw & Holmes, J. Sound Vib. 90 (1983)",
    initial: &parabola::<16>(1.5),
    t_end: 200.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
