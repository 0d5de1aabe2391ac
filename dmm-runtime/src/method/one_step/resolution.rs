//! Whether uniform steps resolve the solution, so that guards need not be looked at in each.

use super::watch::{RESOLVED, UNRESOLVED};
use crate::contract::{Dynamics, Guards, Vector};

/// Whether steps resolve the solution.
pub(super) struct Resolution<const N: usize> {
    /// The largest |f| of each component so far.
    sizes: Vector<f64, N>,
}

impl<const N: usize> Default for Resolution<N> {
    fn default() -> Self {
        Self {
            sizes: Vector::zeros(),
        }
    }
}

impl<const N: usize> Resolution<N> {
    /// The reach of the watches over steps τ from here: f changes by less than half of its size in
    /// one, twelve steps a turn. A parabola for g is exact enough if g is affine.
    #[inline(always)]
    pub(super) fn reach<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        (t, x): (f64, &Vector<f64, N>),
        tau: f64,
    ) -> f64 {
        const HALF: f64 = 0.5;
        if dynamics.guards().is_affine() {
            return RESOLVED;
        }
        if !dynamics.guards().follows_state() {
            return UNRESOLVED;
        }
        let field = dynamics.vector_field(t, x);
        let later = dynamics.vector_field(t + tau, &(x + field * tau));
        self.sizes = self.sizes.sup(&field.abs());
        let mut resolved = true;
        for i in 0..N {
            resolved &= (later[i] - field[i]).abs() <= HALF * self.sizes[i];
        }
        if resolved { RESOLVED } else { UNRESOLVED }
    }
}
