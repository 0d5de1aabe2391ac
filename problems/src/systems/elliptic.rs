//! Motion along elliptic curves, with another curve inside the unit circle.
//!
//! ẋ = 2y, ẏ = 3x² + a with a = −3 inside and a = −2 outside the circle
//! g = x² + y² − 1 = 0; ψ = y² − x³ − a x. The orbit from (−1, −1) is closed with period
//! 1.893491513….
//!
//! Source: A. N. Hirani, A. T. S. Wan, N. Wojtalewicz, *Conservative integrators for piecewise
//! smooth systems with transversal dynamics*, §4.2; the smooth system: A. T. S. Wan,
//! J.-C. Nave, *On the arbitrarily long-term stability of conservative methods*, SIAM J. Numer.
//! Anal. 56 (2018).

use crate::problem::Description;

pws! {
    /// Motion along elliptic curves, with another curve inside the unit circle.
    pub system Elliptic {
        state x, y;
        param a_inside = -3, a_outside = -2;
        interface circle = x^2 + y^2 - 1;
        region inside where circle < 0 {
            der(x) = 2 * y;
            der(y) = 3 * x^2 + a_inside;
            conserved curve = y^2 - x^3 - a_inside * x;
        }
        region outside where circle > 0 {
            der(x) = 2 * y;
            der(y) = 3 * x^2 + a_outside;
            conserved curve = y^2 - x^3 - a_outside * x;
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "elliptic",
    title: "elliptic curves that change at the unit circle",
    source: "Hirani, Wan & Wojtalewicz, Conservative integrators for piecewise smooth systems, 4.2",
    initial: &[-1.0, -1.0],
    t_end: 100.0,
    step_size: 1e-3,
    longest: None,
    reference: Some(include_str!("../../reference/elliptic.json")),
};
