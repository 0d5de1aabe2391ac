//! Power series.

/// Σ cₖ xᵏ, the even and the odd powers apart to halve the chain of dependent operations.
#[inline]
pub(super) fn power_series<const N: usize>(x: f64, coefficients: &[f64; N]) -> f64 {
    let square = x * x;
    let mut even = 0.0;
    let mut odd = 0.0;
    for (k, &coefficient) in coefficients.iter().enumerate().rev() {
        let sum = if k % 2 == 0 { &mut even } else { &mut odd };
        *sum = *sum * square + coefficient;
    }
    even + x * odd
}
