//! Error-free transformations: a rounded operation with its rounding error.

use super::Scalar;

/// a + b = s + e exactly, s the rounded sum (Knuth, TAOCP 2, 4.2.2, theorem B).
#[inline(always)]
pub(crate) fn two_sum<S: Scalar>(a: S, b: S) -> (S, S) {
    let s = a + b;
    let b_part = s - a;
    let a_part = s - b_part;
    (s, (a - a_part) + (b - b_part))
}

/// a·b = p + e exactly, barring overflow (Dekker 1971).
///
/// By splitting where the target has no fused multiply-add: there that is a library call.
#[inline]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        let p = a * b;
        return (p, a.mul_add(b, -p));
    }
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let split = |v: f64| {
        let c = SPLITTER * v;
        let high = c - (c - v);
        (high, v - high)
    };
    let p = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
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
