//! Sums of products by column, over rows of numbers: several sums at once.

use wide::f64x4;

/// Columns at a time, at least.
const COLUMNS: usize = 4;

/// Σ aⱼ bₙ₋₁₋ⱼ over n rows of W numbers, by column, where `fused` is u·v + w.
#[inline(always)]
pub(crate) fn products<S: Copy, const W: usize>(
    zero: S,
    fused: impl Fn(S, S, S) -> S,
    a: &[S],
    b: &[S],
) -> [S; W] {
    let mut sums = [zero; W];
    let (a, b) = (a.as_chunks::<W>().0, b.as_chunks::<W>().0);
    let rows = a.len().min(b.len());
    let half = rows / 2;
    for at in (0..W).step_by(COLUMNS) {
        let mut some = [zero; COLUMNS];
        // in the order of `for_rows`; what is passed to that is compiled without the instructions of lanes
        macro_rules! add {
            ($row:expr) => {
                let row = $row;
                let (a, b) = (&a[row], &b[rows - 1 - row]);
                for (column, sum) in some.iter_mut().enumerate() {
                    *sum = fused(a[at + column], b[at + column], *sum);
                }
            };
        }
        if !rows.is_multiple_of(2) {
            add!(half);
        }
        for low in (0..half).rev() {
            add!(rows - 1 - low);
            add!(low);
        }
        sums[at..at + COLUMNS].copy_from_slice(&some);
    }
    sums
}

/// The same of doubles, by vectors: as many as stay in the registers of a processor.
#[inline(always)]
pub(crate) fn products_by_vectors<const W: usize>(a: &[f64], b: &[f64]) -> [f64; W] {
    const MOST: usize = 8 * COLUMNS;
    let mut sums = [0.0; W];
    let mut at = 0;
    while W - at >= MOST {
        vectors::<W, 8>(a, b, at, &mut sums);
        at += MOST;
    }
    match const { W % MOST / COLUMNS } {
        1 => vectors::<W, 1>(a, b, at, &mut sums),
        2 => vectors::<W, 2>(a, b, at, &mut sums),
        3 => vectors::<W, 3>(a, b, at, &mut sums),
        4 => vectors::<W, 4>(a, b, at, &mut sums),
        5 => vectors::<W, 5>(a, b, at, &mut sums),
        6 => vectors::<W, 6>(a, b, at, &mut sums),
        7 => vectors::<W, 7>(a, b, at, &mut sums),
        _ => {}
    }
    sums
}

/// V vectors of columns from `at` on.
#[inline(always)]
fn vectors<const W: usize, const V: usize>(a: &[f64], b: &[f64], at: usize, sums: &mut [f64; W]) {
    let mut some = [f64x4::ZERO; V];
    for_rows::<f64, W>(a, b, |a, b| {
        for (vector, sum) in some.iter_mut().enumerate() {
            let at = at + COLUMNS * vector;
            *sum = load(a, at).mul_add(load(b, at), *sum);
        }
    });
    for (vector, sum) in some.into_iter().enumerate() {
        let at = at + COLUMNS * vector;
        sums[at..at + COLUMNS].copy_from_slice(&sum.to_array());
    }
}

/// Goes through the rows of a, and those of b the other way round, from the middle on: what was computed
/// last enters last, and the sum of the others need not wait for it.
#[inline(always)]
fn for_rows<S, const W: usize>(a: &[S], b: &[S], mut each: impl FnMut(&[S; W], &[S; W])) {
    const { assert!(W.is_multiple_of(COLUMNS)) };
    let (a, b) = (a.as_chunks().0, b.as_chunks().0);
    let rows = a.len().min(b.len());
    let (a, b, half) = (&a[..rows], &b[..rows], rows / 2);
    if !rows.is_multiple_of(2) {
        each(&a[half], &b[half]);
    }
    let (low_a, high_a) = (&a[..half], &a[rows - half..]);
    let (low_b, high_b) = (&b[..half], &b[rows - half..]);
    let high = high_a.iter().zip(low_b.iter().rev());
    let low = low_a.iter().rev().zip(high_b);
    for ((high_a, low_b), (low_a, high_b)) in high.zip(low) {
        each(high_a, low_b);
        each(low_a, high_b);
    }
}

#[inline(always)]
fn load<const W: usize>(row: &[f64; W], at: usize) -> f64x4 {
    f64x4::new(row[at..].first_chunk().copied().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::Scalar;

    #[test]
    fn vectors_give_what_one_column_after_the_other_gives() {
        const W: usize = 28;
        for rows in 0..8 {
            let numbers = |of: usize| (0..rows * W).map(move |i| ((of + i) as f64).sin());
            let [a, b]: [Vec<f64>; 2] = [1, 1000].map(|of| numbers(of).collect());
            let sums: [f64; W] = products(0.0, f64::fused, &a, &b);
            assert_eq!(sums, products_by_vectors::<W>(&a, &b));
            for (column, sum) in sums.into_iter().enumerate() {
                let term = |j: usize| a[j * W + column] * b[(rows - 1 - j) * W + column];
                let plain: f64 = (0..rows).map(term).sum();
                assert!((sum - plain).abs() < 1e-14, "{sum} {plain}");
            }
        }
    }
}
