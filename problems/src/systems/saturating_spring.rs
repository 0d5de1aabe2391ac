//! Oscillator whose spring saturates.
//!
//! q̇ = p, ṗ = −k atan q: linear for small q, of constant force for large q;
//! ψ = p²/2 + k (q atan q − ln(1 + q²)/2).
//!
//! Source: the conservative oscillators of A. H. Nayfeh, D. T. Mook, *Nonlinear Oscillations*,
//! chapter 2, with the arctangent as the saturating force.

use crate::problem::Description;

pws! {
    /// Oscillator whose spring saturates.
    pub system SaturatingSpring {
        state q, p;
        param k = 1;
        der(q) = p;
        der(p) = -k * atan(q);
        conserved energy = p^2 / 2 + k * (q * atan(q) - ln(1 + q^2) / 2);
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "saturating_spring",
    title: "oscillator whose spring saturates",
    source: "Nayfeh & Mook, Nonlinear Oscillations, chapter 2",
    initial: &[2.0, 0.5],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
