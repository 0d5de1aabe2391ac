//! Power series: the recurrences for their coefficients that generated code is made of.
//!
//! A function u(t₀ + h) = Σ uₖ hᵏ is the array of its P coefficients. Each function here gives
//! coefficient k of a result from coefficients up to k of the arguments and up to k − 1 of the
//! result itself (Jorba & Zou, Experimental Mathematics 14, 2005, proposition 2.1). So all
//! series of a system advance together, one order at a time.
//!
//! What coefficient k of an argument adds is added last, by one fused operation: everything else of
//! order k is known an order before, and the chain from order to order is as short as it can be.
//!
//! The order is an [`Order`]: a constant of the type, so that the sums are unrolled into
//! straight-line code, or a number. A number comes with a unit of time σ: the coefficients are
//! those of (h/σ)ᵏ then.

mod pack;
mod pairs;
mod sums;
#[cfg(test)]
mod tests;
mod unroll;

pub use pack::{Arithmetic, Pack, pack, set_pack};
pub use pairs::{Columns, Common, Rows, integrals, power_by_pairs, products, squares};
pub use sums::{half_sums, inner_sums, row};
pub use unroll::{Choice, Coefficients, Mixed, Rolled, Straight, Unroll};

use crate::arithmetic::Scalar;

/// The index k of a coefficient.
pub trait Order: Copy {
    /// Whether it is known at compile time: sums are written out then, and run by several terms at
    /// once otherwise.
    const IS_FIXED: bool;

    /// k
    fn get(self) -> usize;

    /// The unit of time σ: the coefficients are those of (h/σ)ᵏ.
    #[inline(always)]
    fn unit(self) -> f64 {
        1.0
    }
}

/// An order known at compile time.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<const K: usize>;

impl<const K: usize> Order for Fixed<K> {
    const IS_FIXED: bool = true;

    #[inline(always)]
    fn get(self) -> usize {
        K
    }
}

/// An order known at run time, of coefficients in any unit of time.
#[derive(Clone, Copy, Debug)]
pub struct InUnits {
    pub(crate) order: usize,
    pub(crate) unit: f64,
}

impl Order for InUnits {
    const IS_FIXED: bool = false;

    #[inline(always)]
    fn get(self) -> usize {
        self.order
    }

    #[inline(always)]
    fn unit(self) -> f64 {
        self.unit
    }
}

/// Largest number of coefficients.
pub(crate) const MOST_COEFFICIENTS: usize = 23;

/// 1/k
const INVERSE: [f64; MOST_COEFFICIENTS + 1] = {
    let mut inverse = [0.0; MOST_COEFFICIENTS + 1];
    let mut k = 1;
    while k <= MOST_COEFFICIENTS {
        inverse[k] = 1.0 / k as f64;
        k += 1;
    }
    inverse
};

/// 1/k, for k ≥ 1.
#[inline(always)]
fn inverse<S: Arithmetic>(k: usize) -> S {
    S::of(INVERSE[k])
}

/// σ/(k + 1): what turns a coefficient of ẋ into the next one of x.
#[inline(always)]
pub fn step<S: Scalar, K: Order>(k: K) -> S {
    S::from_f64(k.unit() * INVERSE[k.get() + 1])
}

/// σ/(k + 2): the same for the coefficient after that, if there is one.
#[inline(always)]
pub fn next_step<S: Scalar, K: Order>(k: K) -> S {
    S::from_f64(k.unit() * INVERSE[k.get() + 2])
}

/// Coefficient k of u + c.
#[inline(always)]
pub fn plus<S: Arithmetic, K: Order>(k: K, u: S, c: S) -> S {
    if k.get() == 0 { u + c } else { u }
}

/// Coefficient k of the constant c.
#[inline(always)]
pub fn constant<S: Scalar, K: Order>(k: K, c: S) -> S {
    if k.get() == 0 { c } else { S::from_f64(0.0) }
}

/// Coefficient k of the time, which is t at the start.
#[inline(always)]
pub fn time<S: Scalar, K: Order>(k: K, t: S) -> S {
    match k.get() {
        0 => t,
        1 => S::from_f64(k.unit()),
        _ => S::from_f64(0.0),
    }
}

/// Coefficient k of k uₖ, of h du/dh.
#[inline(always)]
pub fn derivative<S: Arithmetic, K: Order>(k: K, u: S) -> S {
    S::of(k.get() as f64) * u
}

/// A sum before term j, in parts of so many terms.
#[inline(always)]
fn in_parts<S: Scalar>(j: usize, length: usize, sum: S) -> S {
    if (j + 1).is_multiple_of(length) {
        sum.settled()
    } else {
        sum
    }
}

