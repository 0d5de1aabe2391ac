//! The Taylor polynomial of a solution at a point, and of the switching functions along it.
//!
//! Where a solution moves much faster or slower than in a unit of time, its coefficients leave the
//! range of doubles: a rate of 10¹⁵ has 10³³⁰ as its power of 22. There the series are in another
//! unit of time, a power of two near the step.

use super::polynomial::{increment, inverse_exponent, inverse_root};
use super::{Coefficients, Order, Rolled, Unroll};
use crate::scalar::Scalar;
use crate::system::{Boundary, Flow, Vector};

/// The coefficients of g that bound it between the ends of a step.
pub(crate) const FIRST: usize = 6;

/// The coefficients of a flow's solution at a point, P of each component.
pub(crate) struct Jet<F: Flow<f64, N, M>, const N: usize, const M: usize, const P: usize> {
    order: usize,
    /// The unit of time of the coefficients, a power of two.
    unit: f64,
    /// 1/σ
    inverse: f64,
    solution: F::Series<P>,
    switching: <F::Boundary as Boundary<f64, N>>::Series<P>,
}

/// The solution's series as it advances.
struct Solution<'a, S: Scalar, F: Flow<S, N, M>, const N: usize, const M: usize, const P: usize> {
    flow: &'a F,
    t: S,
    series: &'a mut F::Series<P>,
    unit: f64,
}

impl<S: Scalar, F: Flow<S, N, M>, const N: usize, const M: usize, const P: usize> Coefficients
    for Solution<'_, S, F, N, M, P>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        self.flow.advance(k, self.t, self.series);
    }

    #[inline(always)]
    fn unit(&self) -> f64 {
        self.unit
    }
}

/// The solution's coefficients at (t, x) in a unit of time, those before number `end`.
#[inline(always)]
pub(crate) fn expand<S: Scalar, F, const N: usize, const M: usize, const P: usize>(
    flow: &F,
    (t, x): (S, &Vector<S, N>),
    series: &mut F::Series<P>,
    end: usize,
    unit: f64,
) where
    F: Flow<S, N, M>,
{
    for (component, &x) in series.as_mut().iter_mut().zip(x) {
        component[0] = x;
    }
    if is_rolled::<F::Unrolled>(unit) {
        return advance_in_units::<S, F, N, M, P>(flow, t, series, end, unit);
    }
    advance::<S, F, F::Unrolled, N, M, P>(flow, t, series, end, unit);
}

/// Whether straight-line code does not do.
#[inline(always)]
fn is_rolled<U: Unroll>(unit: f64) -> bool {
    U::EXACT && unit != 1.0
}

#[cold]
#[inline(never)]
fn advance_in_units<S: Scalar, F, const N: usize, const M: usize, const P: usize>(
    flow: &F,
    t: S,
    series: &mut F::Series<P>,
    end: usize,
    unit: f64,
) where
    F: Flow<S, N, M>,
{
    advance::<S, F, Rolled, N, M, P>(flow, t, series, end, unit);
}

#[inline(always)]
fn advance<S: Scalar, F, U: Unroll, const N: usize, const M: usize, const P: usize>(
    flow: &F,
    t: S,
    series: &mut F::Series<P>,
    end: usize,
    unit: f64,
) where
    F: Flow<S, N, M>,
{
    let mut solution = Solution {
        flow,
        t,
        series,
        unit,
    };
    U::run::<0, P, 1, _>(&mut solution, end);
}

/// The series of the switching functions as they advance.
struct Switching<'a, F: Flow<f64, N, M>, const N: usize, const M: usize, const P: usize> {
    flow: &'a F,
    t: f64,
    jet: &'a mut Jet<F, N, M, P>,
}

impl<F: Flow<f64, N, M>, const N: usize, const M: usize, const P: usize> Coefficients
    for Switching<'_, F, N, M, P>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        let Jet {
            solution,
            switching,
            ..
        } = &mut *self.jet;
        let states = &solution.as_ref()[..N];
        let boundary = self.flow.boundary();
        boundary.advance(k, self.t, states, switching);
    }

    #[inline(always)]
    fn unit(&self) -> f64 {
        self.jet.unit
    }
}

/// The first coefficients of every switching function of a flow.
type FirstSeries<S, F, const N: usize, const M: usize> =
    <<F as Flow<S, N, M>>::Boundary as Boundary<S, N>>::Series<FIRST>;

/// The same as they advance.
struct First<'a, S: Scalar, F: Flow<S, N, M>, const N: usize, const M: usize> {
    flow: &'a F,
    t: S,
    states: &'a [[S; FIRST]; N],
    series: FirstSeries<S, F, N, M>,
    unit: f64,
}

