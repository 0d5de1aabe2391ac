//! The Taylor polynomial of a solution at a point, and of the switching functions along it.
//!
//! The coefficients are those of powers of h/σ, in a unit of time σ that is 1 unless they would
//! leave the range of doubles; see [`super::radius`].

use std::marker::PhantomData;
use std::sync::atomic::{Ordering, compiler_fence};

use super::polynomial::increment;
use crate::arithmetic::{Scalar, State, alone};
use crate::contract::{Dynamics, Guards, Vector};
use crate::series::{Coefficients, Order, Rolled, Unroll};

/// The coefficients of g that bound it between the ends of a step.
pub(crate) const FIRST: usize = 6;

/// The coefficients of the solution of a mode at a point, P of each component, which advance like U.
///
/// They lie at the start of a cache line, whatever else there is: by where they lie, a step of
/// straight-line code takes up to a fifth longer.
#[repr(C, align(64))]
pub(crate) struct Jet<F: Dynamics<f64, N, M>, U, const N: usize, const M: usize, const P: usize> {
    pub(super) solution: F::Series<P>,
    switching: <F::Guards as Guards<f64, N>>::Series<P>,
    order: usize,
    /// The unit of time of the coefficients, a power of two.
    unit: f64,
    /// 1/σ
    inverse: f64,
    unroll: PhantomData<U>,
}

/// The solution's series as it advances.
struct Solution<'a, S: Scalar, F: Dynamics<S, N, M>, const N: usize, const M: usize, const P: usize>
{
    dynamics: &'a F,
    t: S,
    series: &'a mut F::Series<P>,
    unit: f64,
}

impl<S: Scalar, F: Dynamics<S, N, M>, const N: usize, const M: usize, const P: usize> Coefficients
    for Solution<'_, S, F, N, M, P>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        // Consecutive coefficients lie side by side, and LLVM would join their recurrences in vectors,
        // which wait for the later one. It joins no stores across a fence, which is no instruction. Code
        // that is apart would load after a fence what it has just stored.
        if K::IS_FIXED
            && const { size_of::<S>() == size_of::<f64>() && !is_apart::<F::Series<P>>() }
        {
            compiler_fence(Ordering::Release);
        }
        self.dynamics.advance(k, self.t, self.series);
    }

    #[inline(always)]
    fn unit(&self) -> f64 {
        self.unit
    }
}

/// The solution's coefficients at (t, x) in a unit of time, those before number `end`.
#[inline(always)]
pub(crate) fn expand<S: Scalar, F, U: Unroll, const N: usize, const M: usize, const P: usize>(
    dynamics: &F,
    (t, x): (S, &Vector<S, N>),
    series: &mut F::Series<P>,
    end: usize,
    unit: f64,
) where
    F: Dynamics<S, N, M>,
{
    for (component, x) in series.as_mut().iter_mut().zip(x.as_slice()) {
        component[0] = alone(x);
    }
    let mut solution = Solution {
        dynamics,
        t,
        series,
        unit,
    };
    U::run::<0, P, 1, _>(&mut solution, end);
    // a coefficient that is known an order before the others would be one of a polynomial of its own
    // degree
    if const { !U::EXACT } && end < P {
        for component in &mut series.as_mut()[..N] {
            component[end] = S::from_f64(0.0);
        }
    }
}

/// The series of the switching functions as they advance.
struct Switching<'a, F: Dynamics<f64, N, M>, U, const N: usize, const M: usize, const P: usize> {
    dynamics: &'a F,
    t: f64,
    jet: &'a mut Jet<F, U, N, M, P>,
}

impl<F: Dynamics<f64, N, M>, U: Unroll, const N: usize, const M: usize, const P: usize> Coefficients
    for Switching<'_, F, U, N, M, P>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        let Jet {
            solution,
            switching,
            ..
        } = &mut *self.jet;
        let states = &solution.as_ref()[..N];
        let guards = self.dynamics.guards();
        guards.advance(k, self.t, states, switching);
    }

    #[inline(always)]
    fn unit(&self) -> f64 {
        self.jet.unit()
    }
}

/// The first coefficients of every guard of a mode.
pub(crate) type FirstSeries<S, F, const N: usize, const M: usize> =
    <<F as Dynamics<S, N, M>>::Guards as Guards<S, N>>::Series<FIRST>;

/// The same as they advance.
struct First<'a, S: Scalar, F: Dynamics<S, N, M>, const N: usize, const M: usize> {
    dynamics: &'a F,
    t: S,
    states: &'a [[S; FIRST]; N],
    series: FirstSeries<S, F, N, M>,
    unit: f64,
}

impl<S: Scalar, F: Dynamics<S, N, M>, const N: usize, const M: usize> Coefficients
    for First<'_, S, F, N, M>
{
    #[inline(always)]
    fn advance<K: Order>(&mut self, k: K) {
        let guards = self.dynamics.guards();
        guards.advance(k, self.t, self.states, &mut self.series);
    }

    #[inline(always)]
    fn unit(&self) -> f64 {
        self.unit
    }
}

/// How the series of the guards advance.
pub(crate) type GuardsUnrolled<S, F, const N: usize, const M: usize> =
    <<F as Dynamics<S, N, M>>::Guards as Guards<S, N>>::Unrolled;

/// Whether the code that computes these coefficients is there once, by a function of its own: it is so much
/// that it gains nothing by what goes before or follows.
const fn is_apart<Series>() -> bool {
    const MOST_INLINED: usize = 4096;
    size_of::<Series>() > MOST_INLINED
}

/// So many states are filled twice at no cost.
const FEW: usize = 8;

