//! Planet whose attraction grows inside the unit circle.
//!
//! r̈ = −μ r/|r|³ in the plane, μ = 1.2 inside and μ = 1 outside g = x² + y² − 1 = 0, with the
//! energy E = (u² + v²)/2 − μ/r, the angular momentum L = x v − y u and a component of the
//! Laplace–Runge–Lenz vector A = (v L − μ x/r, −u L − μ y/r). The orbit precesses; its radius
//! has period 8.076434661….
//!
//! Because of |A|² = μ² + 2 E L² the quantities E, L, Aₓ are dependent where A_y = 0, and
//! E, L, A_y where Aₓ = 0. The orbit starts at its apex on the x-axis, where A_y = 0, and
//! stays there for its first segment: so −A_y is the component to declare. With Aₓ the scheme
//! would leave it out there, and conserve it to second order only.
//!
//! Source: E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, I.2; the
//! refraction at a circle is a piecewise-smooth variant.

use crate::problem::Description;

pws! {
    /// Planet whose attraction grows inside the unit circle.
    pub system KeplerRefraction {
        /// Position.
        state x, y;
        /// Velocity.
        state u, v;
        param mu_inside = 1.2, mu_outside = 1;
        let r = sqrt(x^2 + y^2);
        interface circle = x^2 + y^2 - 1;
        region inside where circle < 0 {
            der(x) = u;
            der(y) = v;
            der(u) = -mu_inside * x / r^3;
            der(v) = -mu_inside * y / r^3;
            conserved energy = (u^2 + v^2) / 2 - mu_inside / r;
            conserved angular_momentum = x * v - y * u;
            conserved laplace = u * (x * v - y * u) + mu_inside * y / r;
        }
        region outside where circle > 0 {
            der(x) = u;
            der(y) = v;
            der(u) = -mu_outside * x / r^3;
            der(v) = -mu_outside * y / r^3;
            conserved energy = (u^2 + v^2) / 2 - mu_outside / r;
            conserved angular_momentum = x * v - y * u;
            conserved laplace = u * (x * v - y * u) + mu_outside * y / r;
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "kepler_refraction",
    title: "Kepler orbit refracted at the unit circle",
    source: "Hairer, Lubich & Wanner, Geometric Numerical Integration, I.2; piecewise variant",
    initial: &[1.2, 0.0, 0.0, 0.85],
    t_end: 50.0,
    step_size: 1e-3,
    longest: None,
    reference: Some(include_str!("../../reference/kepler_refraction.json")),
};
