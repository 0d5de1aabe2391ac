//! The uniform grid of steps.

use crate::arithmetic::Time;
use crate::arithmetic::error_free::two_product;

/// Uniform steps t_k = t₀ + kτ, the last one ending exactly at the end time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    start: f64,
    pub(crate) end: f64,
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
            count: if end > start {
                (steps - Self::NEGLIGIBLE).ceil().max(1.0) as u64
            } else {
                0
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
