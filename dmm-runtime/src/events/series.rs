//! An affine switching function g along the power series of a solution, which it follows: the first
//! root of its own series in a step.

use crate::arithmetic::noise;
use crate::expansion::polynomial::{Roots, dips, first_root, root};

/// The coefficients of g, positive in the mode.
pub(crate) struct Series<const P: usize> {
    coefficients: [f64; P],
    /// 1 where the step starts on the guard: zero is a root there, which is divided off.
    start: usize,
    /// What g is measured by: its size, divided by the step where the root is.
    size: f64,
}

/// A root of g in a step.
pub(crate) struct Root {
    pub(crate) place: f64,
    /// g is positive at the first of these, negative at the second, with this one root in between.
    pub(crate) bracket: (f64, f64),
}

impl<const P: usize> Series<P> {
    /// Those of a step over `tau` that `is_active` on the guard, or starts within the rounding
    /// errors of g, of which `size` is the measure; nothing if a coefficient is not finite.
    pub(crate) fn new(
        coefficients: [f64; P],
        size: f64,
        is_active: bool,
        tau: f64,
    ) -> Option<Self> {
        if !coefficients.iter().all(|c| c.is_finite()) {
            return None;
        }
        let leaves = coefficients[0] <= noise(size) && coefficients[1] > 0.0;
        let divides = is_active || leaves;
        Some(Self {
            coefficients,
            start: usize::from(divides),
            size: if divides { size / tau } else { size },
        })
    }

    fn rest(&self) -> &[f64] {
        &self.coefficients[self.start..]
    }

    fn noise(&self) -> f64 {
        noise(self.size)
    }

    /// Whether g comes nearer to zero than `part` of its size before `horizon` and returns.
    pub(crate) fn dips(&self, horizon: f64, part: f64) -> bool {
        let band = part * self.size;
        band > self.noise() && dips(self.rest(), horizon, band)
    }

    /// The first root before `horizon`, and how often zero was touched before.
    pub(crate) fn first_root(&self, horizon: f64) -> (Option<Root>, u32) {
        if self.coefficients.iter().all(|&c| c == 0.0) {
            // it rests on the guard
            return (None, 0);
        }
        let Roots { first, touches } = first_root(self.rest(), horizon, self.noise());
        let found = first.map(|(lower, upper)| Root {
            place: root(self.rest(), lower, upper),
            bracket: (lower, upper),
        });
        (found, touches)
    }
}
