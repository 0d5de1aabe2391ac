//! Steps of one size.

use super::crossing::{Locator, NewtonLocator};
use super::grid::Grid;
use super::map::{OneStep, Step};
use super::resolution::Resolution;
use super::search::{Dense, Watches, advance, is_near, readings, through_ends, watches};
use super::segment::{Segment, restore};
use super::watch::Watch;
use crate::arithmetic::linear::is_finite;
use crate::arithmetic::{Scalar, State, Time};
use crate::contract::{Dynamics, Vector};
use crate::error::{Error, invalid, number};
use crate::events::Path;
use crate::events::ends::Decay;
use crate::level::Level;
use crate::method::{Cursor, Ended, Failure, Method, Sink, Statistics, StepFailure, Variation};

/// Steps between adaptions of the level's correction to the size of the state.
const RESCALING: u64 = 256;
/// Steps between looks at whether they resolve the solution.
const LOOKS: u64 = 64;
/// The coefficients of g along the cubic through the ends of a step fall off like powers of this.
const CUBIC_DECAY: f64 = 0.5;

/// A one-step map in uniform steps; made by [`Symmetric::step_size`](crate::Symmetric::step_size)
/// and [`Composed::step_size`](crate::Composed::step_size).
///
/// A step has to resolve the solution: interfaces are met along the cubic through its ends (see
/// [the front page](crate#every-crossing)), on which nothing is to be seen of an excursion of the
/// state that is shorter than a step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Uniform<Map, Loc = NewtonLocator> {
    map: Map,
    step_size: f64,
    level_correction: bool,
    locator: Loc,
}

impl<Map: OneStep> Uniform<Map> {
    /// Steps of `step_size` (in the unit of time), which must be positive and finite; the
    /// integrator refuses others.
    pub fn new(map: Map, step_size: f64) -> Self {
        Self {
            map,
            step_size,
            level_correction: true,
            locator: NewtonLocator,
        }
    }
}

impl<Map, Loc> Uniform<Map, Loc> {
    /// Whether the rounding errors of ψ are corrected towards the level at the entry into the
    /// region (default: yes). Without it they add up: with [`Symmetric`](crate::Symmetric) at
    /// τ = 10⁻³ to less than 10⁻¹³ of the size of ψ's terms in a million steps, at coarse steps of a
    /// linear field, whose propagator is rounded once and for all, to some 10⁻¹¹.
    #[must_use]
    pub fn level_correction(self, level_correction: bool) -> Self {
        Self {
            level_correction,
            ..self
        }
    }

    /// Replaces the locator of crossings (default: [`NewtonLocator`]).
    #[must_use]
    pub fn locator<Other: Locator>(self, locator: Other) -> Uniform<Map, Other> {
        Uniform {
            map: self.map,
            step_size: self.step_size,
            level_correction: self.level_correction,
            locator,
        }
    }
}

/// What uniform steps carry from segment to segment.
#[derive(Clone, Copy, Debug)]
pub struct Memory<T> {
    grid: Grid,
    /// The node of the grid that the next step ends at.
    node: u64,
    /// Whether the cursor is at the node before, so that the next step is a full one.
    at_node: bool,
    /// What the map remembers of a segment that was stopped between two full steps.
    map: Option<T>,
}

impl<T> Memory<T> {
    fn new(t0: f64, t_end: f64, step_size: f64) -> Self {
        Self {
            grid: Grid::new(t0, t_end, step_size),
            node: 1,
            at_node: true,
            map: None,
        }
    }

    /// The time of a node: exact for autonomous dynamics; for others the double that the formulas
    /// are evaluated at.
    fn time(&self, node: u64, is_autonomous: bool) -> Time {
        if is_autonomous {
            self.grid.time(node)
        } else {
            Time::new(self.grid.value(node))
        }
    }
}

impl<Map: OneStep, Loc: Locator> Method for Uniform<Map, Loc> {
    type Memory<const N: usize> = Memory<Map::Memory<N>>;

    fn check(&self, t0: f64, t_end: f64) -> Result<(), Error> {
        let step_size = self.step_size;
        if !(step_size > 0.0 && step_size.is_finite()) {
            let requirement = "must be positive and finite";
            return invalid("step size", number(step_size), requirement);
        }
        let largest = t0.abs().max(t_end.abs());
        if t_end > t0 && largest.is_finite() && largest + step_size == largest {
            let requirement = "is below the rounding error of the time";
            return invalid("step size", number(step_size), requirement);
        }
        Ok(())
    }

    fn memory<const N: usize>(&self, t0: f64, t_end: f64) -> Self::Memory<N> {
        Memory::new(t0, t_end, self.step_size)
    }

    fn segment<D, S, const N: usize, const M: usize>(
        &self,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        until: f64,
        memory: &mut Self::Memory<N>,
        sink: &mut S,
    ) -> Result<Ended, Failure>
    where
        D: Dynamics<f64, N, M>,
        S: Sink<N>,
    {
        if memory.grid.end != until {
            *memory = Memory::new(cursor.time.value, until, self.step_size);
        }
        if cursor.level.is_none() {
            memory.map = None;
        }
        let Cursor { time, state, .. } = cursor;
        let mut level = Level::enter(dynamics, *time, state, cursor.level.as_deref());
        let mut watches = watches(dynamics, time.value, &state.x, &cursor.active);
        let mut steps = Steps {
            segment: Segment {
                map: &self.map,
                locator: &self.locator,
                corrects_level: self.level_correction,
                cursor,
                sink,
            },
            memory,
        };
        loop {
            let is_full = steps.memory.at_node && steps.memory.node < steps.memory.grid.count;
            let end = if is_full {
                steps.full_steps(dynamics, &mut level, &mut watches)?
            } else {
                steps.partial_step(dynamics, &level, &mut watches)?
            };
            let Some(end) = end else { continue };
            if end == Ended::Stopped {
                steps.segment.keep(dynamics, &level, &watches);
            }
            return Ok(end);
        }
    }

    fn reach<D, const N: usize, const M: usize>(
        &self,
        memory: &Self::Memory<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure>
    where
        D: Dynamics<f64, N, M>,
    {
        let grid = &memory.grid;
        let (mut t, mut x) = (cursor.time.value, cursor.state.rounded());
        let mut node = grid.node_after(t);
        while t < to {
            let end = grid.value(node).min(to);
            let tau = end - t;
            let step = Step {
                dynamics,
                t0: t,
                x0: &x,
                tau,
            };
            let increment = self.map.step(&step, &mut Statistics::default());
            x += increment.map_err(|failure| failure.over(tau))?;
            t = end;
            node += 1;
            (cursor.time, cursor.state) = (Time::new(t), State::new(x));
        }
        Ok(())
    }

    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar,
    {
        self.map.differentiate::<D, S, N, M>(step)
    }
}

/// Uniform steps under way.
struct Steps<'a, Map: OneStep, Loc, S, const N: usize> {
    segment: Segment<'a, Map, Loc, S, N>,
    memory: &'a mut Memory<Map::Memory<N>>,
}

impl<Map: OneStep, Loc: Locator, S: Sink<N>, const N: usize> Steps<'_, Map, Loc, S, N> {
    /// Full steps, until the last node but one or whatever ends the segment.
    ///
    /// The state is a local variable, and the time is computed where it is used: the clock of
    /// autonomous dynamics that are not observed costs nothing.
    fn full_steps<const M: usize, D: Dynamics<f64, N, M>>(
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
    fn partial_step<const M: usize, D: Dynamics<f64, N, M>>(
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
