//! Sums of products that run together: each has a lane of a table of coefficients, whose rows are the
//! orders, so that a vector of the processor holds one term of several sums.
//!
//! A table of W lanes takes the place of W arrays of coefficients: its row j has the coefficients of
//! order j.

use super::Order;
use crate::arithmetic::Scalar;

/// Σ aⱼ bₖ₋ⱼ over 1 ≤ j < k, of tables a and b of W lanes each, one behind the other. W is a multiple
/// of four.
#[inline(always)]
pub fn inner_sums<S: Scalar, K: Order, const P: usize, const W: usize>(
    k: K,
    tables: &[[S; P]],
) -> [S; W] {
    let k = k.get().max(1);
    let (a, b) = tables.as_flattened().split_at(W * P);
    S::products_by_column(&a[W..W * k], &b[W..W * k])
}

/// Σ uⱼ uₖ₋ⱼ over 1 ≤ j < k/2, of a table of W lanes, a multiple of four.
#[inline(always)]
pub fn half_sums<S: Scalar, K: Order, const P: usize, const W: usize>(
    k: K,
    table: &[[S; P]],
) -> [S; W] {
    let k = k.get().max(1);
    let last = (k - 1) / 2;
    let u = table.as_flattened();
    S::products_by_column(&u[W..W * (last + 1)], &u[W * (k - last)..W * k])
}

/// Row j of a table of W lanes: the coefficients of order j.
#[inline(always)]
pub fn row<S, const P: usize, const W: usize>(table: &[[S; P]], order: usize) -> &[S; W] {
    let (rows, _) = table.as_flattened().as_chunks();
    &rows[order]
}

/// Σ aⱼ bₙ₋₁₋ⱼ of two slices of n values, by four parts that do not wait for each other.
#[inline(always)]
pub(super) fn single<S: Scalar>(a: &[S], b: &[S]) -> S {
    const PARTS: usize = 4;
    let zero = S::from_f64(0.0);
    let mut parts = [zero; PARTS];
    let mut whole = a.chunks_exact(PARTS);
    let mut turned = b.rchunks_exact(PARTS);
    for (a, b) in whole.by_ref().zip(turned.by_ref()) {
        for j in 0..PARTS {
            parts[j] = a[j].fused(b[PARTS - 1 - j], parts[j]);
        }
    }
    let left = whole
        .remainder()
        .iter()
        .zip(turned.remainder().iter().rev());
    for (part, (&a, &b)) in parts.iter_mut().zip(left) {
        *part = a.fused(b, *part);
    }
    let [first, second, third, fourth] = parts;
    (first + third) + (second + fourth)
}
