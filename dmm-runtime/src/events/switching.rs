//! A switching function along a path: its value and slope at a point, and enclosures on a part.

use super::Path;
use super::interval::Interval;
use crate::arithmetic::{Scalar, noise};
use crate::contract::{Guards, Vector};
use crate::expansion::jet::FIRST;
use crate::series::InUnits;

/// Coefficients that are enclosed: g, its slope, and those of order 2 to 4.
pub(super) const ENCLOSED: usize = 5;

/// The switching functions of a region along paths. What searches for their zeros is compiled for
/// this face of them, and not once for each system.
pub(crate) trait Switching<const N: usize> {
    /// g and dg/ds at a point of a path.
    fn point(&self, interface: usize, path: &Path<'_, N>, s: f64) -> (f64, f64);

    /// The coefficients of g at every point from `a` to `b`.
    fn enclosed(
        &self,
        interface: usize,
        path: &Path<'_, N>,
        a: f64,
        b: f64,
    ) -> [Interval; ENCLOSED];

    /// The rounding error of g at (t, x): of its terms, and of the state that it is taken at.
    fn noise(&self, interface: usize, t: f64, x: &Vector<f64, N>) -> f64;
}

/// A guards, over doubles and over intervals.
pub(crate) struct Enclosed<'a, B: Guards<f64, N>, const N: usize> {
    guards: &'a B,
    enclosing: B::Over<Interval>,
}

impl<'a, B: Guards<f64, N>, const N: usize> Enclosed<'a, B, N> {
    pub(crate) fn new(guards: &'a B) -> Self {
        Self {
            guards,
            enclosing: guards.over(),
        }
    }

    /// The first coefficients of g at the start of a path.
    pub(crate) fn first(&self, interface: usize, path: &Path<'_, N>) -> [f64; FIRST] {
        let states = path
            .coefficients
            .map(|c| std::array::from_fn(|k| c.get(k).copied().unwrap_or_default()));
        let time = (path.t0, path.unit);
        coefficients(self.guards, interface, time, &states, FIRST)
    }
}

/// The coefficients of g up to an order, from those of the state.
fn coefficients<S: Scalar, B: Guards<S, N>, const N: usize>(
    guards: &B,
    interface: usize,
    (t, unit): (S, f64),
    states: &[[S; FIRST]; N],
    count: usize,
) -> [S; FIRST] {
    let mut series = guards.series::<FIRST>();
    for order in 0..count {
        guards.advance(InUnits { order, unit }, t, states, &mut series);
    }
    series.as_ref()[interface]
}

impl<B: Guards<f64, N>, const N: usize> Switching<N> for Enclosed<'_, B, N> {
    fn point(&self, interface: usize, path: &Path<'_, N>, s: f64) -> (f64, f64) {
        let states = path.expanded(s);
        let time = (path.time(s), path.unit);
        let [value, slope, ..] = coefficients(self.guards, interface, time, &states, 2);
        (value, slope)
    }

    fn enclosed(
        &self,
        interface: usize,
        path: &Path<'_, N>,
        a: f64,
        b: f64,
    ) -> [Interval; ENCLOSED] {
        let states = path.enclosed(a, b);
        let t = Interval::new(path.time(a).next_down(), path.time(b).next_up());
        let time = (t, path.unit);
        let series = coefficients(&self.enclosing, interface, time, &states, ENCLOSED);
        std::array::from_fn(|k| series[k])
    }

    fn noise(&self, interface: usize, t: f64, x: &Vector<f64, N>) -> f64 {
        let mut size = self.guards.switching_size(interface, t, x);
        let (by_time, gradient) = self.guards.switching_gradient(interface, t, x);
        size += (by_time * t).abs();
        for (gradient, x) in gradient.iter().zip(x) {
            size += (gradient * x).abs();
        }
        noise(size)
    }
}
