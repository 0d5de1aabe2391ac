//! Exponentials.

use crate::arithmetic::error_free::two_product;

/// e^{a·b} without the rounding error of the product.
///
/// With a·b = p + r exactly, p the rounded product, e^{ab} = eᵖ(1 + r) up to r²/2, which is
/// below 10⁻²⁷ wherever the result is finite. `exp(a * b)` has the relative error |r|, up to
/// |ab|·2⁻⁵³: it grows with the exponent, as in a quantity e^{γt}ψ(x) over a long time.
///
/// - Domain: all a, b. Where a·b overflows it is `exp(a * b)`, 0 or ∞; NaN for 0 and ∞.
/// - Accuracy: 2 ulp.
/// - Source: the product a·b = p + r by Dekker, *Numer. Math.* 18 (1971).
///
/// ```
/// use dmm_runtime::special::exp_product;
///
/// // 0.1 · 1001 = 100.1000000000000055… as doubles, and e to that
/// let exact = 2.970_828_889_515_840_8e43;
/// assert!((exp_product(0.1, 1001.0) / exact - 1.0).abs() < 4e-16);
/// ```
#[inline]
pub fn exp_product(a: f64, b: f64) -> f64 {
    let (p, r) = two_product(a, b);
    let e = p.exp();
    let corrected = e + e * r;
    if corrected.is_finite() {
        corrected
    } else {
        exp_product_at_limits(a, b, p)
    }
}

/// Where eᵖ overflows, and where a or b is too large to be split into halves.
#[cold]
fn exp_product_at_limits(a: f64, b: f64, p: f64) -> f64 {
    let e = p.exp();
    let r = a.mul_add(b, -p);
    if e.is_finite() && r.is_finite() {
        e + e * r
    } else {
        e
    }
}
