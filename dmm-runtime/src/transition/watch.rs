//! Watching an interface over a step: is it crossed, and between which times?
//!
//! The sign of g is turned so that g is positive inside the region. Signs at the ends of a
//! step are not enough: the solution may dip through the interface and come back within one
//! step, and it may touch the interface without crossing it. So where |g| is small against
//! its changes, the rates dg/dt at both ends decide whether g has a minimum in the step, and
//! the minimum decides.

use crate::scalar::Scalar;
use crate::scheme::OneStep;
use crate::statistics::Statistics;
use crate::system::{Boundary, Flow, Vector};
use crate::transition::Crossing;

/// What is remembered of an interface from step to step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch {
    /// g at the start of the step, positive inside.
    value: f64,
    /// |Δg| of the step before.
    change: f64,
    /// Whether the step starts on the interface, just crossed or as the initial point.
    fresh: bool,
}

/// What happens at an interface in a step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Outcome {
    /// Nothing.
    Inside,
    /// A tangential contact without change of region.
    Grazed,
    /// A crossing between these times after the start of the step.
    Crossed {
        /// g ≥ 0 here.
        lower: f64,
        /// g ≤ 0 here.
        upper: f64,
    },
}

impl Watch {
    /// Halvings of the step in search of the inside.
    const LARGEST_HALVINGS: i32 = 48;
    /// Bisections for the minimum of g.
    const LARGEST_BISECTIONS: u32 = 60;
    /// g this many rounding errors of its terms away from zero is not distinguished from it.
    const NOISE: f64 = 16.0;

    /// A watch over the interface from a point where g (positive inside) has `value`, or
    /// from a point on the interface if `fresh`.
    pub(crate) fn new(value: f64, fresh: bool) -> Self {
        Self {
            value,
            change: f64::INFINITY,
            fresh,
        }
    }

    /// Whether a step that ends at g = `end` needs a closer look. Without one the interface
    /// was not reached: |g| is larger than its changes can bridge.
    #[inline]
    #[allow(
        clippy::neg_cmp_op_on_partial_ord,
        reason = "a comparison with NaN is false"
    )]
    pub(crate) fn is_near(&self, end: f64) -> bool {
        let reach = 2.0 * ((end - self.value).abs() + self.change);
        let lowest = if end < self.value { end } else { self.value };
        // not `lowest <= reach`, so that NaN gets a closer look too
        !(lowest > reach)
    }

    /// Moves on to a step that starts at g = `value`, after one that ended `near` the interface or
    /// not.
    #[inline]
    pub(crate) fn advance(&mut self, value: f64, near: bool) {
        self.change = (value - self.value).abs();
        self.value = value;
        // rounding may have left the point on the wrong side; away from it g is positive
        self.fresh = near && self.fresh && value <= 0.0;
    }

    /// Looks closely at a step over `crossing.upper` from its state.
    #[cold]
    pub(crate) fn examine<Sch: OneStep, const N: usize, const M: usize, F: Flow<f64, N, M>>(
        &self,
        crossing: &Crossing<'_, Sch, F, N>,
        increment: &Vector<f64, N>,
        statistics: &mut Statistics,
    ) -> Option<Outcome> {
        let tau = crossing.upper;
        let (end, rate) = value_and_rate(crossing, tau, increment);
        if !end.is_finite() {
            return None;
        }
        let (_, start_rate) = value_and_rate(crossing, 0.0, &Vector::zeros());
        let noise = Self::noise(crossing, tau, increment);
        // on the interface, which the step began on, no further out than there
        let leaving = self.fresh && end > 2.0 * self.value.min(0.0);
        if rate > 0.0 && (end > -noise || leaving) {
            return if start_rate < 0.0 {
                Self::dip(crossing, noise, statistics)
            } else {
                Some(Outcome::Inside)
            };
        }
        if end > 0.0 {
            return Some(Outcome::Inside);
        }
        // g touches zero at the end of the step: its minimum is rate²/(2 d²g/dt²) below
        let bend = (rate - start_rate) / tau;
        if end > -noise && bend > 0.0 && rate * rate < 2.0 * bend * noise {
            return Some(Outcome::Grazed);
        }
        if !self.fresh {
            return Some(Outcome::Crossed {
                lower: 0.0,
                upper: tau,
            });
        }
        // starts on the interface and ends beyond it: it was inside in between, if not for long
        for halving in 1..=Self::LARGEST_HALVINGS {
            let middle = tau * 0.5f64.powi(halving);
            let at_middle = crossing.increment::<M>(middle, statistics).ok()?;
            let (value, ..) = crossing.switching(middle, &at_middle);
            if value > 0.0 {
                return Some(Outcome::Crossed {
                    lower: middle,
                    upper: 2.0 * middle,
                });
            }
        }
        // an excursion that no point resolves
        (end > -noise).then_some(Outcome::Grazed)
    }

    /// g falls at the start and rises at the end: how deep is its minimum?
    fn dip<Sch: OneStep, const N: usize, const M: usize, F: Flow<f64, N, M>>(
        crossing: &Crossing<'_, Sch, F, N>,
        noise: f64,
        statistics: &mut Statistics,
    ) -> Option<Outcome> {
        let (mut falling, mut rising) = (0.0, crossing.upper);
        let mut lowest = f64::INFINITY;
        for _ in 0..Self::LARGEST_BISECTIONS {
            let middle = 0.5 * (falling + rising);
            if middle <= falling || middle >= rising {
                break;
            }
            let increment = crossing.increment::<M>(middle, statistics).ok()?;
            let (value, rate) = value_and_rate(crossing, middle, &increment);
            if value < -noise {
                return Some(Outcome::Crossed {
                    lower: falling,
                    upper: middle,
                });
            }
            // the rest of the dip cannot reach the interface
            if value > noise + rate.abs() * (rising - falling) {
                return Some(Outcome::Inside);
            }
            lowest = lowest.min(value);
            if rate < 0.0 {
                falling = middle;
            } else {
                rising = middle;
            }
        }
        Some(if lowest > noise {
            Outcome::Inside
        } else {
            Outcome::Grazed
        })
    }

    /// The rounding error of g: of its terms, and of the state that it is taken at.
    fn noise<Sch: OneStep, const N: usize, const M: usize, F: Flow<f64, N, M>>(
        crossing: &Crossing<'_, Sch, F, N>,
        elapsed: f64,
        increment: &Vector<f64, N>,
    ) -> f64 {
        let (t, x) = (crossing.t0 + elapsed, crossing.state.x + increment);
        let boundary = crossing.flow.boundary();
        let mut size = boundary.switching_size(crossing.interface, t, &x);
        let (_, gradient) = boundary.switching_gradient(crossing.interface, t, &x);
        for i in 0..N {
            size += gradient[i].abs() * (crossing.state.x[i].abs() + increment[i].abs());
        }
        Self::NOISE * f64::ROUNDING * size
    }
}

/// g and dg/dt = ∂ₜg + ∇g·f, positive inside and inwards.
fn value_and_rate<Sch: OneStep, const N: usize, const M: usize, F: Flow<f64, N, M>>(
    crossing: &Crossing<'_, Sch, F, N>,
    elapsed: f64,
    increment: &Vector<f64, N>,
) -> (f64, f64) {
    let (value, rate, gradient) = crossing.switching(elapsed, increment);
    let field = crossing
        .flow
        .vector_field(crossing.t0 + elapsed, &(crossing.state.x + increment));
    (value, rate + gradient.dot(&field))
}
