//! Sums of products by several terms at once, as vectors of the processor have them.

use std::hint::black_box;

use crate::arithmetic::Scalar;

/// Terms at once: as many doubles as a register of the target holds.
const WIDTH: usize = if cfg!(target_feature = "avx") { 4 } else { 2 };

/// By the number of terms that whole vectors leave: which of the last ones these are.
const LEFT: [[f64; WIDTH]; WIDTH] = {
    let mut left = [[0.0; WIDTH]; WIDTH];
    let mut count = 1;
    while count < WIDTH {
        let mut j = WIDTH - count;
        while j < WIDTH {
            left[count][j] = 1.0;
            j += 1;
        }
        count += 1;
    }
    left
};

/// Σ aⱼ bₙ₋₁₋ⱼ of two slices of n values.
#[inline(always)]
pub(super) fn turned<S: Scalar>(a: &[S], b: &[S]) -> S {
    let [sum] = together([[a, b]], a.len());
    sum
}

/// The same of several pairs of slices of n values: one loop for all of them.
#[inline(always)]
pub(super) fn together<S: Scalar, const B: usize>(pairs: [[&[S]; 2]; B], n: usize) -> [S; B] {
    let zero = S::from_f64(0.0);
    let mut sums = [zero; B];
    // several lanes of each take all registers
    if B > 1 && const { size_of::<S>() > size_of::<f64>() } {
        for (sum, pair) in sums.iter_mut().zip(pairs) {
            [*sum] = together([pair], n);
        }
        return sums;
    }
    if n < WIDTH {
        for at in 0..n {
            for (sum, [a, b]) in sums.iter_mut().zip(&pairs) {
                *sum = a[..n][at].fused(b[..n][n - 1 - at], *sum);
            }
        }
        return sums;
    }
    let mut parts = [[zero; WIDTH]; B];
    for at in (0..n / WIDTH).map(|whole| whole * WIDTH) {
        for (parts, [a, b]) in parts.iter_mut().zip(&pairs) {
            let (a, b) = (vector(&a[..n], at), vector(&b[..n], n - WIDTH - at));
            for j in 0..WIDTH {
                parts[j] = a[j].fused(b[WIDTH - 1 - j], parts[j]);
            }
        }
    }
    let left = LEFT[n % WIDTH].map(S::from_f64);
    for (parts, [a, b]) in parts.iter_mut().zip(&pairs) {
        let (a, b) = (vector(&a[..n], n - WIDTH), vector(&b[..n], 0));
        for j in 0..WIDTH {
            parts[j] = (a[j] * left[j]).fused(b[WIDTH - 1 - j], parts[j]);
        }
    }
    for (sum, parts) in sums.iter_mut().zip(&parts) {
        *sum = total(black_box(*parts));
    }
    sums
}

/// The sum of the parts. They come by way of memory, without which LLVM would rather join those of
/// several sums in a vector than the terms of one, and load these one by one.
#[inline(always)]
fn total<S: Scalar>(mut parts: [S; WIDTH]) -> S {
    let mut count = WIDTH;
    while count > 1 {
        count /= 2;
        for j in 0..count {
            let other = parts[j + count];
            parts[j] += other;
        }
    }
    parts[0]
}

/// The values from `start` on.
#[inline(always)]
fn vector<S>(values: &[S], start: usize) -> &[S] {
    &values[start..start + WIDTH]
}
