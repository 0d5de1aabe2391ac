//! Transitions: where an integration starts, whether an interface is reached in a step, and
//! the point where it is crossed.

mod dip;
mod guards;
mod locate;
mod meeting;
mod reading;
mod start;
pub(crate) mod watch;

pub(crate) use dip::Dip;
pub(crate) use guards::{check_guards, guard, guard_error};
pub use locate::{Crossing, Located, Locator, NewtonLocator};
pub(crate) use meeting::{Meeting, neighbour};
pub(crate) use start::{Start, check_region, find_region};

use crate::system::{Boundary, Flow, Vector};

/// dg/dt = ∂ₜg + ∇g·f
pub(crate) fn rate<const N: usize, const M: usize, F: Flow<f64, N, M>>(
    flow: &F,
    interface: usize,
    t: f64,
    x: &Vector<f64, N>,
) -> f64 {
    let (time_derivative, gradient) = flow.boundary().switching_gradient(interface, t, x);
    time_derivative + gradient.dot(&flow.vector_field(t, x))
}
