//! Pendulum that swings against a stronger restoring torque on the left.
//!
//! q̇ = p, ṗ = −k sin q with k = 1 where q > 0 and k = 4 where q < 0; g = q;
//! ψ = p²/2 − k cos q. Half swings of two pendulums, each a complete elliptic integral;
//! period 5.043770713….
//!
//! Source: the pendulum is the standard example of E. Hairer, C. Lubich, G. Wanner, *Geometric
//! Numerical Integration*, I.1.2; the change of k at the lowest point is a piecewise-smooth
//! variant in the manner of Hirani, Wan & Wojtalewicz, §4.1.

use crate::problem::Description;

pws! {
    /// Pendulum that swings against a stronger restoring torque on the left.
    pub system Pendulum {
        state q, p;
        param k_left = 4, k_right = 1;
        interface vertical = q;
        region left where vertical < 0 {
            der(q) = p;
            der(p) = -k_left * sin(q);
            conserved energy = p^2 / 2 - k_left * cos(q);
        }
        region right where vertical > 0 {
            der(q) = p;
            der(p) = -k_right * sin(q);
            conserved energy = p^2 / 2 - k_right * cos(q);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "pendulum",
    title: "pendulum with a stronger torque on the left",
    source: "Hairer, Lubich & Wanner, Geometric Numerical Integration, I.1.2; piecewise variant",
    initial: &[0.5, 1.0],
    t_end: 100.0,
    step_size: 1e-3,
    longest: None,
    reference: Some(include_str!("../../reference/pendulum.json")),
};
