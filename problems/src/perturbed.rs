//! A locator that is wrong on purpose: t̂* is made too late by c·τᵖ.
//!
//! Hirani, Wan & Wojtalewicz (Figs 4 and 7) show with it what their Theorem 3.1 says: the
//! order of the scheme survives the transition for p ≥ 2 and falls to 1 for p = 1.

use dmm_runtime::{Crossing, Dynamics, Located, Locator, NewtonLocator, OneStep, Statistics};

/// [`NewtonLocator`], then `amplitude`·τ^`power` later along the one-step map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Perturbed {
    /// c
    pub amplitude: f64,
    /// p
    pub power: i32,
}

impl Perturbed {
    /// [`NewtonLocator`] itself.
    pub(crate) const NOT: Self = Self {
        amplitude: 0.0,
        power: 1,
    };
}

impl Locator for Perturbed {
    fn locate<Map: OneStep, const N: usize, const M: usize, F: Dynamics<f64, N, M>>(
        &self,
        crossing: &Crossing<'_, Map, F, N>,
        statistics: &mut Statistics,
    ) -> Option<Located<N>> {
        let exact = NewtonLocator.locate(crossing, statistics)?;
        let elapsed = exact.elapsed + self.amplitude * crossing.step_size.powi(self.power);
        if elapsed == exact.elapsed {
            return Some(exact);
        }
        let increment = crossing.increment::<M>(elapsed, statistics).ok()?;
        Some(Located { elapsed, increment })
    }
}
