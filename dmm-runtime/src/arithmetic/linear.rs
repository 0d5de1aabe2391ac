//! The small dense systems of a step: closed form for one and two unknowns, the closed inverse
//! of [`nalgebra`] up to four, Gaussian elimination for more.
//!
//! A matrix of 64 unknowns takes 32 KB, so that the elimination works in the caller's copy.
//! Zeros of the pivot's row are skipped: the matrix I − τ ∂f^τ/∂x₁ of a chain has a handful of
//! entries a row, and its elimination costs O(N²) rather than O(N³) operations.

use crate::arithmetic::Scalar;
use crate::arithmetic::masked::Masked;
use crate::arithmetic::{Matrix, Vector};

/// Up to here the inverse has a closed form.
const LARGEST_CLOSED: usize = 4;

/// Terms from which on they are taken together in parts.
const MANY: usize = 16;

/// a·b
#[inline(always)]
pub(crate) fn dot<S: Scalar, const N: usize>(a: &Vector<S, N>, b: &Vector<S, N>) -> S {
    if const { N < MANY } {
        let mut sum = a[0] * b[0];
        for i in 1..N {
            sum = a[i].fused(b[i], sum);
        }
        return sum;
    }
    let sum = |sum: S, i: usize| a[i].fused(b[i], sum);
    together::<S, N>(S::from_f64(0.0), sum, |a, b| a + b)
}

/// What `with` makes of `start` and one i < N after the other; of many in four parts that do not wait for
/// each other, which are `joined`.
#[inline(always)]
pub(crate) fn together<T: Copy, const N: usize>(
    start: T,
    with: impl Fn(T, usize) -> T,
    joined: impl Fn(T, T) -> T,
) -> T {
    const PARTS: usize = 4;
    if const { N < MANY } {
        let mut all = start;
        for i in 0..N {
            all = with(all, i);
        }
        return all;
    }
    let mut parts = [start; PARTS];
    let whole = N - N % PARTS;
    for first in (0..whole).step_by(PARTS) {
        for (part, value) in parts.iter_mut().enumerate() {
            *value = with(*value, first + part);
        }
    }
    let [a, b, c, d] = parts;
    (whole..N).fold(joined(joined(a, c), joined(b, d)), with)
}

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
        3..=LARGEST_CLOSED => s = a.try_inverse()? * b,
        _ => {
            let mut copy = *a;
            eliminate(&mut copy, &mut s)?;
        }
    }
    is_finite(&s).then_some(s)
}

/// Gaussian elimination with partial pivoting: turns b into the solution of A·s = b, and A into
/// the triangle that is left. Nothing if a pivot is zero or not a number.
fn eliminate<const N: usize>(a: &mut Matrix<f64, N, N>, b: &mut Vector<f64, N>) -> Option<()> {
    // by columns, as they are stored
    let columns = &mut a.data.0;
    let b = &mut b.data.0[0];
    for k in 0..N {
        let pivot = (k..N).max_by(|&i, &j| columns[k][i].abs().total_cmp(&columns[k][j].abs()))?;
        if pivot != k {
            for column in &mut columns[k..] {
                column.swap(k, pivot);
            }
            b.swap(k, pivot);
        }
        let inverse = 1.0 / columns[k][k];
        if !inverse.is_finite() {
            return None;
        }
        // a copy, which cannot lie in another column
        let mut factors = columns[k];
        for factor in &mut factors[k + 1..] {
            *factor *= inverse;
        }
        for column in &mut columns[k + 1..] {
            if column[k] != 0.0 {
                subtract(column, &factors, k);
            }
        }
        subtract(b, &factors, k);
    }
    for k in (0..N).rev() {
        b[k] /= columns[k][k];
        let value = b[k];
        for (entry, above) in b[..k].iter_mut().zip(&columns[k][..k]) {
            *entry -= value * above;
        }
    }
    Some(())
}

/// Takes `factors` times entry k off the entries below it.
#[inline]
fn subtract<const N: usize>(column: &mut [f64; N], factors: &[f64; N], k: usize) {
    let value = column[k];
    for (entry, factor) in column[k + 1..].iter_mut().zip(&factors[k + 1..]) {
        *entry -= value * factor;
    }
}

