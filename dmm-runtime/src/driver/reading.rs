//! A switching function read at a point.

use crate::arithmetic::noise;
use crate::contract::{Dynamics, DynamicsVisitor, Guards, System, Vector};

/// The value of g, the size of its terms and dg/dt under the field of a region.
pub(super) struct Reading {
    pub(super) value: f64,
    size: f64,
    pub(super) rate: f64,
}

impl Reading {
    /// Of `interface` at (t, x), under the field of `region`.
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
        self.value.abs() <= noise(self.size)
    }
}

/// Reads one interface.
struct Read<'a, const N: usize> {
    interface: usize,
    t: f64,
    x: &'a Vector<f64, N>,
}

impl<const N: usize> DynamicsVisitor<N> for Read<'_, N> {
    type Output = Reading;

    fn visit<const M: usize, F: Dynamics<f64, N, M>>(self, dynamics: &F) -> Reading {
        let guards = dynamics.guards();
        Reading {
            value: guards.switching_function(self.interface, self.t, self.x),
            size: guards.switching_size(self.interface, self.t, self.x),
            rate: dynamics.rate(self.interface, self.t, self.x),
        }
    }
}