/// Coefficient k of uv from the [`inner_sums`] of u and v, and from u₀, uₖ, v₀ and vₖ.
#[inline(always)]
pub fn product_from<S: Arithmetic, K: Order>(
    k: K,
    [u0, uk]: [S; 2],
    [v0, vk]: [S; 2],
    sum: S,
) -> S {
    if k.get() == 0 {
        return uk * vk;
    }
    u0.times_plus(vk, uk.times_plus(v0, sum))
}

/// Coefficient k of u² from the [`half_sums`] of u, and from u₀, uₖ and the one of order ⌊k/2⌋.
#[inline(always)]
pub fn square_from<S: Arithmetic, K: Order>(k: K, [u0, uk]: [S; 2], middle: S, sum: S) -> S {
    if k.get() == 0 {
        return uk.square();
    }
    (u0 + u0).times_plus(uk, twice(k, middle, sum))
}

/// A sum of products uⱼ uₖ₋ⱼ from the terms with j < k/2 and the coefficient of order ⌊k/2⌋.
#[inline(always)]
fn twice<S: Arithmetic, K: Order>(k: K, middle: S, sum: S) -> S {
    if k.get().is_multiple_of(2) {
        S::of(2.0).times_plus(sum, middle.square())
    } else {
        sum + sum
    }
}

/// Coefficient k of u²/2 from the [`half_sums`] of u, and from u₀, uₖ and the one of order ⌊k/2⌋.
#[inline(always)]
pub fn half_square_from<S: Arithmetic, K: Order>(k: K, [u0, uk]: [S; 2], middle: S, sum: S) -> S {
    let half = S::of(0.5);
    if k.get() == 0 {
        return half * uk.square();
    }
    let is_even = k.get().is_multiple_of(2);
    u0.times_plus(
        uk,
        if is_even {
            (middle * half).times_plus(middle, sum)
        } else {
            sum
        },
    )
}

/// Coefficient k of w = u/v from uₖ, vₖ, w₀ and the [`inner_sums`] of v and w; `inverse` is 1/v₀.
#[inline(always)]
pub fn quotient_from<S: Arithmetic, K: Order>(k: K, u: S, v: S, first: S, inverse: S, sum: S) -> S {
    if k.get() == 0 {
        return u * inverse;
    }
    (-v).times_plus(first, u - sum) * inverse
}

/// The same where uₖ is known last.
#[inline(always)]
pub fn late_quotient_from<S: Arithmetic, K: Order>(
    k: K,
    u: S,
    v: S,
    first: S,
    inverse: S,
    sum: S,
) -> S {
    if k.get() == 0 {
        return u * inverse;
    }
    let rest = v.times_plus(-(first * inverse), -(sum * inverse));
    u.times_plus(inverse, rest)
}

/// Coefficient k ≥ 1 of w = √u from uₖ, the one of w of order ⌊k/2⌋ and the [`half_sums`] of w;
/// `inverse` is 1/(2w₀).
#[inline(always)]
pub fn square_root_from<S: Arithmetic, K: Order>(k: K, u: S, middle: S, inverse: S, sum: S) -> S {
    (u - twice(k, middle, sum)) * inverse
}

/// Coefficient k ≥ 1 of ∫ v du from uₖ, v₀ and the [`inner_sums`] of h du/dh and v.
#[inline(always)]
pub fn integral_from<S: Arithmetic, K: Order>(k: K, u: S, first: S, sum: S) -> S {
    u.times_plus(first, sum * inverse(k.get()))
}

/// Coefficient k ≥ 1 of w = u^a from uₖ, w₀ and the [`inner_sums`] of w and u, and of h dw/dh and u:
/// with a k Σ wⱼ uₖ₋ⱼ − (a + 1) Σ j wⱼ uₖ₋ⱼ; `inverse_base` is 1/u₀.
#[inline(always)]
pub fn power_from<S: Arithmetic, K: Order>(
    k: K,
    u: S,
    a: S,
    first: S,
    inverse_base: S,
    [sum, other]: [S; 2],
) -> S {
    let (k, one) = (k.get(), S::of(1.0));
    let terms = (a * S::of(k as f64)).times_plus(sum, -((a + one) * other));
    u.times_plus(
        a * first * inverse_base,
        terms * (inverse_base * inverse(k)),
    )
}

/// Coefficient k of uv. The newest coefficients enter last, so that the sum of the others need
/// not wait for them.
#[inline(always)]
pub fn product<S: Scalar, K: Order, const P: usize>(k: K, u: &[S; P], v: &[S; P]) -> S {
    product_from(k, ends(k, u), ends(k, v), inner(k, u, v))
}