/// Whether every entry is finite.
#[inline(always)]
pub(crate) fn is_finite<S: Masked, const N: usize>(x: &Vector<S, N>) -> S::Mask {
    // 0·u is 0 for a finite u and NaN otherwise: one comparison for the whole vector
    let zero = S::from_f64(0.0);
    together::<S, N>(zero, |sum, i| sum + zero * x[i], |a, b| a + b).equals(zero)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_systems_are_solved() {
        let a = Matrix::<f64, 2, 2>::new(2.0, 1.0, -1.0, 3.0);
        let x = Vector::<f64, 2>::new(0.5, -2.0);
        assert!((solve(&a, &(a * x)).expect("regular") - x).norm() < 1e-15);
        let a = Matrix::<f64, 4, 4>::from_fn(|i, j| {
            if i == j {
                3.0
            } else {
                1.0 / (1 + i + 2 * j) as f64
            }
        });
        let x = Vector::<f64, 4>::from_fn(|i, _| i as f64 - 1.5);
        assert!((solve(&a, &(a * x)).expect("regular") - x).norm() < 1e-13);
    }

    /// Entries in [−1, 1], the same in every run.
    fn scattered<const N: usize>(seed: usize) -> Matrix<f64, N, N> {
        Matrix::from_fn(|i, j| ((1 + i * N + j + seed) as f64).powi(2).sin())
    }

    /// ‖A s − b‖ relative to ‖A‖‖s‖ is what rounding makes of it, N ε at most (in practice far
    /// less; Higham, Accuracy and Stability of Numerical Algorithms, 9.3).
    fn assert_solves<const N: usize>(a: &Matrix<f64, N, N>) {
        let b = Vector::<f64, N>::from_fn(|i, _| 1.0 + (i as f64).cos());
        let s = solve(a, &b).expect("regular");
        let bound = N as f64 * f64::EPSILON * a.norm() * s.norm();
        assert!((a * s - b).norm() <= bound, "N = {N}");
    }

    #[test]
    fn elimination_solves_what_needs_pivots() {
        for seed in 0..20 {
            assert_solves(&scattered::<5>(seed));
            assert_solves(&scattered::<17>(seed));
        }
        // no pivot is where it is needed
        let shifted = Matrix::<f64, 7, 7>::from_fn(|i, j| f64::from(u8::from((i + 3) % 7 == j)));
        assert_solves(&shifted);
    }

    /// I − τ A of a ring of 32 masses.
    fn ring() -> Matrix<f64, 64, 64> {
        let mut a = Matrix::<f64, 64, 64>::identity();
        for i in 0..32 {
            a[(i, i + 32)] = -0.01;
            a[(i + 32, i)] = 0.02;
            a[(i + 32, (i + 1) % 32)] = -0.01;
            a[(i + 32, (i + 31) % 32)] = -0.01;
        }
        a
    }

    #[test]
    fn sixty_four_unknowns_fit_a_small_stack() {
        // a quarter of what a test's thread has, in a build without optimisation too
        let thread = std::thread::Builder::new().stack_size(512 * 1024);
        let solved = thread.spawn(|| {
            assert_solves(&ring());
            assert_solves(&scattered::<64>(3));
        });
        solved.expect("a thread").join().expect("a solution");
    }

    #[test]
    fn singular_systems_have_no_solution() {
        let a = Matrix::<f64, 2, 2>::new(1.0, 2.0, 2.0, 4.0);
        assert_eq!(solve(&a, &Vector::<f64, 2>::new(1.0, 1.0)), None);
        let a = Matrix::<f64, 3, 3>::zeros();
        assert_eq!(solve(&a, &Vector::<f64, 3>::new(1.0, 1.0, 0.0)), None);
        let a = Matrix::<f64, 1, 1>::new(f64::NAN);
        assert_eq!(solve(&a, &Vector::<f64, 1>::new(1.0)), None);
        let a = Matrix::<f64, 6, 6>::from_fn(|i, j| (i + j) as f64);
        let b = Vector::<f64, 6>::from_fn(|i, _| (i * i) as f64);
        assert_eq!(solve(&Matrix::zeros(), &b), None);
        // rank 2: what rounding leaves of the pivots is zero or tiny
        assert!(solve(&a, &b).is_none_or(|s| s.amax() > 1e12));
        let mut a = ring();
        a[(40, 41)] = f64::NAN;
        assert_eq!(solve(&a, &Vector::<f64, 64>::from_element(1.0)), None);
        a[(40, 41)] = f64::INFINITY;
        assert_eq!(solve(&a, &Vector::<f64, 64>::from_element(1.0)), None);
    }
}
