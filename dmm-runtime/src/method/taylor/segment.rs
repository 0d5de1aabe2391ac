//! What a segment of Taylor steps works with, and outputs along the series of a step.

use super::{Memory, Taylor};
use crate::arithmetic::{State, Time};
use crate::contract::Dynamics;
use crate::expansion::jet::Jet;
use crate::level::Level;
use crate::method::{Cursor, Sink};
use crate::series::Unroll;

/// A segment under way.
pub(super) struct Segment<'a, S, const N: usize> {
    pub(super) method: &'a Taylor,
    pub(super) cursor: &'a mut Cursor<N>,
    pub(super) until: f64,
    pub(super) memory: &'a mut Memory<N>,
    pub(super) sink: &'a mut S,
}

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// Serves the output times of a step over `tau` that ends at `end`.
    #[cold]
    #[inline(never)]
    pub(super) fn outputs_along<
        const P: usize,
        const M: usize,
        D: Dynamics<f64, N, M>,
        U: Unroll,
    >(
        &mut self,
        dynamics: &D,
        level: Level<N, M>,
        jet: &Jet<D, U, N, M, P>,
        here: Here<N>,
        (tau, end): (f64, Time),
    ) {
        let corrects = self.method.corrects_level();
        while let Some(t) = self.sink.next_output()
            && t <= end.value
        {
            let time = Time::new(t);
            let elapsed = time.since(here.time).max(0.0).min(tau);
            let state = jet.after(&here.state, elapsed);
            let state = level.reached(
                dynamics,
                time,
                state,
                &(state.x - here.state.x),
                (corrects, true),
            );
            self.sink.output(t, state.rounded());
        }
    }
}

/// Where the steps are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Here<const N: usize> {
    pub(super) time: Time,
    pub(super) state: State<N>,
    /// The size of the step before, or 0.
    pub(super) before: f64,
    /// How many there were.
    pub(super) steps: u64,
    /// How many are still made without a correction of the level.
    pub(super) free: f64,
}

impl<const N: usize> Here<N> {
    /// Where the cursor of a segment is, or what steps had there when they were stopped.
    #[inline(always)]
    pub(super) fn of<S>(segment: &mut Segment<'_, S, N>) -> Self {
        let goes_on = segment.cursor.level.is_some();
        let stopped = segment.memory.stopped.take().filter(|_| goes_on);
        Self {
            time: segment.cursor.time.by_numbers(),
            state: match stopped {
                Some(state) => state,
                None => segment.cursor.state.by_numbers(),
            },
            before: segment.memory.step,
            steps: 0,
            free: if goes_on { segment.memory.free } else { 0.0 },
        }
    }
}
