//! Time as a double-double, and the uniform grid of steps.
//!
//! A plain double loses two digits of phase by t = 10⁴; the unevaluated sum of two doubles
//! keeps the time of a transition to the last bit of its increment, however long the run.

use crate::scalar::Scalar;

/// a + b = s + e exactly, s the rounded sum (Knuth, TAOCP 2, 4.2.2, theorem B).
#[inline(always)]
pub(crate) fn two_sum<S: Scalar>(a: S, b: S) -> (S, S) {
    let s = a + b;
    let b_part = s - a;
    let a_part = s - b_part;
    (s, (a - a_part) + (b - b_part))
}

/// a·b = p + e exactly, barring overflow (Dekker 1971).
///
/// By splitting where the target has no fused multiply-add: there that is a library call.
#[inline]
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        let p = a * b;
        return (p, a.mul_add(b, -p));
    }
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let split = |v: f64| {
        let c = SPLITTER * v;
        let high = c - (c - v);
        (high, v - high)
    };
    let p = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

/// A point in time: the unevaluated sum of two doubles.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Time {
    /// The time as a double.
    pub value: f64,
    /// What is missing from it, at most a unit in its last place.
    pub remainder: f64,
}

impl Time {
    /// The double `value`.
    pub fn new(value: f64) -> Self {
        Self {
            value,
            remainder: 0.0,
        }
    }

    /// This time plus `delta`.
    #[inline]
    #[must_use]
    pub fn after(self, delta: f64) -> Self {
        let (sum, error) = two_sum(self.value, delta);
        let (value, remainder) = two_sum(sum, error + self.remainder);
        Self { value, remainder }
    }

    /// This time minus `earlier`, rounded once.
    #[inline]
    pub fn since(self, earlier: Self) -> f64 {
        let (difference, error) = two_sum(self.value, -earlier.value);
        difference + (error + (self.remainder - earlier.remainder))
    }
}

/// Uniform steps t_k = t₀ + kτ, the last one ending exactly at the end time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    start: f64,
    end: f64,
    /// τ
    pub(crate) step_size: f64,
    /// The number of steps.
    pub(crate) count: u64,
}

impl Grid {
    /// A last step that is shorter than this part of τ is joined to the one before.
    const NEGLIGIBLE: f64 = 1e-6;

    /// The grid from `start` to `end` with steps of `step_size` > 0.
    pub(crate) fn new(start: f64, end: f64, step_size: f64) -> Self {
        let steps = (end - start) / step_size;
        Self {
            start,
            end,
            step_size,
            count: match end > start {
                true => (steps - Self::NEGLIGIBLE).ceil().max(1.0) as u64,
                false => 0,
            },
        }
    }

    /// t_k as a double, within a unit in its last place: cheap, for formulas and output.
    #[inline]
    pub(crate) fn value(&self, k: u64) -> f64 {
        if k >= self.count {
            return self.end;
        }
        self.inner_value(k)
    }

    /// t_k of a node before the last.
    #[inline(always)]
    pub(crate) fn inner_value(&self, k: u64) -> f64 {
        self.start + k as f64 * self.step_size
    }

    /// The first node after `t`.
    pub(crate) fn node_after(&self, t: f64) -> u64 {
        let steps = ((t - self.start) / self.step_size).floor().max(0.0) as u64;
        let mut k = steps.saturating_sub(1);
        while k < self.count && self.value(k) <= t {
            k += 1;
        }
        k
    }

    /// t_k as a double-double around [`Grid::value`].
    #[cold]
    pub(crate) fn time(&self, k: u64) -> Time {
        let value = self.value(k);
        if k >= self.count {
            return Time::new(value);
        }
        let (product, error) = two_product(k as f64, self.step_size);
        let exact = Time::new(self.start).after(product).after(error);
        Time {
            value,
            remainder: exact.since(Time::new(value)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_product_and_two_sum_are_exact() {
        let (a, b) = (1.0 + 2f64.powi(-40), 1.0 + 2f64.powi(-41));
        assert_eq!(
            two_product(a, b),
            (1.0 + 2f64.powi(-40) + 2f64.powi(-41), 2f64.powi(-81))
        );
        assert_eq!(two_sum(1.0, 2f64.powi(-60)), (1.0, 2f64.powi(-60)));
    }

    #[test]
    fn the_grid_ends_at_the_end() {
        let grid = Grid::new(0.0, 1000.0, 1e-3);
        assert_eq!(grid.count, 1_000_000);
        assert_eq!(grid.time(grid.count), Time::new(1000.0));
        // 0.001 as a double is 2.08e-20 above 1/1000: half a million steps later the grid is
        // 1.04e-14 late, which is less than half a unit in the last place of 500
        let late = grid.time(500_000);
        assert_eq!(late.value, 500.0);
        assert!((late.remainder - 1.04e-14).abs() < 1e-16);
        assert_eq!(Grid::new(0.0, 1.05, 0.1).count, 11);
        assert_eq!(Grid::new(2.0, 2.0, 0.1).count, 0);
    }
}
