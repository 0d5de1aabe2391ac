//! The radius of convergence that the coefficients of a solution show: the step over a part of it,
//! and the unit of time that they are told in.
//!
//! Where a solution moves much faster or slower than in a unit of time, its coefficients leave the
//! range of doubles: a rate of 10¹⁵ has 10³³⁰ as its power of 22. There σ is a power of two near
//! the radius, so that no coefficient is far from the state.

use super::jet::Jet;
use super::polynomial::inverse_root;
use crate::arithmetic::masked::{Mask, Masked};
use crate::series::Unroll;

use crate::contract::Dynamics;

/// The unit of time that coefficients are in range in, where they are not in the unit 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OtherUnit(pub(crate) f64);

impl<F: Dynamics<f64, N, M>, U: Unroll, const N: usize, const M: usize, const P: usize>
    Jet<F, U, N, M, P>
{
    /// The step over `fraction` of the radius of convergence, which the root test on two
    /// coefficients estimates: not on the last ones, so that the step is known while these are
    /// computed, and the powers of it with them.
    ///
    /// Each component counts relative to |x₀| + |x₁| h with the step h `before`, so that neither
    /// its zeros nor its unit matter; where there was none, relative to the largest component.
    ///
    /// Where coefficients leave the range of doubles, they are expanded again, at the same `t`, in
    /// another unit of time; straight-line code has none.
    #[inline(always)]
    pub(crate) fn step(
        &mut self,
        dynamics: &F,
        t: f64,
        fraction: f64,
        before: f64,
    ) -> Result<f64, OtherUnit> {
        let order = self.decisive();
        if before == 0.0 {
            return self.first_step(dynamics, t, fraction);
        }
        let before = self.in_units(before);
        let (last, second) = decisive_terms(self.coefficients(), order, before);
        // those of higher order are not, yet
        let is_large = !(last < LARGEST_DECISIVE && second < LARGEST_DECISIVE);
        if is_large || last <= SMALLEST_DECISIVE {
            return self.first_step(dynamics, t, fraction);
        }
        Ok(fraction * radius(order, last, second) * self.unit())
    }

    /// The order of the later coefficient that decides on the step.
    #[inline(always)]
    fn decisive(&self) -> usize {
        decisive(self.order())
    }

    /// The step without one before, or where coefficients leave the range of doubles.
    ///
    /// They count relative to the largest component or, where that is next to nothing, to what the
    /// field makes of it in a unit of time. Where they overflow or underflow, those below decide
    /// on a unit of time; if they are lost in that too, they are left out. Coefficients that end
    /// are those of a polynomial.
    #[cold]
    fn first_step(&mut self, dynamics: &F, t: f64, fraction: f64) -> Result<f64, OtherUnit> {
        let order = self.order();
        if (0..=order).all(|k| self.largest(k) <= REST) {
            for c in &mut self.solution.as_mut()[..N] {
                c[1..].fill(0.0);
            }
            return Ok(f64::INFINITY);
        }
        let mut usable = self.usable();
        for _ in 0..MOST_UNITS {
            let Some(k) = usable.filter(|&k| k < order) else {
                break;
            };
            let unit = unit_for(self.time_scale(k));
            if unit == self.unit() {
                break;
            }
            if U::EXACT {
                return Err(OtherUnit(unit));
            }
            self.expand_in(unit, dynamics, t);
            usable = self.usable();
        }
        Ok(match usable {
            Some(usable) if usable == order => {
                fraction * self.radius_at(self.decisive()) * self.unit()
            }
            Some(usable) => {
                for c in &mut self.solution.as_mut()[..N] {
                    c[usable + 1..].fill(0.0);
                }
                // the same tolerance by a lower order
                fraction.powf(order as f64 / usable as f64) * self.time_scale(usable)
            }
            None => f64::NAN,
        })
    }

    /// The highest order up to which coefficients are neither lost to overflow nor to underflow.
    fn usable(&self) -> Option<usize> {
        let order = self.order();
        let scale = 1.0 / self.size();
        let in_range = |k: usize| (SMALLEST..LARGEST).contains(&(self.largest(k) * scale));
        let ends = (1..=order).rev().find(|&k| self.largest(k) != 0.0);
        let is_polynomial = ends.is_none_or(|k| {
            let components = self.coefficients().iter().map(|c| c[0].abs());
            let smallest = components
                .filter(|&size| size > 0.0)
                .fold(1.0 / scale, f64::min);
            k < order && is_polynomial(k, self.largest(k) * scale, smallest)
        });
        if is_polynomial || in_range(order) {
            return Some(order);
        }
        let usable = (1..order).find(|&k| !in_range(k + 1));
        usable.filter(|&k| in_range(k))
    }

    /// What coefficients count relative to. Where a solution leaves the origin along a tangent of
    /// it, that is the first derivative that is not zero.
    fn size(&self) -> f64 {
        /// A state that changes by so many times its size in a unit of time is next to nothing.
        const NOTHING: f64 = 1e-100;
        let (size, change) = (self.largest(0), self.largest(1));
        if size > change * NOTHING {
            return size;
        }
        let mut changes = (1..=self.order()).map(|k| self.largest(k));
        let first = changes.find(|&change| change != 0.0);
        first.unwrap_or_default().max(f64::MIN_POSITIVE)
    }

    /// The radius of convergence by the coefficients of an order and the one below.
    fn radius_at(&self, order: usize) -> f64 {
        let scale = 1.0 / self.size();
        let (last, second) = (self.largest(order), self.largest(order - 1));
        radius(order, last * scale, second * scale)
    }

    /// About the time that the solution changes in, by coefficients up to `usable`.
    fn time_scale(&self, usable: usize) -> f64 {
        /// From zero to what leaves the range of doubles in its second derivative.
        const SUDDEN: f64 = 1e-100;
        let units = match (usable, self.largest(0)) {
            (1, 0.0) => SUDDEN,
            (1, size) => size / self.largest(1),
            _ => self.radius_at(usable),
        };
        units * self.unit()
    }

    /// The largest |xₖ| of a component.
    fn largest(&self, k: usize) -> f64 {
        let coefficients = self.coefficients().iter();
        // a NaN must not be lost
        coefficients.fold(0.0f64, |largest, c| match c[k].abs() {
            size if size <= largest => largest,
            size => size,
        })
    }
}

