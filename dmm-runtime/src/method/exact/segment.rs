//! What a segment of the exact flow works with: the level of a state, and outputs.

use super::step_sizes::StepSizes;
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Vector};
use crate::level::Level;
use crate::method::{Cursor, Sink};

/// A segment under way.
pub(super) struct Segment<'a, S, const N: usize> {
    pub(super) corrects_level: bool,
    pub(super) cursor: &'a mut Cursor<N>,
    pub(super) sink: &'a mut S,
}

/// The level of a segment, taken when it is first asked for: the flow leaves it by rounding errors of
/// pairs of doubles, so that short segments do without.
pub(super) struct Entered<const N: usize, const M: usize> {
    /// Where the segment began.
    time: Time,
    state: State<N>,
    level: Option<Level<N, M>>,
}

impl<const N: usize, const M: usize> Entered<N, M> {
    /// At the start of a segment, or of one that goes on.
    #[inline(always)]
    pub(super) fn new<D: Dynamics<f64, N, M>>(dynamics: &D, cursor: &Cursor<N>) -> Self {
        let (time, state) = (cursor.time.by_numbers(), cursor.state.by_numbers());
        let kept = cursor.level.as_deref();
        Self {
            time,
            state,
            level: kept.map(|kept| Level::enter(dynamics, time, &state, Some(kept))),
        }
    }

    /// The level.
    #[cold]
    #[inline(never)]
    pub(super) fn level<D: Dynamics<f64, N, M>>(&mut self, dynamics: &D) -> &mut Level<N, M> {
        let enter = || Level::enter(dynamics, self.time, &self.state, None);
        self.level.get_or_insert_with(enter)
    }
}

impl<S: Sink<N>, const N: usize> Segment<'_, S, N> {
    /// The state put back on its level, if it has left it.
    #[inline(always)]
    pub(super) fn on_level<const M: usize, D: Dynamics<f64, N, M>>(
        &self,
        dynamics: &D,
        entered: &mut Entered<N, M>,
        time: Time,
        state: State<N>,
    ) -> Option<State<N>> {
        if !self.corrects_level {
            return None;
        }
        let level = entered.level(dynamics);
        let strays = level.strays(dynamics, time, &state);
        let put_back = || put_back(dynamics, level, time, state, &self.cursor.state.x);
        strays.then(put_back).flatten()
    }

    /// Serves the output times up to `end`, the end of a step.
    #[inline(always)]
    pub(super) fn outputs(&mut self, sizes: &mut StepSizes<N>, end: Time) {
        while let Some(t) = self.sink.next_output()
            && t <= end.value
        {
            let time = Time::new(t);
            let elapsed = time.since(self.cursor.time).max(0.0);
            let x = sizes.reach(&self.cursor.state, elapsed).rounded();
            self.sink.output(t, x);
        }
    }
}

/// The state on its level, if it has left that by the size of ψ's terms at present too; the step
/// started from `before`.
#[cold]
#[inline(never)]
fn put_back<const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
    dynamics: &D,
    level: &mut Level<N, M>,
    time: Time,
    state: State<N>,
    before: &Vector<f64, N>,
) -> Option<State<N>> {
    level.rescale(dynamics, time.value, &state);
    let strays = level.strays(dynamics, time, &state);
    strays.then(|| level.reached(dynamics, time, state, &(state.x - before), (true, true)))
}
