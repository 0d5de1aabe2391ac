//! Orders, fitted to errors.

/// The exponent p of the best fit e = c τᵖ, by least squares in the logarithms; NaN if there
/// are fewer than two positive errors.
pub fn fitted_order(step_sizes: &[f64], errors: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> = step_sizes
        .iter()
        .zip(errors)
        .filter(|(_, error)| **error > 0.0)
        .map(|(tau, error)| (tau.ln(), error.ln()))
        .collect();
    if points.len() < 2 {
        return f64::NAN;
    }
    let count = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / count;
    let mean_y = points.iter().map(|p| p.1).sum::<f64>() / count;
    let covariance: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    covariance / variance
}
