//! The Taylor coefficients of a solution and of the guards along it, polynomials made of them, and
//! the radius of convergence that they show.

pub(crate) mod jet;
pub(crate) mod polynomial;
pub(crate) mod radius;
