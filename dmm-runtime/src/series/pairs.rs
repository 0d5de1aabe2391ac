//! Two sums at once, in straight-line code: of products and squares that are alike, of a power and of two
//! integrals. Tables of two lanes have their factors.

use super::pack::{Arithmetic, Pack, pack};
use super::{Order, inverse, product_from, square_from};
use crate::arithmetic::Scalar;

/// The coefficients of two series, by order.
pub trait Columns<S>: Copy {
    /// Those of an order.
    fn of(self, order: usize) -> Pack<S, 2>;
}

/// A table of two lanes.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, S, const P: usize>(pub &'a [[S; P]]);

impl<S: Scalar, const P: usize> Columns<S> for Rows<'_, S, P> {
    #[inline(always)]
    fn of(self, order: usize) -> Pack<S, 2> {
        pack::<S, P, 2, 2>(self.0, order, 0)
    }
}

/// The array that both have in common.
#[derive(Clone, Copy, Debug)]
pub struct Common<'a, S, const P: usize>(pub &'a [S; P]);

impl<S: Scalar, const P: usize> Columns<S> for Common<'_, S, P> {
    #[inline(always)]
    fn of(self, order: usize) -> Pack<S, 2> {
        Pack::all(self.0[order])
    }
}

/// Σ aⱼ bₖ₋ⱼ over 1 ≤ j < k, or over 1 ≤ j < k − 1 `without_newest`: from the middle on, so that what
/// was computed last enters last.
#[inline(always)]
fn inner<S: Scalar>(
    k: usize,
    a: impl Columns<S>,
    b: impl Columns<S>,
    without_newest: bool,
) -> Pack<S, 2> {
    let mut sum = Pack::of(0.0);
    if k.is_multiple_of(2) && k > usize::from(without_newest) * 2 {
        sum = a.of(k / 2).times_plus(b.of(k / 2), sum);
    }
    for j in (1..k.div_ceil(2)).rev() {
        sum = a.of(j).times_plus(b.of(k - j), sum);
        if j > 1 || !without_newest {
            sum = a.of(k - j).times_plus(b.of(j), sum);
        }
    }
    sum
}

/// Coefficient k of two products uv, from uₖ and vₖ and the coefficients below.
#[inline(always)]
pub fn products<S: Scalar, K: Order>(
    k: K,
    u: (impl Columns<S>, Pack<S, 2>),
    v: (impl Columns<S>, Pack<S, 2>),
) -> Pack<S, 2> {
    let sum = inner(k.get(), u.0, v.0, false);
    product_from(k, [u.0.of(0), u.1], [v.0.of(0), v.1], sum)
}

/// Coefficient k of two squares u², from uₖ and the coefficients below.
#[inline(always)]
pub fn squares<S: Scalar, K: Order>(k: K, u: (impl Columns<S>, Pack<S, 2>)) -> Pack<S, 2> {
    let order = k.get();
    let mut sum = Pack::of(0.0);
    for j in (1..order.div_ceil(2)).rev() {
        sum = u.0.of(j).times_plus(u.0.of(order - j), sum);
    }
    square_from(k, [u.0.of(0), u.1], u.0.of(order / 2), sum)
}

/// Coefficient k ≥ 1 of w = u^a, by a table with w and h dw/dh: with a k Σ wⱼ uₖ₋ⱼ − (a + 1) Σ j wⱼ uₖ₋ⱼ
/// in place of Σ (a (k − j) − j) wⱼ uₖ₋ⱼ; `inverse_base` is 1/u₀. What the newest w adds is added last.
#[inline(always)]
pub fn power_by_pairs<S: Scalar, K: Order, const P: usize>(
    k: K,
    u: &[S; P],
    a: S,
    w: &[[S; P]],
    inverse_base: S,
) -> S {
    let order = k.get();
    let w = Rows(w);
    let [first, second] = inner(order, w, Common(u), true).0;
    let scale = inverse_base * inverse::<S>(order);
    let factors = [a * S::from_f64(order as f64), -(a + S::from_f64(1.0))];
    let mut rest = factors[0].fused(first, factors[1] * second) * scale;
    if order > 1 {
        let Pack([newest, _]) = w.of(order - 1);
        let weight = a - S::from_f64((order - 1) as f64);
        rest = newest.fused(weight * scale * u[1], rest);
    }
    let Pack([start, _]) = w.of(0);
    u[order].fused(a * start * inverse_base, rest)
}

/// Coefficients k of ∫ v du for two v, from uₖ, d = h du/dh and a table of both v. What the newest v add
/// is added last.
#[inline(always)]
pub fn integrals<S: Scalar, K: Order, const P: usize>(
    k: K,
    u: S,
    d: &[S; P],
    v: &[[S; P]],
) -> Pack<S, 2> {
    let (order, v) = (k.get(), Rows(v));
    if order == 0 {
        return Pack::of(0.0);
    }
    let part = inverse::<S>(order);
    let mut rest = inner(order, v, Common(d), true) * Pack::all(part);
    if order > 1 {
        rest = v.of(order - 1).times_plus(Pack::all(d[1] * part), rest);
    }
    Pack::all(u).times_plus(v.of(0), rest)
}
