//! How the largest error so far grows.

use crate::fit::fitted_order;

/// Points of the curve in a decade.
const A_DECADE: i32 = 8;
/// Errors of single steps and of first transitions say nothing of growth.
const FIRST: f64 = 10.0;

/// The largest value so far, at arguments that grow by a factor.
#[derive(Clone, Debug)]
pub(super) struct Growth {
    points: Vec<(f64, f64)>,
    largest: f64,
    next: f64,
}

impl Growth {
    pub(super) fn new() -> Self {
        Self {
            points: Vec::new(),
            largest: 0.0,
            next: FIRST,
        }
    }

    /// The value at `n`, an ascending number of steps or transitions.
    #[inline]
    pub(super) fn offer(&mut self, n: f64, value: f64) {
        if value > self.largest || value.is_nan() {
            self.largest = value;
        }
        if n >= self.next {
            self.points.push((n, self.largest));
            self.next = n * 10f64.powf(1.0 / f64::from(A_DECADE));
        }
    }

    pub(super) fn largest(&self) -> f64 {
        self.largest
    }

    /// The exponent of the growth over the last two thirds of the decades.
    pub(super) fn exponent(&self) -> f64 {
        let late = self.points.get(self.points.len() / 3..).unwrap_or_default();
        let (n, values): (Vec<f64>, Vec<f64>) = late.iter().copied().unzip();
        fitted_order(&n, &values)
    }

    pub(super) fn points(&self) -> Vec<(f64, f64)> {
        self.points.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_of_a_root_is_a_half() {
        let mut growth = Growth::new();
        for n in 0..100_000 {
            growth.offer(f64::from(n), f64::from(n).sqrt());
        }
        assert!((growth.exponent() - 0.5).abs() < 1e-3);
        assert!(growth.points().len() < 40);
    }
}
