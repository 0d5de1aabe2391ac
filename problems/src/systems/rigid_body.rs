//! Free rigid body whose moments of inertia change where it tumbles through y = 0.
//!
//! Euler's equations for the angular momentum (x, y, z):
//! ẋ = (1/I₃ − 1/I₂) y z, ẏ = (1/I₁ − 1/I₃) z x, ż = (1/I₂ − 1/I₁) x y; g = y;
//! ψ = (x² + y² + z², x²/I₁ + y²/I₂ + z²/I₃), with I = (1, 2, 3) where y > 0 and
//! I = (3/2, 5/2, 7/2) where y < 0. Period 29.9005971….
//!
//! Source: E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, IV.1 and VII.5;
//! piecewise-smooth variant.

use crate::problem::Description;

pws! {
    /// Free rigid body whose moments of inertia change where it tumbles through y = 0.
    pub system RigidBody {
        /// Components of the angular momentum.
        state x, y, z;
        /// Moments of inertia.
        param i1_above = 1, i2_above = 2, i3_above = 3;
        param i1_below = 1.5, i2_below = 2.5, i3_below = 3.5;
        interface plane = y;
        region above where plane > 0 {
            der(x) = (1 / i3_above - 1 / i2_above) * y * z;
            der(y) = (1 / i1_above - 1 / i3_above) * z * x;
            der(z) = (1 / i2_above - 1 / i1_above) * x * y;
            conserved momentum = x^2 + y^2 + z^2;
            conserved energy = x^2 / i1_above + y^2 / i2_above + z^2 / i3_above;
        }
        region below where plane < 0 {
            der(x) = (1 / i3_below - 1 / i2_below) * y * z;
            der(y) = (1 / i1_below - 1 / i3_below) * z * x;
            der(z) = (1 / i2_below - 1 / i1_below) * x * y;
            conserved momentum = x^2 + y^2 + z^2;
            conserved energy = x^2 / i1_below + y^2 / i2_below + z^2 / i3_below;
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "rigid_body",
    title: "free rigid body whose inertia changes at y = 0",
    source: "Hairer, Lubich & Wanner, Geometric Numerical Integration, IV.1; piecewise variant",
    initial: &[0.6, 0.5, 0.7],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: Some(include_str!("../../reference/rigid_body.json")),
};
