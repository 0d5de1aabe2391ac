//! How the largest error so far grows.

use crate::fit::fitted_order;

/// Points of the curve in a decade.
const A_DECADE: i32 = 8;
/// Errors of single steps and of first transitions say nothing of growth.
const FIRST: f64 = 10.0;

/// The largest value so far, at arguments that grow by a factor.
#[derive(Clone, Debug)]
pub struct Growth {
    points: Vec<(f64, f64)>,
    largest: f64,
    next: f64,
}

impl Default for Growth {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            largest: 0.0,
            next: FIRST,
        }
    }
}

impl Growth {
    /// The value at `n`, an ascending number of steps or transitions.
    #[inline]
    pub fn offer(&mut self, n: f64, value: f64) {
        if value > self.largest || value.is_nan() {
            self.largest = value;
        }
        if n >= self.next {
            self.points.push((n, self.largest));
            self.next = n * 10f64.powf(1.0 / f64::from(A_DECADE));
        }
    }

    /// The largest value.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The exponent of the growth over the last two thirds of the decades.
    pub fn exponent(&self) -> f64 {
        let late = self.points.get(self.points.len() / 3..).unwrap_or_default();
        let (n, values): (Vec<f64>, Vec<f64>) = late.iter().copied().unzip();
        fitted_order(&n, &values)
    }

    /// (n, the largest value up to n), eight in a decade.
    pub fn points(&self) -> Vec<(f64, f64)> {
        self.points.clone()
    }
}