/// Coefficients relative to x₀ beyond these are about to leave the range of doubles.
pub(crate) const SMALLEST: f64 = 1e-200;
pub(crate) const LARGEST: f64 = 1e200;
/// Where those that decide on a step are beyond these, the ones of higher order may be.
pub(crate) const SMALLEST_DECISIVE: f64 = 1e-150;
pub(crate) const LARGEST_DECISIVE: f64 = 1e150;
/// The largest rate whose power of the highest order is in range.
pub(crate) const FASTEST: f64 = 1e9;

/// Where neither the state nor its derivatives are larger than this it is at rest: what they are
/// would soon be lost to underflow.
pub(crate) const REST: f64 = 1e-300;

/// The most units to try: each is nearer to the solution's by the powers of a few coefficients.
pub(crate) const MOST_UNITS: u32 = 8;

/// A unit of time for the coefficients of a solution that changes in `time`, whose powers are in
/// range: 1 if it will do, else a power of two.
pub(crate) fn unit_for(time: f64) -> f64 {
    if (1.0 / FASTEST..=FASTEST).contains(&time) || !time.is_normal() {
        return 1.0;
    }
    // its exponent
    f64::from_bits(time.to_bits() & f64::INFINITY.to_bits())
}

/// Whether a series that ends with order k, whose coefficient relative to the first one is `last`,
/// is a polynomial: had it gone on as before, the next coefficient of the component of size
/// `smallest`, and what it is computed from, would not have been lost to underflow.
pub(crate) fn is_polynomial(k: usize, last: f64, smallest: f64) -> bool {
    const LOST: f64 = 1e-200;
    smallest * last.powf((k + 1) as f64 / k as f64) > LOST
}

/// The coefficients of `order` and of the one below, each component's relative to |x₀| + |x₁| h with
/// the step h `before`: the largest.
#[inline(always)]
pub(crate) fn decisive_terms<S: Masked, const P: usize>(
    components: &[[S; P]],
    order: usize,
    before: S,
) -> (S, S) {
    /// Of a few terms LLVM knows that their maximum is a number, and of many it looks at each.
    const PART: usize = 4;
    let (few, others) = components.split_at(components.len().min(PART));
    let (mut last, mut second) = largest_terms(few, order, before);
    for part in others.chunks(PART) {
        let largest = largest_terms(part, order, before);
        last = last.max(largest.0);
        second = second.max(largest.1);
    }
    (last, second)
}

/// The same of a few components.
#[inline(always)]
fn largest_terms<S: Masked, const P: usize>(
    components: &[[S; P]],
    order: usize,
    before: S,
) -> (S, S) {
    let n = S::from_f64;
    let (mut last, mut second) = (n(0.0), n(0.0));
    for c in components {
        let size = c[0].abs() + c[1].abs() * before;
        let scale = n(1.0) / size.max(n(f64::MIN_POSITIVE));
        last = last.max(c[order].abs() * scale);
        second = second.max(c[order - 1].abs() * scale);
    }
    (last, second)
}

/// The order of the later coefficient that decides on a step of `order`.
#[inline(always)]
pub(crate) const fn decisive(order: usize) -> usize {
    order - if order > 12 { 4 } else { 2 }
}

/// The smaller of cₖ^(−1/k) for the last two coefficients.
#[inline(always)]
pub(crate) fn radius<S: Masked>(order: usize, last: S, second: S) -> S {
    let last = inverse_root(last, order);
    let second = inverse_root(second, order - 1);
    last.above(second).select(second, last)
}
