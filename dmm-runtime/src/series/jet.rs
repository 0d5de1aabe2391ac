//! The Taylor polynomial of a solution at a point, and of the switching functions along it.

use super::polynomial::{increment, inverse_exponent, inverse_root};
use super::{Coefficients, Order, Unroll};
use crate::scalar::Scalar;
use crate::system::{Boundary, Flow, Vector};

/// The coefficients of g that bound it between the ends of a step.
pub(crate) const FIRST: usize = 6;

/// The coefficients of a flow's solution at a point, P of each component.
pub(crate) struct Jet<F: Flow<f64, N, M>, const N: usize, const M: usize, const P: usize> {
    order: usize,
    solution: F::Series<P>,
    switching: <F::Boundary as Boundary<f64, N>>::Series<P>,
}

/// The solution's series as it advances.
struct Solution<'a, S: Scalar, F: Flow<S, N, M>, const N: usize, const M: usize, const P: usize> {
    flow: &'a F,
    t: S,
    series: &'a mut F::Series<P>,
}

impl<S: Scalar, F: Flow<S, N, M>, const N: usize, const M: usize, const P: usize> Coefficients
    for Solution<'_, S, F, N, M, P>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        self.flow.advance(k, self.t, self.series);
    }
}

/// The solution's coefficients at (t, x), those before number `end`.
#[inline(always)]
pub(crate) fn expand<S: Scalar, F, const N: usize, const M: usize, const P: usize>(
    flow: &F,
    t: S,
    x: &Vector<S, N>,
    series: &mut F::Series<P>,
    end: usize,
) where
    F: Flow<S, N, M>,
{
    for (component, &x) in series.as_mut().iter_mut().zip(x) {
        component[0] = x;
    }
    F::Unrolled::run::<0, P, 1, _>(&mut Solution { flow, t, series }, end);
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
}

impl<S: Scalar, F: Flow<S, N, M>, const N: usize, const M: usize> Coefficients
    for First<'_, S, F, N, M>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        let boundary = self.flow.boundary();
        boundary.advance(k, self.t, self.states, &mut self.series);
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
    };
    BoundaryUnrolled::<S, F, N, M>::run::<0, FIRST, 0, _>(&mut first, FIRST);
    first.series
}

impl<F: Flow<f64, N, M>, const N: usize, const M: usize, const P: usize> Jet<F, N, M, P> {
    /// Room for the coefficients up to `order`; those above stay zero.
    pub(crate) fn new(order: usize) -> Self {
        Self {
            order,
            solution: F::series(),
            switching: F::Boundary::series(),
        }
    }

    /// The solution's coefficients at (t, x).
    #[inline]
    pub(crate) fn expand(&mut self, flow: &F, t: f64, x: &Vector<f64, N>) {
        expand(flow, t, x, &mut self.solution, self.order + 1);
    }

    /// See [`first_switching`].
    #[inline(always)]
    pub(crate) fn first_switching(&self, flow: &F, t: f64) -> FirstSeries<f64, F, N, M> {
        first_switching::<f64, F, N, M, P>(flow, t, self.coefficients())
    }

    /// All coefficients of every switching function.
    pub(crate) fn expand_switching(&mut self, flow: &F, t: f64) {
        let end = self.order + 1;
        super::Rolled::run::<0, P, 0, _>(&mut Switching { flow, t, jet: self }, end);
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
    #[inline(always)]
    pub(crate) fn step(&mut self, fraction: f64, before: f64) -> f64 {
        let order = self.decisive();
        if before == 0.0 {
            return self.first_step(fraction);
        }
        let (mut last, mut second) = (0.0f64, 0.0f64);
        for c in self.coefficients() {
            let size = c[0].abs() + c[1].abs() * before;
            let scale = 1.0 / size.max(f64::MIN_POSITIVE);
            last = last.max(c[order].abs() * scale);
            second = second.max(c[order - 1].abs() * scale);
        }
        if !(last > SMALLEST && last < LARGEST) {
            return self.first_step(fraction);
        }
        fraction * radius(order, last, second)
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
    /// They count relative to the largest component or, where all vanish, to what the field
    /// makes of them in a unit of time. Where the unit of time is so far from that of the
    /// solution that they overflow or underflow, the orders below decide on a shorter step, and
    /// those that are lost are left out. Coefficients that end are those of a polynomial.
    #[cold]
    fn first_step(&mut self, fraction: f64) -> f64 {
        let largest = |k: usize| {
            let coefficients = self.coefficients().iter();
            // a NaN must not be lost
            coefficients.fold(0.0f64, |largest, c| match c[k].abs() {
                size if size <= largest => largest,
                size => size,
            })
        };
        let scale = 1.0
            / if largest(0) > 0.0 {
                largest(0)
            } else {
                largest(1).max(f64::MIN_POSITIVE)
            };
        let order = self.order();
        let in_range = |k: usize| (SMALLEST..LARGEST).contains(&(largest(k) * scale));
        let ends = (2..=order).rev().find(|&k| largest(k) != 0.0);
        let is_polynomial = ends.is_none_or(|k| {
            let components = self.coefficients().iter().map(|c| c[0].abs());
            let smallest = components
                .filter(|&size| size > 0.0)
                .fold(1.0 / scale, f64::min);
            k < order && is_polynomial(k, largest(k) * scale, smallest)
        });
        if is_polynomial || in_range(order) {
            let order = self.decisive();
            let step = radius(order, largest(order) * scale, largest(order - 1) * scale);
            return fraction * step;
        }
        let Some(usable) = (2..order)
            .find(|&k| !in_range(k + 1))
            .filter(|&k| in_range(k))
        else {
            return f64::NAN;
        };
        let step = radius(usable, largest(usable) * scale, largest(usable - 1) * scale);
        for c in &mut self.solution.as_mut()[..N] {
            c[usable + 1..].fill(0.0);
        }
        // the same tolerance by a lower order
        fraction.powf(order as f64 / usable as f64) * step
    }

    /// xₖ by component.
    #[inline(always)]
    fn coefficients(&self) -> &[[f64; P]] {
        &self.solution.as_ref()[..N]
    }

    /// Σ xⱼ hʲ over j ≥ 1.
    #[inline(always)]
    pub(crate) fn increment(&self, h: f64) -> Vector<f64, N> {
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
pub(crate) const SMALLEST: f64 = 1e-280;
pub(crate) const LARGEST: f64 = 1e280;
/// Powers of this up to the highest order are in range.
const LONGEST: f64 = 1e12;

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
