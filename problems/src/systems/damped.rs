//! Oscillator with unequal damping on the way out and on the way back.
//!
//! ẋ = v, v̇ = −(γ/m) v − (k/m) x with γ = 0.1 where v > 0 and γ = 0.02 where v < 0; g = v;
//! the conserved quantity depends on time: ψ = (m v² + γ x v + k x²)/2 · exp(γ t/m).
//!
//! Source: A. T. S. Wan, A. Bihlo, J.-C. Nave, *Conservative methods for dynamical systems*,
//! SIAM J. Numer. Anal. 55 (2017), for the smooth system.

use crate::problem::Description;

pws! {
    /// Oscillator with unequal damping on the way out and on the way back.
    pub system Damped {
        state x, v;
        param gamma_forward = 0.1, gamma_backward = 0.02, m = 1, k = 1;
        interface turn = v;
        region forward where turn > 0 {
            der(x) = v;
            der(v) = -(gamma_forward / m) * v - (k / m) * x;
            conserved scaled_energy =
                (m * v^2 + gamma_forward * x * v + k * x^2) / 2 * exp(gamma_forward * t / m);
        }
        region backward where turn < 0 {
            der(x) = v;
            der(v) = -(gamma_backward / m) * v - (k / m) * x;
            conserved scaled_energy =
                (m * v^2 + gamma_backward * x * v + k * x^2) / 2 * exp(gamma_backward * t / m);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "damped",
    title: "oscillator with unequal damping out and back",
    source: "Wan, Bihlo & Nave, Conservative methods for dynamical systems; piecewise variant",
    initial: &[1.0, 0.5],
    t_end: 50.0,
    step_size: 1e-3,
    longest: None,
    reference: Some(include_str!("../../reference/damped.json")),
};