impl<S: Scalar, F: Flow<S, N, M>, const N: usize, const M: usize> Coefficients
    for First<'_, S, F, N, M>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        let boundary = self.flow.boundary();
        boundary.advance(k, self.t, self.states, &mut self.series);
    }

    #[inline(always)]
    fn unit(&self) -> f64 {
        self.unit
    }
}

/// How the series of a boundary advance.
type BoundaryUnrolled<S, F, const N: usize, const M: usize> =
    <<F as Flow<S, N, M>>::Boundary as Boundary<S, N>>::Unrolled;

/// The first coefficients of every switching function along a solution.
///
/// They are no part of the jet: what nobody reads of them is not even computed.
#[inline(always)]
pub(crate) fn first_switching<S: Scalar, F, const N: usize, const M: usize, const P: usize>(
    flow: &F,
    t: S,
    solution: &[[S; P]],
    unit: f64,
) -> FirstSeries<S, F, N, M>
where
    F: Flow<S, N, M>,
{
    // the unit enters by the time alone
    if F::Boundary::AUTONOMOUS || !is_rolled::<BoundaryUnrolled<S, F, N, M>>(unit) {
        first::<S, F, BoundaryUnrolled<S, F, N, M>, N, M, P>(flow, t, solution, unit)
    } else {
        first_in_units::<S, F, N, M, P>(flow, t, solution, unit)
    }
}

#[cold]
#[inline(never)]
fn first_in_units<S: Scalar, F, const N: usize, const M: usize, const P: usize>(
    flow: &F,
    t: S,
    solution: &[[S; P]],
    unit: f64,
) -> FirstSeries<S, F, N, M>
where
    F: Flow<S, N, M>,
{
    first::<S, F, Rolled, N, M, P>(flow, t, solution, unit)
}

#[inline(always)]
fn first<S: Scalar, F, U: Unroll, const N: usize, const M: usize, const P: usize>(
    flow: &F,
    t: S,
    solution: &[[S; P]],
    unit: f64,
) -> FirstSeries<S, F, N, M>
where
    F: Flow<S, N, M>,
{
    let states = std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            if k < P {
                solution[i][k]
            } else {
                S::from_f64(0.0)
            }
        })
    });
    let mut first = First::<S, F, N, M> {
        flow,
        t,
        states: &states,
        series: F::Boundary::series(),
        unit,
    };
    U::run::<0, FIRST, 0, _>(&mut first, FIRST);
    first.series
}

impl<F: Flow<f64, N, M>, const N: usize, const M: usize, const P: usize> Jet<F, N, M, P> {
    /// Room for the coefficients up to `order`, in a unit of time; those above stay zero.
    pub(crate) fn new(order: usize, unit: f64) -> Self {
        Self {
            order,
            unit,
            inverse: 1.0 / unit,
            solution: F::series(),
            switching: F::Boundary::series(),
        }
    }

    /// The unit of time of the coefficients.
    #[inline(always)]
    pub(crate) fn unit(&self) -> f64 {
        self.unit
    }

    /// A time in units.
    #[inline(always)]
    pub(crate) fn in_units(&self, time: f64) -> f64 {
        time * self.inverse
    }

    /// The solution's coefficients at (t, x).
    #[inline]
    pub(crate) fn expand(&mut self, flow: &F, t: f64, x: &Vector<f64, N>) {
        let end = self.order + 1;
        expand(flow, (t, x), &mut self.solution, end, self.unit);
    }

    /// See [`first_switching`].
    #[inline(always)]
    pub(crate) fn first_switching(&self, flow: &F, t: f64) -> FirstSeries<f64, F, N, M> {
        first_switching::<f64, F, N, M, P>(flow, t, self.coefficients(), self.unit)
    }

    /// All coefficients of every switching function.
    pub(crate) fn expand_switching(&mut self, flow: &F, t: f64) {
        let end = self.order + 1;
        Rolled::run::<0, P, 0, _>(&mut Switching { flow, t, jet: self }, end);
    }

    /// The coefficients of g.
    pub(crate) fn switching(&self, interface: usize) -> &[f64; P] {
        &self.switching.as_ref()[interface]
    }

