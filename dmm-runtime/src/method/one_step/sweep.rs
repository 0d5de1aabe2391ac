//! Fixed-point sweeps d ← τ f^τ(t₀, x₀, t₁, x₀ + d) in place of Newton's method, where steps are
//! so short that a few of them are enough.
//!
//! A sweep takes the error of an increment from e to τ ∂f^τ/∂x₁ e, so that a correction s
//! leaves an error of about τ ∂f^τ/∂x₁ s. Every [`INTERVAL`] steps one is made by Newton's
//! method. Its matrix bounds τ ∂f^τ/∂x₁, its first correction tells how good predictions are,
//! and so whether a few sweeps bring them below rounding. In the steps in between the correction of
//! each sweep is tested; where the last one fails, Newton's method goes on.
//!
//! A sweep needs neither the Jacobian nor a linear solve: on two variables it takes half the
//! time of an iteration, on many a small part of it.

use crate::contract::{Matrix, Vector};

/// Steps between looks at the Jacobian.
const INTERVAL: u32 = 32;
/// Beyond so many sweeps Newton's method is faster.
pub(super) const MOST: u32 = 3;
/// The error that is left, relative to the increment: half a unit in its last place.
const ENOUGH: f64 = 5.551_115_123_125_783e-17; // 2⁻⁵⁴
/// Components of the increment that are smaller than this part of the state are measured
/// against it: of the roundings of [`INTERVAL`] steps the errors are still a small part.
const SHARE_OF_STATE: f64 = 1.562_5e-2; // 2⁻⁶

/// Whether sweeps take the place of Newton's method.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweeps<const N: usize> {
    /// Whether they do.
    pub(super) enough: bool,
    /// A last correction as small as this is small enough.
    tolerance: Vector<f64, N>,
    /// Steps until the next look at the Jacobian.
    left: u32,
}

impl<const N: usize> Sweeps<N> {
    /// Before anything is known: the next step looks.
    pub(super) fn new() -> Self {
        Self {
            enough: false,
            tolerance: Vector::zeros(),
            left: 0,
        }
    }

    /// Counts a step; whether it is one that looks at the Jacobian, as each does until
    /// predictions are as good as they become.
    #[inline(always)]
    pub(super) fn is_due(&mut self, predicts_well: bool) -> bool {
        let due = self.left == 0;
        if !due & predicts_well {
            self.left -= 1;
        }
        due
    }

    /// Whether a correction is the last; a NaN is not.
    #[inline(always)]
    pub(super) fn is_last(&self, correction: &Vector<f64, N>) -> bool {
        let small = |i: usize| correction[i].abs() <= self.tolerance[i];
        (0..N).fold(true, |all, i| all & small(i))
    }

    /// Decides from Newton's `matrix` I − τ ∂f^τ/∂x₁ and its first `correction`, which led from
    /// the prediction to `increment`.
    pub(super) fn decide(
        matrix: &Matrix<f64, N, N>,
        correction: &Vector<f64, N>,
        increment: &Vector<f64, N>,
        x0: &Vector<f64, N>,
    ) -> Self {
        let scale = increment.zip_map(x0, |d, x| d.abs() + SHARE_OF_STATE * x.abs());
        // ‖τ ∂f^τ/∂x₁‖ and ‖e‖ in the norm max |uᵢ|/scaleᵢ; NaN where a scale is zero, but for
        // components that rest at zero
        let mut contraction = 0.0;
        let mut error = 0.0;
        for i in 0..N {
            let mut row = 0.0;
            for j in 0..N {
                let slope = matrix[(i, j)] - if i == j { 1.0 } else { 0.0 };
                row += slope.abs() * scale[j];
            }
            let off = correction[i].abs();
            let rests = scale[i] == 0.0 && row == 0.0 && off == 0.0;
            if !rests {
                contraction = larger(contraction, row / scale[i]);
                error = larger(error, off / scale[i]);
            }
        }
        Self {
            enough: error * contraction.powi(MOST as i32) <= ENOUGH,
            tolerance: scale * (ENOUGH / contraction.max(f64::MIN_POSITIVE)),
            left: INTERVAL - 1,
        }
    }
}

/// The larger of two, or NaN if one is.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b { a } else { b }
}
