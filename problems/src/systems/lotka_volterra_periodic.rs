//! Predator and prey, with both rates of the prey changing where the prey passes x = 1.
//!
//! ẋ = x(a − b y), ẏ = y(d x − c); g = x − 1; ψ = d x − c ln x + b y − a ln y, with
//! a = b = 2/3 where prey is scarce and a = b = 1 where it abounds. Equal a/b on both sides
//! closes the orbit after one revolution; period 7.320839159….
//!
//! Source: A. T. S. Wan, A. Bihlo, J.-C. Nave, *Conservative methods for dynamical systems*,
//! SIAM J. Numer. Anal. 55 (2017), for the smooth system.

use crate::problem::Description;

pws! {
    /// Predator and prey, with both rates of the prey changing where the prey passes x = 1.
    pub system LotkaVolterra {
        /// Prey.
        state x;
        /// Predators.
        state y;
        param a_scarce = 2/3, b_scarce = 2/3, a_plenty = 1, b_plenty = 1, c = 1, d = 1;
        interface prey = x - 1;
        region scarce where prey < 0 {
            der(x) = x * (a_scarce - b_scarce * y);
            der(y) = y * (d * x - c);
            conserved volterra = d * x - c * ln(x) + b_scarce * y - a_scarce * ln(y);
        }
        region plenty where prey > 0 {
            der(x) = x * (a_plenty - b_plenty * y);
            der(y) = y * (d * x - c);
            conserved volterra = d * x - c * ln(x) + b_plenty * y - a_plenty * ln(y);
        }
    }
}

/// The initial value problem.
pub const DESCRIPTION: Description = Description {
    name: "lotka_volterra_periodic",
    title: "predator and prey with rates that change at x = 1",
    source: "Wan, Bihlo & Nave, Conservative methods for dynamical systems; piecewise variant",
    initial: &[0.5, 0.8],
    t_end: 100.0,
    step_size: 1e-3,
    longest: None,
    reference: Some(include_str!("../../reference/lotka_volterra_periodic.json")),
};