    /// The step over `fraction` of the radius of convergence, which the root test on two
    /// coefficients estimates: not on the last ones, so that the step is known while these are
    /// computed, and the powers of it with them.
    ///
    /// Each component counts relative to |x₀| + |x₁| h with the step h `before`, so that neither
    /// its zeros nor its unit matter; where there was none, relative to the largest component.
    ///
    /// Where coefficients leave the range of doubles, they are expanded again, `from` the same
    /// point, in another unit of time.
    #[inline(always)]
    pub(crate) fn step(
        &mut self,
        flow: &F,
        from: (f64, &Vector<f64, N>),
        fraction: f64,
        before: f64,
    ) -> f64 {
        let order = self.decisive();
        if before == 0.0 {
            return self.first_step(flow, (from.0, *from.1), fraction);
        }
        let before = self.in_units(before);
        let (mut last, mut second) = (0.0f64, 0.0f64);
        for c in self.coefficients() {
            let size = c[0].abs() + c[1].abs() * before;
            let scale = 1.0 / size.max(f64::MIN_POSITIVE);
            last = last.max(c[order].abs() * scale);
            second = second.max(c[order - 1].abs() * scale);
        }
        // those of higher order are not, yet
        if !(last > SMALLEST_DECISIVE && last < LARGEST_DECISIVE) {
            return self.first_step(flow, (from.0, *from.1), fraction);
        }
        fraction * radius(order, last, second) * self.unit
    }

    /// The order of the later coefficient that decides on the step.
    #[inline(always)]
    fn decisive(&self) -> usize {
        let order = self.order();
        order - if order > 12 { 4 } else { 2 }
    }

    #[inline(always)]
    fn order(&self) -> usize {
        if F::Unrolled::EXACT {
            P - 1
        } else {
            self.order
        }
    }

    /// The step without one before, or where coefficients leave the range of doubles.
    ///
    /// They count relative to the largest component or, where that is next to nothing, to what the
    /// field makes of it in a unit of time. Where they overflow or underflow, those below decide
    /// on a unit of time; if they are lost in that too, they are left out. Coefficients that end
    /// are those of a polynomial.
    #[cold]
    fn first_step(&mut self, flow: &F, (t, x): (f64, Vector<f64, N>), fraction: f64) -> f64 {
        /// Each brings the unit nearer to the solution's by the powers of a few coefficients.
        const MOST_UNITS: u32 = 8;
        let order = self.order();
        let mut usable = self.usable();
        for _ in 0..MOST_UNITS {
            let Some(k) = usable.filter(|&k| k < order) else {
                break;
            };
            let unit = unit_for(self.time_scale(k));
            if unit == self.unit {
                break;
            }
            (self.unit, self.inverse) = (unit, 1.0 / unit);
            self.expand(flow, t, &x);
            usable = self.usable();
        }
        match usable {
            Some(usable) if usable == order => {
                fraction * self.radius_at(self.decisive()) * self.unit
            }
            Some(usable) => {
                for c in &mut self.solution.as_mut()[..N] {
                    c[usable + 1..].fill(0.0);
                }
                // the same tolerance by a lower order
                fraction.powf(order as f64 / usable as f64) * self.time_scale(usable)
            }
            None => f64::NAN,
        }
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

    /// What coefficients count relative to.
    fn size(&self) -> f64 {
        /// A state that changes by so many times its size in a unit of time is next to nothing.
        const NOTHING: f64 = 1e-100;
        let (size, change) = (self.largest(0), self.largest(1));
        match size > change * NOTHING {
            true => size,
            false => change.max(f64::MIN_POSITIVE),
        }
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
        units * self.unit
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

    /// xₖ by component.
    #[inline(always)]
    fn coefficients(&self) -> &[[f64; P]] {
        &self.solution.as_ref()[..N]
    }

    /// Σ xⱼ (h/σ)ʲ over j ≥ 1.
    #[inline(always)]
    pub(crate) fn increment(&self, h: f64) -> Vector<f64, N> {
        let h = self.in_units(h);
        let mut sum = Vector::<f64, N>::zeros();
        if h > LONGEST {
            return self.long_increment(h);
        }
        for (sum, series) in sum.iter_mut().zip(self.coefficients()) {
            *sum = increment(series, h);
        }
        sum
    }

    /// The same where powers of h overflow.
    #[cold]
    fn long_increment(&self, h: f64) -> Vector<f64, N> {
        let mut coefficients = self.coefficients().iter();
        Vector::from_fn(|_, _| {
            let Some([_, c @ ..]) = coefficients.next().map(|c| c.as_slice()) else {
                return f64::NAN;
            };
            h * c.iter().rev().fold(0.0, |sum, c| sum * h + c)
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
/// Powers of this up to the highest order are in range.
const LONGEST: f64 = 1e12;

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

/// The smaller of cₖ^(−1/k) for the last two coefficients.
#[inline(always)]
fn radius(order: usize, last: f64, second: f64) -> f64 {
    let last = inverse_root(last, inverse_exponent(order));
    let second = inverse_root(second, inverse_exponent(order - 1));
    if second < last { second } else { last }
}
