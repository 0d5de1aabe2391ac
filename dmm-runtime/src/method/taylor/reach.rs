//! Taylor steps to a time in one mode, whatever its guards do.

use super::Taylor;
use crate::arithmetic::Time;
use crate::arithmetic::linear::is_finite;
use crate::contract::Dynamics;
use crate::expansion::jet::Jet;
use crate::expansion::radius::OtherUnit;
use crate::level::Level;
use crate::method::{Cursor, Failure, StepFailure};
use crate::series::{Choice, MOST_COEFFICIENTS, Rolled, Unroll};

/// Steps under way.
pub(super) struct Reach<'a, D, const N: usize, const M: usize> {
    pub(super) method: &'a Taylor,
    pub(super) dynamics: &'a D,
    pub(super) cursor: &'a mut Cursor<N>,
    pub(super) to: f64,
    /// The unit of time of the coefficients.
    pub(super) unit: f64,
}

impl<D: Dynamics<f64, N, M>, const N: usize, const M: usize> Choice for Reach<'_, D, N, M> {
    type Output = Result<(), Failure>;

    fn with<const P: usize, U: Unroll>(self) -> Self::Output {
        if self.unit == 1.0 {
            self.run::<P, U>()
        } else {
            self.run::<MOST_COEFFICIENTS, Rolled>()
        }
    }
}

impl<D: Dynamics<f64, N, M>, const N: usize, const M: usize> Reach<'_, D, N, M> {
    fn run<const P: usize, U: Unroll>(self) -> Result<(), Failure> {
        let Self {
            method,
            dynamics,
            to,
            unit,
            ..
        } = self;
        let Cursor { time, state, .. } = &mut *self.cursor;
        let level = Level::enter(dynamics, *time, state, None);
        let mut jet = Jet::<D, U, N, M, P>::new(dynamics, method.order(), unit);
        let mut before = 0.0;
        while time.value < to {
            jet.expand(dynamics, time.value, &state.x);
            let wanted = match jet.step(dynamics, time.value, method.fraction(), before) {
                Ok(wanted) => wanted,
                Err(OtherUnit(unit)) => {
                    return Self { unit, ..self }.run::<MOST_COEFFICIENTS, Rolled>();
                }
            };
            let end = time.value + wanted;
            let next = Time::new(if end < to { end } else { to });
            let after = jet.after(state, next.since(*time));
            if next.value <= time.value || !is_finite(&after.x) {
                return Err(StepFailure::NotFinite.over(wanted));
            }
            let (displacement, how) = (after.x - state.x, (method.corrects_level(), true));
            *state = level.reached(dynamics, next, after, &displacement, how);
            (*time, before) = (next, wanted);
        }
        Ok(())
    }
}
