//! The end of a step that meets no guard, and of a segment that is stopped there.

use super::crossing::Locator;
use super::map::OneStep;
use super::search::{Watches, active, advance, readings};
use super::segment::Segment;
use crate::arithmetic::Time;
use crate::contract::{Dynamics, Vector};
use crate::level::Level;
use crate::method::{Failure, Sink};

impl<Map: OneStep, Loc: Locator, S: Sink<N>, const N: usize> Segment<'_, Map, Loc, S, N> {
    /// Moves over `increment`, a step over `tau` that ends at `time`: outputs within it, the state
    /// on its level, the watches at its end. Whether the sink wishes to stop there.
    pub(super) fn conclude<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        watches: &mut Watches<D, N, M>,
        increment: &Vector<f64, N>,
        (tau, time): (f64, Time),
    ) -> Result<bool, Failure> {
        self.outputs(dynamics, tau, time)?;
        self.accept(dynamics, level, increment, tau, time)?;
        let state = &self.cursor.state;
        let values = readings::<N, M, D>(dynamics, time.value, &state.x);
        advance(watches, &values, true);
        Ok(self.sink.point(time, state).is_break())
    }

    /// Keeps what the segment goes on with after a stop.
    #[cold]
    pub(super) fn keep<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        watches: &Watches<D, N, M>,
    ) {
        self.cursor.active = active(dynamics, watches);
        self.cursor.level = Some(level.kept());
    }
}
