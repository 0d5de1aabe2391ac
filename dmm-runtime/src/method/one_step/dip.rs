//! A convex switching function that falls at the start of a step and rises at its end: how deep is
//! its minimum on the one-step map?
//!
//! The dense output differs from the map by a power of the step, which is more than the rounding
//! error that decides between a touch and two crossings. There is one minimum, and bisection for
//! the sign of dg/dt finds it on the map itself.

use super::crossing::Crossing;
use super::map::OneStep;
use crate::contract::Dynamics;
use crate::events::cubic::Reading;
use crate::method::Statistics;

/// Bisections for the minimum of g.
const MOST_BISECTIONS: u32 = 60;

/// The minimum of g in a step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Dip {
    /// It is positive.
    Inside,
    /// It is zero within rounding errors.
    Touch,
    /// It is negative, so that g falls through zero between these times after the start.
    Crossed {
        /// g ≥ 0 here.
        lower: f64,
        /// g ≤ 0 here.
        upper: f64,
    },
}

impl<Map: OneStep, F, const N: usize> Crossing<'_, Map, F, N> {
    /// The minimum of g, whose rounding error is `noise`; nothing if a step cannot be made.
    pub(crate) fn dip<const M: usize>(&self, noise: f64, statistics: &mut Statistics) -> Option<Dip>
    where
        F: Dynamics<f64, N, M>,
    {
        let (mut falling, mut rising) = (0.0, self.upper);
        let mut lowest = f64::INFINITY;
        for _ in 0..MOST_BISECTIONS {
            let middle = f64::midpoint(falling, rising);
            if middle <= falling || middle >= rising {
                break;
            }
            let Reading { value, rate } = self.reading::<M>(middle, statistics)?;
            if value < -noise {
                return Some(Dip::Crossed {
                    lower: falling,
                    upper: middle,
                });
            }
            // the rest of the dip cannot reach the interface
            if value > noise + rate.abs() * (rising - falling) {
                return Some(Dip::Inside);
            }
            lowest = lowest.min(value);
            if rate < 0.0 {
                falling = middle;
            } else {
                rising = middle;
            }
        }
        Some(if lowest > noise {
            Dip::Inside
        } else {
            Dip::Touch
        })
    }
}
