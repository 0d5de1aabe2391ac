//! Steps of one size.

mod steps;

use steps::Steps;

use super::crossing::{Locator, NewtonLocator};
use super::grid::Grid;
use super::map::{OneStep, Step};
use super::search::watches;
use super::segment::Segment;
use crate::arithmetic::{Scalar, State, Time};
use crate::contract::{Dynamics, Vector};
use crate::error::{Error, invalid, number};
use crate::level::Level;
use crate::method::{Cursor, Ended, Failure, Method, Sink, Statistics, Variation};

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
