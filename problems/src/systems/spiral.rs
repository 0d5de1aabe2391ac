//! Spiral that reverses its sense of rotation where it leaves the unit disc.
//!
//! ẋ = A x with A = [[1, ω], [−ω, 1]] inside and its transpose outside the circle
//! g = x₁² + x₂² − 1 = 0, ω = 2π; ψ = (x₁² + x₂²) exp(−2t). From (1/e, 0) the circle is met
//! at t = 1, in (1, 0).
//!
//! Source: the discontinuous spiral of A. Nurkanović, M. Sperl, S. Albrecht, M. Diehl,
//! *Finite elements with switch detection for direct optimal control of nonsmooth systems*, eq. (47).

use crate::problem::Description;

pws! {
    /// Spiral that reverses its sense of rotation where it leaves the unit disc.
    pub system Spiral {
        state x1, x2;
        param omega = 2 * pi;
        interface circle = x1^2 + x2^2 - 1;
        region inside where circle < 0 {
            der(x1) = x1 + omega * x2;
            der(x2) = -omega * x1 + x2;
            conserved growth = (x1^2 + x2^2) * exp(-2 * t);
        }
        region outside where circle > 0 {
            der(x1) = x1 - omega * x2;
            der(x2) = omega * x1 + x2;
            conserved growth = (x1^2 + x2^2) * exp(-2 * t);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "spiral",
    title: "spiral that reverses its rotation at the unit circle",
    source: "Nurkanovic, Sperl, Albrecht & Diehl, Finite elements with switch detection",
    initial: &[0.367_879_441_171_442_33, 0.0],
    t_end: std::f64::consts::FRAC_PI_2,
    step_size: 1e-3,
    longest: Some(350.0),
    reference: Some(include_str!("../../reference/spiral.json")),
};
