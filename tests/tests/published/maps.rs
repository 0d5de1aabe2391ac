//! Fixed points, multipliers and bifurcations of maps of the plane.

use super::Failure;

/// A map of the plane.
pub(crate) type Map<'a> = dyn Fn([f64; 2]) -> Result<[f64; 2], Failure> + 'a;

/// The derivative of a map, by central differences with steps of 1, 1/2, … 1/16 of those given for
/// each component, extrapolated to order 10 (Richardson).
pub(crate) fn derivative(
    map: &Map<'_>,
    x: [f64; 2],
    steps: [f64; 2],
) -> Result<[[f64; 2]; 2], Failure> {
    const LEVELS: usize = 5;
    let mut derivative = [[0.0; 2]; 2];
    for j in 0..2 {
        let mut table = [[0.0; 2]; LEVELS];
        for (level, entry) in table.iter_mut().enumerate() {
            let h = steps[j] / f64::from(1 << level);
            let at = |sign: f64| {
                let mut moved = x;
                moved[j] += sign * h;
                map(moved)
            };
            let (above, below) = (at(1.0)?, at(-1.0)?);
            *entry = [0, 1].map(|i| (above[i] - below[i]) / (2.0 * h));
        }
        for order in 1..LEVELS {
            let factor = f64::from(1 << (2 * order)) - 1.0;
            for level in (order..LEVELS).rev() {
                let coarse = table[level - 1];
                for (fine, coarse) in table[level].iter_mut().zip(coarse) {
                    *fine += (*fine - coarse) / factor;
                }
            }
        }
        for i in 0..2 {
            derivative[i][j] = table[LEVELS - 1][i];
        }
    }
    Ok(derivative)
}

/// The fixed point of a map near x, by Newton's method.
pub(crate) fn fixed_point(
    map: &Map<'_>,
    mut x: [f64; 2],
    steps: [f64; 2],
) -> Result<[f64; 2], Failure> {
    for _ in 0..8 {
        let value = map(x)?;
        let [[a, b], [c, d]] = derivative(map, x, steps)?;
        let (a, d) = (a - 1.0, d - 1.0);
        let (r, s) = (value[0] - x[0], value[1] - x[1]);
        let determinant = a * d - b * c;
        x[0] -= (d * r - b * s) / determinant;
        x[1] -= (a * s - c * r) / determinant;
    }
    Ok(x)
}

/// Trace and determinant.
pub(crate) fn invariants([[a, b], [c, d]]: [[f64; 2]; 2]) -> (f64, f64) {
    (a + d, a * d - b * c)
}

/// The zero of a function near two points, by the secant method.
pub(crate) fn zero(
    f: impl Fn(f64) -> Result<f64, Failure>,
    mut a: f64,
    mut b: f64,
) -> Result<f64, Failure> {
    let (mut f_a, mut f_b) = (f(a)?, f(b)?);
    for _ in 0..8 {
        if f_a == f_b {
            break;
        }
        let next = b - f_b * (b - a) / (f_b - f_a);
        (a, f_a) = (b, f_b);
        (b, f_b) = (next, f(next)?);
    }
    Ok(b)
}
