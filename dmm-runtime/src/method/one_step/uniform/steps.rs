//! The loop over uniform steps: full ones, and those to and from transitions.

use super::super::crossing::Locator;
use super::super::grid::Grid;
use super::super::map::{OneStep, Step};
use super::super::resolution::Resolution;
use super::super::search::{Dense, Watches, advance, is_near, readings, through_ends};
use super::super::segment::{Segment, restore};
use super::super::watch::Watch;
use super::Memory;
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, Vector};
use crate::events::Path;
use crate::events::ends::Decay;
use crate::level::{Level, RESCALING};
use crate::method::{Ended, Failure, Sink, Statistics, StepFailure};

/// Steps between looks at whether they resolve the solution.
const LOOKS: u64 = 64;
/// The coefficients of g along the cubic through the ends of a step fall off like powers of this.
const CUBIC_DECAY: f64 = 0.5;

/// Uniform steps under way.
pub(super) struct Steps<'a, Map: OneStep, Loc, S, const N: usize> {
    pub(super) segment: Segment<'a, Map, Loc, S, N>,
    pub(super) memory: &'a mut Memory<Map::Memory<N>>,
}

impl<Map: OneStep, Loc: Locator, S: Sink<N>, const N: usize> Steps<'_, Map, Loc, S, N> {
    /// Full steps, until the last node but one or whatever ends the segment.
    ///
    /// The state is a local variable, and the time is computed where it is used: the clock of
    /// autonomous dynamics that are not observed costs nothing.
    pub(super) fn full_steps<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &mut Level<N, M>,
        watches: &mut Watches<D, N, M>,
    ) -> Result<Option<Ended>, Failure> {
        let grid = self.memory.grid;
        let corrects_level = self.segment.corrects_level;
        let map = self.segment.map;
        let kept = self.memory.map.take();
        let mut memory = kept.unwrap_or_else(|| map.begin(dynamics, Some(grid.step_size)));
        let mut counts = Statistics::default();
        let mut state = self.segment.cursor.state;
        let mut node = self.memory.node;
        let mut watching = watches.clone();
        let mut resolution = Resolution::default();
        let mut reach = resolution.reach(
            dynamics,
            (self.segment.cursor.time.value, &state.x),
            grid.step_size,
        );
        // the last state known to be finite, where not every one is checked
        let mut finite = (state, node);
        let end = loop {
            if node >= grid.count {
                break Ok(None);
            }
            // up to the next correction; apart from what is seldom done, so that what steps work
            // with stays in registers
            let mask = Map::correction_interval(&memory) - 1;
            let due = (node + mask) & !mask;
            let last = due.min(grid.count - 1);
            let stride = loop {
                let (t0, t1) = (grid.inner_value(node - 1), grid.inner_value(node));
                // telescoping sums need the very times that ψ(t, x) is evaluated at
                let tau = if dynamics.is_autonomous() {
                    grid.step_size
                } else {
                    t1 - t0
                };
                let step = Step {
                    dynamics,
                    t0,
                    x0: &state.x,
                    tau,
                };
                let increment = match map.full_step(&step, &mut memory, &mut counts) {
                    Ok(increment) => increment,
                    Err(failure) => break Err(failure),
                };
                let next = state.after(&increment);
                let values = readings::<N, M, D>(dynamics, t1, &next.x);
                let near = is_near(&watching, &values, reach);
                if near || S::LISTENS || node == last || self.has_output(t1) {
                    break Ok((tau, increment, next, values, near));
                }
                advance(&mut watching, &values, false);
                state = next;
                node += 1;
            };
            let (tau, increment, mut next, mut values, near) = match stride {
                Ok(stride) => stride,
                Err(failure) => break Err(failure),
            };
            let corrects = node == due;
            if (S::LISTENS || corrects) && !is_finite(&next.x) {
                (state, node) = if S::LISTENS { (state, node) } else { finite };
                break Err(StepFailure::NotFinite);
            }
            let t1 = grid.inner_value(node);
            if near || self.has_output(t1) {
                self.settle(dynamics, state, node, &mut counts);
                watches.clone_from(&watching);
                if near
                    && let Some(end) = self.look_at(dynamics, level, watches, tau, &increment)?
                {
                    return Ok(Some(end));
                }
                let end = self.memory.time(node, dynamics.is_autonomous());
                self.segment.outputs(dynamics, tau, end)?;
            }
            if corrects {
                next = if corrects_level {
                    on_level(map, dynamics, level, (state, increment), (grid, node))
                } else {
                    next.normalised()
                };
                // ψ may leave the range of doubles where the state does not
                if !is_finite(&next.x) {
                    break Err(StepFailure::NotFinite);
                }
                finite = (next, node + 1);
                values = readings::<N, M, D>(dynamics, t1, &next.x);
                if node.is_multiple_of(LOOKS) {
                    reach = resolution.reach(dynamics, (t1, &next.x), grid.step_size);
                }
            }
            advance(&mut watching, &values, near);
            state = next;
            node += 1;
            if self.segment.sink.point(Time::new(t1), &state).is_break() {
                self.memory.map = Some(memory);
                break Ok(Some(Ended::Stopped));
            }
        };
        self.settle(dynamics, state, node, &mut counts);
        *watches = watching;
        end.map_err(|failure| failure.over(grid.step_size))
    }

    /// A step that is not a full one, from a transition to the next node or to the end time.
    pub(super) fn partial_step<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        watches: &mut Watches<D, N, M>,
    ) -> Result<Option<Ended>, Failure> {
        if self.memory.node > self.memory.grid.count {
            return Ok(Some(Ended::Finished));
        }
        let end = self.memory.time(self.memory.node, dynamics.is_autonomous());
        let tau = end.since(self.segment.cursor.time);
        // zero where a transition was at this node, negative where a locator moved it beyond
        let mut stops = false;
        if tau > 0.0 {
            let step = Step {
                dynamics,
                t0: self.segment.cursor.time.value,
                x0: &self.segment.cursor.state.x,
                tau,
            };
            let increment = (self.segment.map)
                .step(&step, self.segment.sink.statistics())
                .map_err(|failure| failure.over(tau))?;
            if let Some(end) = self.look_at(dynamics, level, watches, tau, &increment)? {
                return Ok(Some(end));
            }
            let end = (tau, end);
            stops = (self.segment).conclude(dynamics, level, watches, &increment, end)?;
            watches.as_mut().iter_mut().for_each(Watch::restart);
        }
        self.memory.node += 1;
        self.memory.at_node = tau >= 0.0;
        Ok(stops.then_some(Ended::Stopped))
    }

    /// Looks at the guards over a step along the cubic through its ends.
    #[cold]
    fn look_at<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        level: &Level<N, M>,
        watches: &Watches<D, N, M>,
        tau: f64,
        increment: &Vector<f64, N>,
    ) -> Result<Option<Ended>, Failure> {
        if watches.as_ref().is_empty() {
            return Ok(None);
        }
        let step = self.segment.step(dynamics, tau);
        let t0 = step.t0;
        let coefficients = through_ends(self.segment.map, &step, increment);
        let dense = Dense {
            path: Path {
                t0,
                unit: 1.0,
                coefficients: std::array::from_fn(|i| &coefficients[i][..]),
            },
            tau,
            decay: Decay::new(CUBIC_DECAY),
        };
        let step_size = self.memory.grid.step_size;
        let end = (self.segment).look(dynamics, level, watches, &dense, step_size)?;
        if end.is_some() {
            self.memory.at_node = false;
        }
        Ok(end)
    }

    /// Whether an output is wanted at a time up to `end`.
    #[inline(always)]
    fn has_output(&self, end: f64) -> bool {
        self.segment.sink.next_output().is_some_and(|t| t <= end)
    }

    /// Writes the local variables of [`Steps::full_steps`] back: the cursor is at `state` at the
    /// node before `node`.
    #[cold]
    fn settle<const M: usize, D: Dynamics<f64, N, M>>(
        &mut self,
        dynamics: &D,
        state: State<N>,
        node: u64,
        counts: &mut Statistics,
    ) {
        self.segment.cursor.state = state;
        self.segment.cursor.time = self.memory.time(node - 1, dynamics.is_autonomous());
        let statistics = self.segment.sink.statistics();
        statistics.steps += node - self.memory.node;
        *statistics += std::mem::take(counts);
        self.memory.node = node;
    }
}

/// The state after an increment, put back on its level.
#[inline(never)]
fn on_level<Map: OneStep, const N: usize, const M: usize, D: Dynamics<f64, N, M>>(
    map: &Map,
    dynamics: &D,
    level: &mut Level<N, M>,
    (state, increment): (State<N>, Vector<f64, N>),
    (grid, node): (Grid, u64),
) -> State<N> {
    // here, as registers that hold the time in the loop over steps make that a tenth longer
    let t = grid.inner_value(node);
    let mut state = state.after(&increment).normalised();
    if node.is_multiple_of(RESCALING) {
        level.rescale(dynamics, t, &state);
    }
    // into x at once: left in the remainder, which the flow does not turn, it would later be
    // taken off along a Λ that has turned away
    let time = Time::new(t);
    restore(map, dynamics, (level, time), &mut state, &increment);
    state.normalised()
}
