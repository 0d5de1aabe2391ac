//! An integration under way: segments of steps in one region, from interface to interface.
//!
//! [`Walk`] is what it carries from segment to segment. It visits the flow of its region, so
//! that the loop over steps is compiled for that flow; for a smooth system the look at
//! interfaces is compiled away.

mod interfaces;
mod run;
mod steps;

pub(crate) use run::run_segments;

use std::ops::ControlFlow;

use crate::error::{Error, StepFailure};
use crate::level::Level;
use crate::linear::is_finite;
use crate::observer::{Observer, Point};
use crate::scheme::{Scheme, Step};
use crate::state::State;
use crate::statistics::Statistics;
use crate::system::{Flow, System, Vector};
use crate::time::{Grid, Time};
use crate::transition::Locator;

/// An integration under way.
pub(crate) struct Walk<'a, Sys: System<N>, Sch, Loc, Obs, const N: usize> {
    pub(crate) system: &'a Sys,
    pub(crate) scheme: &'a Sch,
    pub(crate) locator: &'a Loc,
    pub(crate) observer: &'a mut Obs,
    pub(crate) grid: Grid,
    /// The node of the grid that the next step ends at.
    pub(crate) node: u64,
    /// Whether the walk is at the node before, so that the next step is a full one.
    pub(crate) at_node: bool,
    pub(crate) time: Time,
    pub(crate) state: State<N>,
    pub(crate) region: Sys::Region,
    /// The interface that the walk is on, just crossed or as the initial point.
    pub(crate) fresh: Option<usize>,
    pub(crate) statistics: Statistics,
}

/// How a segment ended.
pub(crate) enum SegmentEnd {
    /// At the end time.
    Finished,
    /// By the observer's wish.
    Stopped,
    /// On an interface; the walk's time and state are (t̂*, x̂*).
    Crossed {
        interface: usize,
        /// dg/dt under the region's field.
        rate: f64,
    },
}

impl<Sys, Sch, Loc, Obs, const N: usize> Walk<'_, Sys, Sch, Loc, Obs, N>
where
    Sys: System<N>,
    Sch: Scheme,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    /// The point that the walk is at.
    pub(crate) fn point(&self) -> Point<Sys::Region, N> {
        Point {
            t: self.time.value,
            time: self.time,
            x: self.state.rounded(),
            region: self.region,
        }
    }

    #[inline]
    pub(crate) fn tell_point(&mut self) -> ControlFlow<()> {
        let point = self.point();
        self.observer.point(&point)
    }

    /// Writes the local variables of [`Walk::full_steps`] back: the walk is at `state` at the
    /// node before `node`.
    #[cold]
    fn settle<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        state: State<N>,
        node: u64,
        counts: &mut Statistics,
    ) {
        self.state = state;
        self.node = node;
        self.time = self.node_time::<M, F>(node - 1);
        self.statistics += std::mem::take(counts);
    }

    /// The time of a node: exact for an autonomous flow; for others the double that its
    /// formulas are evaluated at.
    fn node_time<const M: usize, F: Flow<f64, N, M>>(&self, node: u64) -> Time {
        if F::AUTONOMOUS {
            self.grid.time(node)
        } else {
            Time::new(self.grid.value(node))
        }
    }

    /// The error of a step that cannot be made from here.
    #[cold]
    fn failure(&self, failure: StepFailure, tau: f64) -> Error {
        failure.at(
            self.time.value,
            &self.state.x,
            tau,
            Sys::region_name(self.region),
        )
    }

    /// Moves over `increment` to `time`, corrected towards the level.
    fn accept<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        level: &Level<N, M>,
        increment: &Vector<f64, N>,
        tau: f64,
        time: Time,
    ) -> Result<(), Error> {
        let mut state = self.state.after(increment);
        if !is_finite(&state.x) {
            return Err(self.failure(StepFailure::NotFinite, tau));
        }
        if self.scheme.corrects_level() {
            state.remainder += level.correction(flow, time, &state);
        }
        self.state = state.normalised();
        self.time = time;
        self.statistics.steps += 1;
        Ok(())
    }

    /// Serves the output times up to the start.
    pub(crate) fn start_outputs(&mut self) {
        while let Some(t) = self.observer.next_output()
            && t <= self.time.value
        {
            let point = Point { t, ..self.point() };
            self.observer.output(&point);
        }
    }

    /// Serves the output times up to `end`, the end of a step over `tau`.
    fn outputs<const M: usize, F: Flow<f64, N, M>>(
        &mut self,
        flow: &F,
        tau: f64,
        end: Time,
    ) -> Result<(), Error> {
        while let Some(t) = self.observer.next_output()
            && t <= end.value
        {
            let elapsed = Time::new(t).since(self.time).max(0.0).min(tau);
            let step = Step {
                flow,
                t0: self.time.value,
                x0: &self.state.x,
                tau: elapsed,
            };
            let increment = match elapsed > 0.0 {
                true => self
                    .scheme
                    .step(&step, &mut Statistics::default())
                    .map_err(|failure| self.failure(failure, elapsed))?,
                false => Vector::zeros(),
            };
            let point = Point {
                t,
                time: Time::new(t),
                x: self.state.after(&increment).rounded(),
                region: self.region,
            };
            self.observer.output(&point);
        }
        Ok(())
    }
}
