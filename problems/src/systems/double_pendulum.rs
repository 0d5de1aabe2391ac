//! Double pendulum.
//!
//! Two masses on rods, the second hanging from the first, with angles θ from the vertical and
//! their momenta p; with Δ = θ₀ − θ₁
//!
//! H = (m₁l₁²p₀² + (m₀ + m₁)l₀²p₁² − 2m₁l₀l₁p₀p₁ cos Δ)/(2m₁l₀²l₁²(m₀ + m₁ sin²Δ))
//!   − (m₀ + m₁)g l₀ cos θ₀ − m₁g l₁ cos θ₁.
//!
//! The energy is the only invariant; large swings are chaotic.
//!
//! Source: L. D. Landau, E. M. Lifshitz, *Mechanics*, §5, problem 1; H. J. Korsch, H.-J. Jodl,
//! T. Hartmann, *Chaos*, chapter 5.

use crate::problem::Description;

pws! {
    /// Double pendulum.
    pub system DoublePendulum {
        /// Angles from the vertical.
        state theta[2];
        /// Their momenta.
        state p[2];
        /// Masses and lengths.
        param m[2] = 1, l[2] = 1;
        /// Acceleration of gravity.
        param g = 1;
        let delta = theta[0] - theta[1];
        let kinetic = (m[1] * l[1]^2 * p[0]^2 + (m[0] + m[1]) * l[0]^2 * p[1]^2
            - 2 * m[1] * l[0] * l[1] * p[0] * p[1] * cos(delta))
            / (2 * m[1] * l[0]^2 * l[1]^2 * (m[0] + m[1] * sin(delta)^2));
        let potential = -(m[0] + m[1]) * g * l[0] * cos(theta[0])
            - m[1] * g * l[1] * cos(theta[1]);
        hamiltonian energy = kinetic + potential in (theta, p);
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "double_pendulum",
    title: "double pendulum",
    source: "Landau & Lifshitz, Mechanics, section 5; Korsch, Jodl & Hartmann, Chaos, chapter 5",
    initial: &[1.2, -0.4, 0.0, 0.0],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
