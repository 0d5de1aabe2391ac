//! What the latest steps tell of the next one.

use crate::arithmetic::Scalar;
use crate::contract::Vector;

/// Increments that are remembered.
const LENGTH: usize = 6;

/// The latest increments (or velocities) of steps that follow one another, the latest first.
#[derive(Clone, Copy, Debug)]
pub(super) struct History<const N: usize> {
    recent: [Vector<f64, N>; LENGTH],
    /// How many of them there are.
    known: usize,
}

impl<const N: usize> History<N> {
    /// At the start of a segment.
    pub(super) fn new() -> Self {
        Self {
            recent: [Vector::zeros(); LENGTH],
            known: 0,
        }
    }

    /// Whether predictions are as good as they become.
    #[inline]
    pub(super) fn is_full(&self) -> bool {
        self.known == LENGTH
    }

    /// The one that continues them: on the polynomial through the latest.
    #[inline]
    pub(super) fn predict(&self) -> Option<Vector<f64, N>> {
        let [a, b, c, d, e, f] = &self.recent;
        match self.known {
            0 => None,
            1 => Some(*a),
            2 => Some(a * 2.0 - b),
            3 => Some((a - b) * 3.0 + c),
            4 => Some((a + c) * 4.0 - b * 6.0 - d),
            5 => Some((a - d) * 5.0 - (b - c) * 10.0 + e),
            _ => {
                let earlier = (c * 20.0 - (b + d) * 15.0) + (e * 6.0 - f);
                // the latest last: it is what there is to wait for
                Some(a.zip_map(&earlier, |a, earlier| a.fused(6.0, earlier)))
            }
        }
    }

    /// Appends one.
    #[inline]
    pub(super) fn remember(&mut self, increment: Vector<f64, N>) {
        let [a, b, c, d, e, _] = self.recent;
        self.recent = [increment, a, b, c, d, e];
        self.known = (self.known + 1).min(LENGTH);
    }
}
