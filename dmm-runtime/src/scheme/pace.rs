//! How fast steps may go: the rate 1/τ that a tolerance asks for at a point.
//!
//! With the Taylor coefficients cₖ of the solution there, of which the compiler makes
//! recurrences, and ‖c‖ measured against the size of each component, a step of order p over τ
//! leaves about ‖c_{p+1}‖ τ^{p+1}. The root test ‖cₖ‖^{1/k} is taken as the mean over k = p and
//! p + 1, so that it does not vanish with one coefficient:
//!
//! τ⁻² = (‖c_p‖^{2/p} + ‖c_{p+1}‖^{2/(p+1)})/2 · tol^{−2/(p+1)}.
//!
//! Where coefficients leave the range of doubles, they are taken in another unit of time; see
//! [`crate::series::radius`].

use crate::series::InUnits;
use crate::series::radius::{LARGEST, MOST_UNITS, SMALLEST, is_polynomial, unit_for};
use crate::system::{Flow, Vector};

/// Coefficients: enough for order 8.
const COEFFICIENTS: usize = 10;

/// A tolerance, for a scheme of order p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pacer<const N: usize> {
    order: usize,
    /// tol^{−1/(p+1)}
    factor: f64,
    /// The largest size of each component so far.
    size: Vector<f64, N>,
    /// The unit of time of the coefficients.
    unit: f64,
}

/// What the coefficients at a point say.
#[derive(Clone, Copy, Debug)]
struct Pace {
    rate: f64,
    /// Whether some were lost to underflow or to overflow.
    is_lost: bool,
}

impl<const N: usize> Pacer<N> {
    /// At the start of a run.
    pub(crate) fn new(order: usize, tolerance: f64) -> Self {
        Self {
            order,
            factor: tolerance.powf(-1.0 / (order + 1) as f64),
            size: Vector::zeros(),
            unit: 1.0,
        }
    }

    /// The rate that is asked for at (t, x); not finite where the field is not.
    pub(crate) fn rate<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        t: f64,
        x: &Vector<f64, N>,
    ) -> f64 {
        let mut pace = self.in_units(flow, t, x);
        for _ in 0..MOST_UNITS {
            let unit = unit_for(self.unit / pace.rate);
            if !pace.is_lost || unit == self.unit {
                break;
            }
            self.unit = unit;
            pace = self.in_units(flow, t, x);
        }
        pace.rate / self.unit * self.factor
    }

    /// The same in the unit of time, but for the tolerance.
    fn in_units<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        t: f64,
        x: &Vector<f64, N>,
    ) -> Pace {
        let p = self.order;
        let mut series = F::series::<COEFFICIENTS>();
        for (component, &x) in series.as_mut().iter_mut().zip(x) {
            component[0] = x;
        }
        let unit = self.unit;
        for order in 0..=p {
            flow.advance(InUnits { order, unit }, t, &mut series);
        }
        let c = &series.as_ref()[..N];
        self.grow(c);
        let square = |k: usize| self.root(c, k, 2.0);
        let in_range = |&k: &usize| (SMALLEST..LARGEST).contains(&self.largest(c, k));
        // of a polynomial
        let ends = |k: usize| {
            let (last, next) = (self.largest(c, k), self.largest(c, k + 1));
            next == 0.0 && is_polynomial(k, last, self.smallest())
        };
        let (rate, is_lost) = match (1..=p + 1).rev().find(in_range) {
            Some(k) if k > p => ((0.5 * (square(p) + square(p + 1))).sqrt(), false),
            Some(k) if ends(k) && k == p => ((0.5 * square(p)).sqrt(), false),
            Some(k) if ends(k) => (0.0, false),
            // the highest order that is neither lost to underflow nor to overflow
            Some(k) => (self.root(c, k, 1.0), true),
            None if (1..=p + 1).all(|k| self.largest(c, k) == 0.0) => (0.0, false),
            None => (f64::NAN, false),
        };
        Pace { rate, is_lost }
    }

    /// The largest |cₖ| relative to the size of its component.
    fn largest(&self, c: &[[f64; COEFFICIENTS]], k: usize) -> f64 {
        let parts = c
            .iter()
            .zip(&self.size)
            .map(|(c, size)| (c[k] / size).abs());
        // a NaN must not be lost
        parts.fold(
            0.0,
            |largest, part| if part <= largest { largest } else { part },
        )
    }

    /// The smallest size of a component that is not always zero.
    fn smallest(&self) -> f64 {
        let sizes = self.size.iter().filter(|&&size| size > f64::MIN_POSITIVE);
        sizes.fold(f64::INFINITY, |smallest, &size| smallest.min(size))
    }

    /// ‖cₖ‖^{power/k}
    fn root(&self, c: &[[f64; COEFFICIENTS]], k: usize, power: f64) -> f64 {
        let largest = self.largest(c, k);
        if largest == 0.0 {
            return 0.0;
        }
        let parts = c
            .iter()
            .zip(&self.size)
            .map(|(c, size)| c[k] / size / largest);
        let square: f64 = parts.map(|part| part * part).sum();
        (largest * square.sqrt()).powf(power / k as f64)
    }

    /// Lets sizes grow with the components; one that begins at zero is as large as its slope
    /// makes it within the time in which the whole state changes.
    fn grow(&mut self, c: &[[f64; COEFFICIENTS]]) {
        let largest = |k: usize| c.iter().fold(0.0f64, |largest, c| largest.max(c[k].abs()));
        let begins = self.size.iter().any(|&size| size == 0.0);
        let time = match begins && largest(1) > 0.0 {
            true => largest(0) / largest(1),
            false => 0.0,
        };
        for (size, c) in self.size.iter_mut().zip(c) {
            let now = match *size == 0.0 {
                true => c[0].abs() + c[1].abs() * time,
                false => c[0].abs(),
            };
            *size = size.max(now).max(f64::MIN_POSITIVE);
        }
    }
}
