//! One order after the other: as straight-line code, or in a loop.

use super::{InUnits, MOST_COEFFICIENTS, Order};

/// Something whose series advance by one order at a time.
pub trait Coefficients {
    /// Computes the coefficients of order `k`, from those below.
    fn advance<K: Order>(&mut self, k: K);

    /// Their unit of time.
    fn unit(&self) -> f64;
}

/// Something to be done with series of P coefficients.
pub trait Choice {
    /// What comes of it.
    type Output;

    /// Does it, with coefficients that advance like U.
    fn with<const P: usize, U: Unroll>(self) -> Self::Output;
}

/// How [`Coefficients`] advance.
pub trait Unroll {
    /// Whether there are P coefficients for the order P − 1 only, and not for lower ones too; and
    /// for the unit of time 1 only.
    const EXACT: bool = false;

    /// Does `choice` with room for the coefficients up to `order`.
    fn choose<C: Choice>(order: usize, choice: C) -> C::Output;

    /// Advances through the orders k with FROM ≤ k and k + LESS < TO; `end` takes the place of
    /// TO where it is lower. In a loop, unless said otherwise.
    #[inline(always)]
    fn run<const FROM: usize, const TO: usize, const LESS: usize, C: Coefficients>(
        series: &mut C,
        end: usize,
    ) {
        let unit = series.unit();
        let orders = FROM..end.min(TO) - LESS;
        // the first order apart: what the others do is not decided for each of them
        if FROM == 0 && orders.end > 0 {
            series.advance(InUnits { order: 0, unit });
        }
        for order in orders.start.max(1)..orders.end {
            series.advance(InUnits { order, unit });
        }
    }
}

/// A loop: for systems whose straight-line code would be too large.
#[derive(Clone, Copy, Debug)]
pub struct Rolled;

impl Unroll for Rolled {
    #[inline(always)]
    fn choose<C: Choice>(_order: usize, choice: C) -> C::Output {
        choice.with::<MOST_COEFFICIENTS, Self>()
    }
}

/// Straight-line code for each of a few orders, more than twice as fast; a loop where nothing
/// is optimised.
#[derive(Clone, Copy, Debug)]
pub struct Straight;

#[cfg(debug_assertions)]
impl Unroll for Straight {
    fn choose<C: Choice>(order: usize, choice: C) -> C::Output {
        Rolled::choose(order, choice)
    }
}

/// `series.advance(Fixed::<K>)` for every listed K in `FROM..TO − LESS`.
#[cfg(not(debug_assertions))]
macro_rules! orders {
    ($series:ident, $from:ident, $to:ident, $less:ident: $($k:literal)*) => {$(
        if const { $from <= $k && $k + $less < $to } {
            $series.advance(super::Fixed::<$k>);
        }
    )*};
}

#[cfg(not(debug_assertions))]
impl Unroll for Straight {
    const EXACT: bool = true;

    #[inline(always)]
    fn choose<C: Choice>(order: usize, choice: C) -> C::Output {
        match order {
            12 => choice.with::<13, Self>(),
            18 => choice.with::<19, Self>(),
            _ => choice.with::<MOST_COEFFICIENTS, Self>(),
        }
    }

    #[inline(always)]
    fn run<const FROM: usize, const TO: usize, const LESS: usize, C: Coefficients>(
        series: &mut C,
        _end: usize,
    ) {
        orders!(series, FROM, TO, LESS:
            0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22);
    }
}

/// Straight-line code for orders up to MOST in a build for a processor with vectors of four doubles and the
/// fused operation, and a loop otherwise: what comes near the size of the cache of instructions is slower
/// than a loop, and without them straight-line code is four times as long. There is room for no more
/// coefficients than the order has.
#[derive(Clone, Copy, Debug)]
pub struct Mixed<const MOST: usize>;

/// Whether straight-line code is short.
const HAS_VECTORS: bool = cfg!(all(target_feature = "avx2", target_feature = "fma"));

impl<const MOST: usize> Unroll for Mixed<MOST> {
    #[inline(always)]
    fn choose<C: Choice>(order: usize, choice: C) -> C::Output {
        match order {
            12 if const { HAS_VECTORS && MOST >= 12 } => choice.with::<13, Straight>(),
            12 => choice.with::<13, Rolled>(),
            18 if const { HAS_VECTORS && MOST >= 18 } => choice.with::<19, Straight>(),
            18 => choice.with::<19, Rolled>(),
            _ => Rolled::choose(order, choice),
        }
    }
}
