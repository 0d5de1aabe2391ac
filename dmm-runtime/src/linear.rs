//! The small dense systems of a step: closed form for one and two unknowns, the inverse of
//! [`nalgebra`] for more.

use crate::system::{Matrix, Vector};

/// The solution of A·s = b; nothing if A is singular or not finite.
#[inline]
pub(crate) fn solve<const N: usize>(
    a: &Matrix<f64, N, N>,
    b: &Vector<f64, N>,
) -> Option<Vector<f64, N>> {
    let mut s = *b;
    match N {
        0 => {}
        1 => s[0] = b[0] / a[(0, 0)],
        2 => {
            let scale = 1.0 / (a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(1, 0)]);
            s[0] = (b[0] * a[(1, 1)] - a[(0, 1)] * b[1]) * scale;
            s[1] = (a[(0, 0)] * b[1] - a[(1, 0)] * b[0]) * scale;
        }
        _ => s = a.try_inverse()? * b,
    }
    is_finite(&s).then_some(s)
}

/// Whether every entry is finite.
#[inline]
pub(crate) fn is_finite<const N: usize>(x: &Vector<f64, N>) -> bool {
    // 0·u is 0 for a finite u and NaN otherwise: one comparison for the whole vector
    x.iter().fold(0.0, |sum, u| sum + 0.0 * u) == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_systems_are_solved() {
        let a = Matrix::<f64, 2, 2>::new(2.0, 1.0, -1.0, 3.0);
        let x = Vector::<f64, 2>::new(0.5, -2.0);
        assert!((solve(&a, &(a * x)).expect("regular") - x).norm() < 1e-15);
        let a = Matrix::<f64, 5, 5>::from_fn(|i, j| {
            if i == j {
                3.0
            } else {
                1.0 / (1 + i + 2 * j) as f64
            }
        });
        let x = Vector::<f64, 5>::from_fn(|i, _| i as f64 - 1.5);
        assert!((solve(&a, &(a * x)).expect("regular") - x).norm() < 1e-13);
    }

    #[test]
    fn singular_systems_have_no_solution() {
        let a = Matrix::<f64, 2, 2>::new(1.0, 2.0, 2.0, 4.0);
        assert_eq!(solve(&a, &Vector::<f64, 2>::new(1.0, 1.0)), None);
        let a = Matrix::<f64, 3, 3>::zeros();
        assert_eq!(solve(&a, &Vector::<f64, 3>::new(1.0, 1.0, 0.0)), None);
        let a = Matrix::<f64, 1, 1>::new(f64::NAN);
        assert_eq!(solve(&a, &Vector::<f64, 1>::new(1.0)), None);
    }
}
