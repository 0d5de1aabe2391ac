//! The driver: Algorithm 2.1 of Hirani, Wan & Wojtalewicz (Mannshardt's transition scheme).
//!
//! ```text
//! segment in the present mode → event at (t̂*, x̂*) → next mode → go on
//! ```
//!
//! The mode is explicit state. It is never inferred again from the sign of g after a transition, so
//! that x̂* belongs to the mode entered whatever rounding did, and the located point never fires
//! again. Names are added to errors here; methods know none.

use super::accumulation::Accumulation;
use super::conditions::{condition, condition_error};
use super::next::enter;
use super::segment::{InMode, Segment};
use super::start::Start;
use crate::arithmetic::{State, Time};
use crate::contract::{System, Vector};
use crate::error::Error;
use crate::method::{Active, Cursor, Ended, Failure, Method, Observed, Silent, Statistics};
use crate::output::{End, EndedBy, Observer, Point, Transition};

/// An integration under way.
#[derive(Clone, Debug)]
pub(crate) struct Run<Sys: System<N>, Met: Method, const N: usize> {
    pub(crate) cursor: Cursor<N>,
    pub(crate) region: Sys::Region,
    pub(crate) memory: Met::Memory<N>,
    pub(crate) statistics: Statistics,
    pub(crate) accumulation: Accumulation,
}

impl<Sys: System<N>, Met: Method, const N: usize> Run<Sys, Met, N> {
    /// At the start.
    pub(crate) fn new(
        method: &Met,
        (t0, x0): (f64, Vector<f64, N>),
        start: Start<Sys::Region>,
        t_end: f64,
    ) -> Self {
        let (time, state) = (Time::new(t0), State::new(x0));
        let active = Active::new(start.interface);
        Self {
            cursor: Cursor::new(time, state, Sys::index(start.region), active),
            region: start.region,
            memory: method.memory(t0, t_end),
            statistics: Statistics::default(),
            accumulation: Accumulation::new(time),
        }
    }

    /// Where it is.
    pub(crate) fn point(&self) -> Point<Sys::Region, N> {
        Point {
            t: self.cursor.time.value,
            time: self.cursor.time,
            x: self.cursor.state.rounded(),
            region: self.region,
        }
    }

    /// Where it is, with what was done.
    pub(crate) fn end(&self, ended_by: EndedBy) -> End<Sys::Region, N> {
        End {
            point: self.point(),
            remainder: self.cursor.state.remainder,
            statistics: self.statistics,
            ended_by,
        }
    }

    /// Segment, event, next mode, until the end time or the observer's wish.
    pub(crate) fn run_until<Obs: Observer<Sys::Region, N>>(
        &mut self,
        system: &Sys,
        method: &Met,
        until: f64,
        observer: &mut Obs,
    ) -> Result<EndedBy, Error> {
        loop {
            let (guard, rate) = match self.segment(system, method, until, observer)? {
                Ended::Finished => return Ok(EndedBy::EndTime),
                Ended::Stopped => return Ok(EndedBy::Observer),
                Ended::AtGuard { guard, rate } => (guard, rate),
            };
            if observer.point(&self.point()).is_break() {
                return Ok(EndedBy::Observer);
            }
            let transition = self.next_mode(system, guard, rate)?;
            if observer.transition(&transition).is_break()
                || observer.point(&self.point()).is_break()
            {
                return Ok(EndedBy::Observer);
            }
        }
    }

    /// A segment in the present mode.
    #[inline(always)]
    pub(crate) fn segment<Obs: Observer<Sys::Region, N>>(
        &mut self,
        system: &Sys,
        method: &Met,
        until: f64,
        observer: &mut Obs,
    ) -> Result<Ended, Error> {
        let region = self.region;
        let Self {
            cursor,
            memory,
            statistics,
            ..
        } = self;
        let ended = if const { Obs::LISTENS } {
            let mut listener = InMode { region, observer };
            let segment = Segment {
                method,
                cursor,
                until,
                memory,
                sink: &mut Observed::new(&mut listener, statistics),
            };
            system.visit(region, segment)
        } else {
            let segment = Segment {
                method,
                cursor,
                until,
                memory,
                sink: &mut Silent { statistics },
            };
            system.visit(region, segment)
        };
        match ended {
            Ok(ended) => Ok(ended),
            Err(failure) => Err(self.error(system, failure)),
        }
    }

    /// The transition at a guard that was met: into the next mode.
    pub(crate) fn next_mode(
        &mut self,
        system: &Sys,
        guard: usize,
        rate: f64,
    ) -> Result<Transition<Sys::Region, N>, Error> {
        let Cursor { time, state, .. } = &self.cursor;
        if let Some(condition) = condition(system.metadata(), guard) {
            let region = system.of_region(self.region).name;
            return Err(condition_error(condition, region, time.value, &state.x));
        }
        (self.accumulation).count(system, (guard, self.region), *time, &state.x)?;
        let transition = enter(system, (self.region, rate), guard, *time, state)?;
        self.statistics.transitions += 1;
        self.region = transition.to;
        self.cursor.enter(Sys::index(transition.to), guard);
        Ok(transition)
    }

    /// What stopped a method, with names.
    #[cold]
    fn error(&self, system: &Sys, failure: Failure) -> Error {
        failure.named(system, &self.cursor, self.region)
    }
}
