//! A star in the field of an axisymmetric galaxy.
//!
//! H = (u² + v²)/2 + (x² + y²)/2 + x² y − y³/3, that is ẍ = −x − 2 x y, ÿ = −y − x² + y². At
//! energy 1/8 order and chaos share the phase space.
//!
//! Source: M. Hénon, C. Heiles, *The applicability of the third integral of motion*, Astron. J.
//! 69 (1964).

use crate::problem::Description;

pws! {
    /// A star in the field of an axisymmetric galaxy.
    pub system HenonHeiles {
        /// Position.
        state x, y;
        /// Velocity.
        state u, v;
        hamiltonian energy = (u^2 + v^2) / 2 + (x^2 + y^2) / 2 + x^2 * y - y^3 / 3
            in (x, u), (y, v);
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "henon_heiles",
    title: "a star in the field of an axisymmetric galaxy",
    source: "Henon & Heiles, Astron. J. 69 (1964)",
    initial: &[0.0, 0.1, 0.49, 0.0],
    t_end: 100.0,
    step_size: 1e-2,
    longest: None,
    reference: None,
};
