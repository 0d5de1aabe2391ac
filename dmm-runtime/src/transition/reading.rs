//! A switching function read at a point.

use crate::scalar::Scalar;
use crate::system::{Boundary, Flow, FlowVisitor, System, Vector};
use crate::transition::rate;

/// g this many rounding errors of its terms away from zero is on the interface.
const NOISE: f64 = 8.0;

/// The value of g, the size of its terms and dg/dt under the flow of a region.
pub(super) struct Reading {
    pub(super) value: f64,
    size: f64,
    pub(super) rate: f64,
}

impl Reading {
    /// Of `interface` at (t, x), under the flow of `region`.
    pub(super) fn new<Sys: System<N>, const N: usize>(
        system: &Sys,
        region: Sys::Region,
        interface: usize,
        t: f64,
        x: &Vector<f64, N>,
    ) -> Self {
        system.visit(region, Read { interface, t, x })
    }

    pub(super) fn is_zero(&self) -> bool {
        self.value.abs() <= NOISE * f64::ROUNDING * self.size
    }
}

/// Reads one interface.
struct Read<'a, const N: usize> {
    interface: usize,
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> FlowVisitor<N> for Read<'_, N> {
    type Output = Reading;

    fn visit<const M: usize, F: Flow<f64, N, M>>(self, flow: &F) -> Reading {
        let boundary = flow.boundary();
        Reading {
            value: boundary.switching_function(self.interface, self.t, self.x),
            size: boundary.switching_size(self.interface, self.t, self.x),
            rate: rate(flow, self.interface, self.t, self.x),
        }
    }
}
