//! Circuit of a capacitor and an inductor whose core saturates.
//!
//! Charge q and flux φ: q̇ = i(φ), φ̇ = −q/C. The current is i = φ/L while |φ| is below the knee
//! φₖ; beyond it the inductance falls to Lₛ, i = φ/Lₛ + (1/L − 1/Lₛ) φₖ sign φ, continuous at
//! the knee. Both knees are the one interface g = φ² − φₖ² = 0. The energy q²/2C + ∫i dφ is
//! conserved on both sides, and continuous; its |φ| is written √φ², which is smooth where the
//! core is saturated.
//!
//! Source: L. O. Chua, C. A. Desoer, E. S. Kuh, *Linear and Nonlinear Circuits* (1987), for
//! circuits with piecewise-linear elements.

use crate::problem::Description;

pws! {
    /// Circuit of a capacitor and an inductor whose core saturates.
    pub system SaturatingInductor {
        /// Charge of the capacitor.
        state q;
        /// Flux of the inductor.
        state phi;
        param capacitance = 1, inductance = 1, saturated = 1/5, knee = 1;
        let electric = q^2 / (2 * capacitance);
        let excess = 1 / inductance - 1 / saturated;
        interface core = phi^2 - knee^2;
        region linear where core < 0 {
            hamiltonian energy = electric + phi^2 / (2 * inductance) in (q, phi);
        }
        region beyond where core > 0 {
            hamiltonian energy = electric + phi^2 / (2 * saturated)
                + excess * knee * (sqrt(phi^2) - knee / 2) in (q, phi);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "saturating_inductor",
    title: "circuit with an inductor that saturates",
    source: "Chua, Desoer & Kuh, Linear and Nonlinear Circuits (1987)",
    initial: &[2.0, 0.5],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
