//! How fast steps may go: the rate 1/τ that a tolerance asks for at a point.
//!
//! With the Taylor coefficients cₖ of the solution there, of which the compiler makes
//! recurrences, and ‖c‖ measured against the size of each component, a step of order p over τ
//! leaves about ‖c_{p+1}‖ τ^{p+1}. The root test ‖cₖ‖^{1/k} is taken as the mean over k = p and
//! p + 1, so that it does not vanish with one coefficient:
//!
//! τ⁻² = (‖c_p‖^{2/p} + ‖c_{p+1}‖^{2/(p+1)})/2 · tol^{−2/(p+1)}.
//!
//! The size of a component is the largest that it has had, so that a zero of it does not ask for
//! short steps. Where everything has become small, near an equilibrium, that would allow steps in
//! which the scheme does not follow the solution at all. So no step is longer than a part of the
//! radius of convergence relative to the *present* size Σ |cⱼ| hʲ over j ≤ p of each component,
//! with the step h before.
//!
//! Where coefficients leave the range of doubles, they are taken in another unit of time; see
//! [`crate::expansion::radius`].

use crate::contract::{Dynamics, Vector};
use crate::expansion::radius::{LARGEST, MOST_UNITS, REST, SMALLEST, is_polynomial, unit_for};
use crate::series::InUnits;

/// Coefficients: enough for order 8.
pub(crate) const COEFFICIENTS: usize = 10;
/// The highest order that they are enough for: methods of higher order make steps of this one.
const MOST: usize = COEFFICIENTS - 2;
/// The part of the radius of convergence relative to the present sizes that a step may take.
const RESOLVED: f64 = 0.5;

/// The Taylor coefficients of a solution at a point, and the rate 1/τ that is asked for there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion<const N: usize> {
    pub(crate) rate: f64,
    /// Whether the state is zero and stays so, as far as doubles tell.
    pub(crate) is_at_rest: bool,
    /// Those of powers of h/σ, by component.
    pub(crate) coefficients: [[f64; COEFFICIENTS]; N],
    /// σ
    pub(crate) unit: f64,
}

/// A tolerance, for a scheme of order p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepSizeControl<const N: usize> {
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
struct Wanted {
    rate: f64,
    /// Whether some were lost to underflow or to overflow.
    is_lost: bool,
}

impl<const N: usize> StepSizeControl<N> {
    /// At the start of a segment of a run in which components have had these sizes.
    pub(crate) fn new(order: usize, tolerance: f64, sizes: &[f64]) -> Self {
        let order = order.min(MOST);
        Self {
            order,
            factor: tolerance.powf(-1.0 / (order + 1) as f64),
            size: Vector::from_fn(|i, _| sizes.get(i).copied().unwrap_or_default()),
            unit: 1.0,
        }
    }

    /// The largest size of each component so far.
    pub(crate) fn sizes(&self) -> &[f64] {
        self.size.as_slice()
    }

    /// The solution at (t, x), after a step over `before`, or 0; the rate is not finite where the
    /// field is not.
    pub(crate) fn expand<const M: usize, F: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &F,
        t: f64,
        x: &Vector<f64, N>,
        before: f64,
    ) -> Expansion<N> {
        let (mut wanted, mut coefficients) = self.in_units(dynamics, t, x);
        let sizes = coefficients.iter().flatten();
        if sizes.fold(0.0, |sum, c| sum + c.abs()) <= REST {
            return Expansion {
                rate: 0.0,
                is_at_rest: true,
                coefficients: coefficients.map(|c| {
                    let mut constant = [0.0; COEFFICIENTS];
                    constant[0] = c[0];
                    constant
                }),
                unit: self.unit,
            };
        }
        for _ in 0..MOST_UNITS {
            let unit = unit_for(self.unit / wanted.rate);
            if !wanted.is_lost || unit == self.unit {
                break;
            }
            self.unit = unit;
            (wanted, coefficients) = self.in_units(dynamics, t, x);
        }
        let by_tolerance = wanted.rate * self.factor;
        let by_radius = self.present_rate(&coefficients, before / self.unit) / RESOLVED;
        // NaN is kept
        let rate = if by_radius > by_tolerance {
            by_radius
        } else {
            by_tolerance
        };
        Expansion {
            rate: rate / self.unit,
            is_at_rest: false,
            coefficients,
            unit: self.unit,
        }
    }

    /// 1 over the radius of convergence relative to the present size of each component.
    fn present_rate(&self, c: &[[f64; COEFFICIENTS]; N], before: f64) -> f64 {
        let p = self.order;
        let mut rate = 0.0f64;
        if before == 0.0 {
            return rate;
        }
        for c in c {
            let below = c[..=p].iter().rev();
            let size = below.fold(0.0, |sum, c| sum * before + c.abs());
            let inverse = 1.0 / size;
            if !inverse.is_finite() {
                continue;
            }
            rate = rate.max((c[p + 1].abs() * inverse).powf(1.0 / (p + 1) as f64));
        }
        rate
    }

    /// The same in the unit of time, but for the tolerance.
    fn in_units<const M: usize, F: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &F,
        t: f64,
        x: &Vector<f64, N>,
    ) -> (Wanted, [[f64; COEFFICIENTS]; N]) {
        let p = self.order;
        let mut series = dynamics.series::<COEFFICIENTS>();
        for (component, &x) in series.as_mut().iter_mut().zip(x) {
            component[0] = x;
        }
        let unit = self.unit;
        for order in 0..=p {
            dynamics.advance(InUnits { order, unit }, t, &mut series);
        }
        let coefficients: [[f64; COEFFICIENTS]; N] = std::array::from_fn(|i| series.as_ref()[i]);
        let c = &coefficients[..];
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
        (Wanted { rate, is_lost }, coefficients)
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

    /// Lets sizes grow with the components. One that begins at or near zero counts as a part of
    /// what it changes by within the time in which the solution does.
    fn grow(&mut self, c: &[[f64; COEFFICIENTS]]) {
        const PART: f64 = 1e-3;
        /// Sizes this many times as large as the present ones are forgotten.
        const FORGOTTEN: f64 = 1e100;
        let time = self.time_of_change(c);
        let mut present = 0.0f64;
        for (size, c) in self.size.iter_mut().zip(c) {
            let later = c[1..].iter().rev();
            let change = later.fold(0.0, |sum, c| (sum + c.abs()) * time);
            // in this unit of time coefficients may be lost
            let change = if change.is_finite() { change } else { 0.0 };
            let now = c[0].abs().max(PART * change);
            *size = size.max(now).max(f64::MIN_POSITIVE);
            present = present.max(now / *size);
        }
        if present > 0.0 && present < 1.0 / FORGOTTEN {
            self.size *= present * FORGOTTEN;
        }
    }

    /// The time in which the slope of the solution changes, by the root test on the coefficients
    /// of each component relative to the first one; a unit of time for a straight line.
    fn time_of_change(&self, c: &[[f64; COEFFICIENTS]]) -> f64 {
        let mut rate = 0.0f64;
        for c in c {
            for k in 2..=self.order + 1 {
                let part = (c[k] / c[1]).abs();
                if part.is_finite() {
                    rate = rate.max(part.powf(1.0 / (k - 1) as f64));
                }
            }
        }
        let time = 1.0 / rate;
        if time.is_finite() { time } else { 1.0 }
    }
}
