//! Error-free transformations: a rounded operation with its rounding error.

use std::ops::{Add, Sub};

/// a + b = s + e exactly, s the rounded sum (Knuth, TAOCP 2, 4.2.2, theorem B); of vectors by
/// component.
#[inline(always)]
pub(crate) fn two_sum<T: Copy + Add<Output = T> + Sub<Output = T>>(a: T, b: T) -> (T, T) {
    let s = a + b;
    let b_part = s - a;
    let a_part = s - b_part;
    (s, (a - a_part) + (b - b_part))
}

/// Whether the target has a fused multiply-add; elsewhere that is a library call.
pub(crate) const HAS_FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// a·b = p + e exactly, barring overflow.
#[inline]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    if HAS_FUSED {
        return (p, a.mul_add(b, -p));
    }
    (p, split_error(a, b, p))
}

/// a·b − p of the rounded product p, by splitting the factors (Dekker 1971).
#[inline(always)]
pub(crate) const fn split_error(a: f64, b: f64, p: f64) -> f64 {
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    const fn high(v: f64) -> f64 {
        let c = SPLITTER * v;
        c - (c - v)
    }
    let (ah, bh) = (high(a), high(b));
    let (al, bl) = (a - ah, b - bh);
    ((ah * bh - p) + ah * bl + al * bh) + al * bl
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_product_and_two_sum_are_exact() {
        let (a, b) = (1.0 + 2f64.powi(-40), 1.0 + 2f64.powi(-41));
        assert_eq!(
            two_product(a, b),
            (1.0 + 2f64.powi(-40) + 2f64.powi(-41), 2f64.powi(-81))
        );
        assert_eq!(two_sum(1.0, 2f64.powi(-60)), (1.0, 2f64.powi(-60)));
    }
}
