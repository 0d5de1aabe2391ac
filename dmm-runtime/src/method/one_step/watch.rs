//! What is remembered of an interface from step to step, and whether a step has to be looked at.
//!
//! The sign of g is turned so that g is positive inside the region. The parabola through the values
//! of g at the ends of a step and of the one before falls below the lower end of the step by an
//! eighth of the difference of both changes at most. Where steps resolve the solution and g follows
//! it, the dense output of a step is close to that: what stays four times as far away,
//! [`RESOLVED`], does not reach the interface. Every other step is looked at.

/// The part of the changes of g that a step may bridge where steps resolve the solution.
pub(crate) const RESOLVED: f64 = 0.5;
/// A reach that leads to a look at every step.
pub(crate) const UNRESOLVED: f64 = f64::INFINITY;

/// An interface at the start of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch {
    /// g at the start of the step, positive inside.
    value: f64,
    /// |Δg| of the step before.
    change: f64,
    /// Whether the step starts on the interface, just crossed or as the initial point.
    pub(crate) is_active: bool,
}

impl Watch {
    /// A watch over the interface from a point where g (positive inside) has `value`, or
    /// from a point on the interface if it `is_active`.
    pub(crate) fn new(value: f64, is_active: bool) -> Self {
        Self {
            value,
            change: f64::INFINITY,
            is_active,
        }
    }

    /// Moves on after a step of another size: nothing is known of how g changes.
    pub(crate) fn restart(&mut self) {
        self.change = f64::INFINITY;
    }

    /// Whether a step that ends at g = `end` has to be looked at: whether g comes nearer to zero
    /// than `reach` times the sum of its changes in this step and the one before.
    #[inline]
    #[allow(
        clippy::neg_cmp_op_on_partial_ord,
        reason = "a comparison with NaN is false"
    )]
    pub(crate) fn is_near(&self, end: f64, reach: f64) -> bool {
        let reach = reach * ((end - self.value).abs() + self.change);
        let lowest = if end < self.value { end } else { self.value };
        // not `lowest <= reach`, so that NaN is looked at too
        !(lowest > reach)
    }

    /// Moves on to a step that starts at g = `value`, after one that ended `near` the interface or
    /// not.
    #[inline]
    pub(crate) fn advance(&mut self, value: f64, near: bool) {
        self.change = (value - self.value).abs();
        self.value = value;
        // rounding may have left the point on the wrong side; away from it g is positive
        self.is_active = near && self.is_active && value <= 0.0;
    }
}