/// Coefficient k of u².
#[inline(always)]
pub fn square<S: Scalar, K: Order, const P: usize>(k: K, u: &[S; P]) -> S {
    square_from(k, ends(k, u), u[k.get() / 2], half(k, u))
}

/// Coefficient k of u²/2.
#[inline(always)]
pub fn half_square<S: Scalar, K: Order, const P: usize>(k: K, u: &[S; P]) -> S {
    half_square_from(k, ends(k, u), u[k.get() / 2], half(k, u))
}

/// u₀ and uₖ
#[inline(always)]
fn ends<S: Scalar, K: Order, const P: usize>(k: K, u: &[S; P]) -> [S; 2] {
    [u[0], u[k.get()]]
}

/// Σ aⱼ bₖ₋ⱼ over 1 ≤ j < k
#[inline(always)]
fn inner<S: Scalar, K: Order, const P: usize>(k: K, a: &[S; P], b: &[S; P]) -> S {
    if k.get() < 2 {
        return S::from_f64(0.0);
    }
    if !K::IS_FIXED {
        return sums::single(&a[1..k.get()], &b[1..k.get()]);
    }
    let k = k.get();
    // from the middle on, so that what was computed last enters last and the sum of the others need
    // not wait for it
    let mut sum = S::from_f64(0.0);
    if k.is_multiple_of(2) {
        sum = a[k / 2] * b[k / 2];
    }
    for j in (1..k.div_ceil(2)).rev() {
        sum = a[j].fused(b[k - j], a[k - j].fused(b[j], in_parts(j, 4, sum)));
    }
    sum
}

/// Σ uⱼ uₖ₋ⱼ over 1 ≤ j < k/2; the newest coefficient enters last.
#[inline(always)]
fn half<S: Scalar, K: Order, const P: usize>(k: K, u: &[S; P]) -> S {
    let k = k.get().max(1);
    let last = (k - 1) / 2;
    if !K::IS_FIXED {
        return sums::single(&u[1..=last], &u[k - last..k]);
    }
    if last == 0 {
        return S::from_f64(0.0);
    }
    let mut sum = u[last] * u[k - last];
    for j in (1..last).rev() {
        sum = u[j].fused(u[k - j], in_parts(j, 8, sum));
    }
    sum
}

/// Coefficient k of w = u/v from uₖ; `inverse` is 1/v₀.
#[inline(always)]
pub fn quotient<S: Scalar, K: Order, const P: usize>(
    k: K,
    u: S,
    v: &[S; P],
    w: &[S; P],
    inverse: S,
) -> S {
    quotient_from(k, u, v[k.get()], w[0], inverse, inner(k, v, w))
}

/// Coefficient k ≥ 1 of w = √u from uₖ; `inverse` is 1/(2w₀).
#[inline(always)]
pub fn square_root<S: Scalar, K: Order, const P: usize>(k: K, u: S, w: &[S; P], inverse: S) -> S {
    square_root_from(k, u, w[k.get() / 2], inverse, half(k, w))
}

/// Coefficient k ≥ 1 of w = u^a from d = h dw/dh; `inverse` is 1/u₀.
#[inline(always)]
pub fn power<S: Scalar, K: Order, const P: usize>(
    k: K,
    u: &[S; P],
    a: S,
    [w, d]: [&[S; P]; 2],
    inverse: S,
) -> S {
    let sums = [inner(k, w, u), inner(k, d, u)];
    power_from(k, u[k.get()], a, w[0], inverse, sums)
}

/// Coefficient k ≥ 1 of ∫ v du from uₖ and d = h du/dh: of eᵘ with v = eᵘ, of sin u with v = cos u …
#[inline(always)]
pub fn integral<S: Scalar, K: Order, const P: usize>(k: K, u: S, d: &[S; P], v: &[S; P]) -> S {
    integral_from(k, u, v[0], inner(k, d, v))
}

/// Coefficient k ≥ 1 of w = ∫ du/v from uₖ and e = h dw/dh, where e₀ = 0 and `inverse` is 1/v₀: of
/// ln u with v = u, of atan u with v = 1 + u² …
#[inline(always)]
pub fn primitive<S: Scalar, K: Order, const P: usize>(
    k: K,
    u: S,
    v: &[S; P],
    e: &[S; P],
    inverse_divisor: S,
) -> S {
    let rest = inner(k, v, e) * (inverse_divisor * inverse(k.get()));
    u.fused(inverse_divisor, -rest)
}
