//! An integration under way: segments of steps in one region, from interface to interface.
//!
//! [`Walk`] is what it carries from segment to segment. It visits the flow of its region, so
//! that the loop over steps is compiled for that flow; for a smooth system the look at
//! interfaces is compiled away.

mod adapt;
mod ahead;
mod arrive;
mod expand;
mod interfaces;
mod land;
mod march;
mod run;
mod steps;

pub(crate) use run::{Accumulation, enter, run_segment, run_segments};

use std::ops::ControlFlow;

use crate::error::{Error, StepFailure};
use crate::observer::{Observer, Point};
use crate::scheme::{Drive, Scheme};
use crate::state::State;
use crate::statistics::Statistics;
use crate::system::{Flow, FlowVisitor, System};
use crate::time::Time;
use crate::transition::Locator;

/// An integration under way.
pub struct Walk<'a, Sys: System<N>, Sch: Drive, Loc, Obs, const N: usize> {
    pub(crate) system: &'a Sys,
    pub(crate) scheme: &'a Sch,
    pub(crate) locator: &'a Loc,
    pub(crate) observer: &'a mut Obs,
    /// How far the scheme's steps are.
    pub(crate) progress: Sch::Progress,
    pub(crate) time: Time,
    pub(crate) state: State<N>,
    pub(crate) region: Sys::Region,
    /// The interface that the walk is on, just crossed or as the initial point.
    pub(crate) fresh: Option<usize>,
    pub(crate) statistics: Statistics,
}

/// How a segment ended.
#[derive(Clone, Copy, Debug)]
pub enum SegmentEnd {
    /// At the end time.
    Finished,
    /// By the observer's wish.
    Stopped,
    /// On an interface; the walk's time and state are (t̂*, x̂*).
    Crossed {
        /// Which one.
        interface: usize,
        /// dg/dt under the region's field.
        rate: f64,
    },
}

impl<Sys, Sch, Loc, Obs, const N: usize> FlowVisitor<N> for &mut Walk<'_, Sys, Sch, Loc, Obs, N>
where
    Sys: System<N>,
    Sch: Scheme,
    Loc: Locator,
    Obs: Observer<Sys::Region, N>,
{
    type Output = Result<SegmentEnd, Error>;

    fn visit<const M: usize, F: Flow<f64, N, M>>(self, flow: &F) -> Self::Output {
        if F::KEEPS_SIGNS {
            let flow = flow.oriented(self.time.value, &self.state.x);
            return Sch::segment(self, &flow);
        }
        Sch::segment(self, flow)
    }
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

    /// The error of a step of which it cannot be decided whether it meets an interface.
    #[cold]
    fn unknown(&self, interface: usize, tau: f64) -> Error {
        Error::Undecided {
            t: self.time.value,
            x: self.state.x.iter().copied().collect(),
            step_size: tau,
            interface: Sys::boundary_name(interface),
        }
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
}