/// The first coefficients of a series; those that it has not are zero.
#[inline(always)]
fn first<S: Scalar, const P: usize>(series: &[S; P]) -> [S; FIRST] {
    let mut first = [S::from_f64(0.0); FIRST];
    let count = FIRST.min(P);
    first[..count].copy_from_slice(&series[..count]);
    first
}

/// The first coefficients of every switching function along a solution, in a unit of time.
///
/// They are no part of the jet: what is not read of them is not even computed.
#[inline(always)]
pub(crate) fn first_switching<S, F, U, const N: usize, const M: usize, const P: usize>(
    dynamics: &F,
    t: S,
    solution: &[[S; P]],
    unit: f64,
) -> FirstSeries<S, F, N, M>
where
    S: Scalar,
    F: Dynamics<S, N, M>,
    U: Unroll,
{
    let states = if const { N > FEW } {
        std::array::from_fn(|i| first(&solution[i]))
    } else {
        // a loop, as closures are not inlined for certain
        let mut states = [[S::from_f64(0.0); FIRST]; N];
        for i in 0..N {
            states[i] = first(&solution[i]);
        }
        states
    };
    let mut first = First::<S, F, N, M> {
        dynamics,
        t,
        states: &states,
        series: dynamics.guards().series(),
        unit,
    };
    U::run::<0, FIRST, 0, _>(&mut first, FIRST);
    first.series
}

impl<F: Dynamics<f64, N, M>, U: Unroll, const N: usize, const M: usize, const P: usize>
    Jet<F, U, N, M, P>
{
    /// Room for the coefficients up to `order`, in a unit of time; those above stay zero.
    pub(crate) fn new(dynamics: &F, order: usize, unit: f64) -> Self {
        Self {
            order,
            unit,
            inverse: 1.0 / unit,
            solution: dynamics.series(),
            switching: dynamics.guards().series(),
            unroll: PhantomData,
        }
    }

    /// The unit of time of the coefficients.
    #[inline(always)]
    pub(crate) fn unit(&self) -> f64 {
        if U::EXACT { 1.0 } else { self.unit }
    }

    /// A time in units.
    #[inline(always)]
    pub(crate) fn in_units(&self, time: f64) -> f64 {
        if U::EXACT { time } else { time * self.inverse }
    }

    /// Expands the solution at `t` once more, in another unit.
    pub(super) fn expand_in(&mut self, unit: f64, dynamics: &F, t: f64) {
        (self.unit, self.inverse) = (unit, 1.0 / unit);
        let x = Vector::from_fn(|i, _| self.coefficients()[i][0]);
        self.expand(dynamics, t, &x);
    }

    /// The solution's coefficients at (t, x).
    #[inline(always)]
    pub(crate) fn expand(&mut self, dynamics: &F, t: f64, x: &Vector<f64, N>) {
        if const { is_apart::<F::Series<P>>() } {
            self.expand_apart(dynamics, t, x);
        } else {
            self.expand_here(dynamics, t, x);
        }
    }

    /// The same by code that is there once.
    #[inline(never)]
    fn expand_apart(&mut self, dynamics: &F, t: f64, x: &Vector<f64, N>) {
        self.expand_here(dynamics, t, x);
    }

    #[inline(always)]
    fn expand_here(&mut self, dynamics: &F, t: f64, x: &Vector<f64, N>) {
        let end = self.order + 1;
        let unit = self.unit();
        expand::<f64, F, U, N, M, P>(dynamics, (t, x), &mut self.solution, end, unit);
    }

    /// See [`first_switching`].
    #[inline(always)]
    pub(crate) fn first_switching(&self, dynamics: &F, t: f64) -> FirstSeries<f64, F, N, M> {
        let (solution, unit) = (self.coefficients(), self.unit());
        // the unit enters by the time alone
        if U::EXACT || dynamics.guards().is_autonomous() {
            first_switching::<_, F, GuardsUnrolled<_, F, N, M>, N, M, P>(
                dynamics, t, solution, unit,
            )
        } else {
            first_switching::<_, F, Rolled, N, M, P>(dynamics, t, solution, unit)
        }
    }

    /// All coefficients of every switching function.
    pub(crate) fn expand_switching(&mut self, dynamics: &F, t: f64) {
        let end = self.order + 1;
        Rolled::run::<0, P, 0, _>(
            &mut Switching {
                dynamics,
                t,
                jet: self,
            },
            end,
        );
    }

    /// The coefficients of g.
    pub(crate) fn switching(&self, interface: usize) -> &[f64; P] {
        &self.switching.as_ref()[interface]
    }

    #[inline(always)]
    pub(super) fn order(&self) -> usize {
        if U::EXACT { P - 1 } else { self.order }
    }

    /// xₖ by component.
    #[inline(always)]
    pub(crate) fn coefficients(&self) -> &[[f64; P]] {
        &self.solution.as_ref()[..N]
    }

    /// The state h after `start`, whose coefficients these are: the increment is Σ xⱼ (h/σ)ʲ over j ≥ 1 and the
    /// remainder, whose sum has a rounding error that the increment has anyway.
    #[inline(always)]
    pub(crate) fn after(&self, start: &State<N>, h: f64) -> State<N> {
        let h = self.in_units(h);
        if h > LONGEST {
            return start.after(&self.long_increment(h)).normalised();
        }
        let mut increments = start.remainder;
        for (i, series) in self.coefficients().iter().enumerate() {
            increments[i] = increment(series, h, increments[i]);
            // LLVM would compute all components in one vector, and fill it one by one with what lies apart
            compiler_fence(Ordering::Release);
        }
        start.moved(&increments)
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

/// Powers of this up to the highest order are in range.
const LONGEST: f64 = 1e12;
