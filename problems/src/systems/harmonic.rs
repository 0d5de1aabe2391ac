//! Oscillator whose spring stiffens below y = 0.
//!
//! ẋ = y, ẏ = −k x with k = 1 where y > 0 and k = 3 where y < 0; g = y;
//! ψ = (y² + k x²)/2. The orbit is closed: two half ellipses through (±√2, 0), period
//! π(1 + 1/√3).
//!
//! Source: A. N. Hirani, A. T. S. Wan, N. Wojtalewicz, *Conservative integrators for piecewise
//! smooth systems with transversal dynamics*, §4.1 (its ω² is our k).

use crate::problem::Description;

pws! {
    /// Oscillator whose spring stiffens below y = 0.
    pub system Harmonic {
        state x, y;
        param k_above = 1, k_below = 3;
        interface spring = y;
        region above where spring > 0 {
            der(x) = y;
            der(y) = -k_above * x;
            conserved energy = (y^2 + k_above * x^2) / 2;
        }
        region below where spring < 0 {
            der(x) = y;
            der(y) = -k_below * x;
            conserved energy = (y^2 + k_below * x^2) / 2;
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "harmonic",
    title: "oscillator whose spring stiffens below y = 0",
    source: "Hirani, Wan & Wojtalewicz, Conservative integrators for piecewise smooth systems, 4.1",
    initial: &[1.0, 1.0],
    t_end: 100.0,
    step_size: 1e-3,
    longest: None,
    reference: Some(include_str!("../../reference/harmonic.json")),
};
