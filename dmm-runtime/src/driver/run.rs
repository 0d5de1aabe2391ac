//! The driver: Algorithm 2.1 of Hirani, Wan & Wojtalewicz (Mannshardt's transition scheme).
//!
//! ```text
//! segment in the present mode → event at (t̂*, x̂*) → next mode → go on
//! ```
//!
//! The mode is explicit state. It is never inferred again from the sign of g after a transition, so
//! that x̂* belongs to the mode entered whatever rounding did, and the located point never fires
//! again. Names are added to errors here; methods know none.

use std::ops::ControlFlow;

use super::accumulation::Accumulation;
use super::conditions::condition_error;
use super::modes::Modes;
use super::next::enter;
use super::segment::{InMode, Segment};
use super::start::Start;
use crate::arithmetic::{State, Time};
use crate::contract::{Side, System, Vector};
use crate::error::Error;
use crate::method::{Cursor, Ended, Failure, Method, Observed, Silent, Sink, Statistics};
use crate::output::{End, EndedBy, Observer, Point, Transition, TransitionKind};

/// An integration under way.
#[derive(Clone, Debug)]
pub(crate) struct Run<Sys: System<N>, const N: usize> {
    pub(crate) cursor: Cursor<N>,
    pub(crate) region: Sys::Region,
    pub(crate) statistics: Statistics,
    pub(crate) accumulation: Accumulation,
    pub(crate) modes: Modes<Sys::Region>,
}

impl<Sys: System<N>, const N: usize> Run<Sys, N> {
    /// At the start.
    pub(crate) fn new(
        system: &Sys,
        (t0, x0): (f64, Vector<f64, N>),
        start: Start<Sys::Region>,
    ) -> Self {
        let (time, state) = (Time::new(t0), State::new(x0));
        let cursor = Cursor::new(time, state, 0, start.on);
        Self::at(system, cursor, start.region)
    }

    /// At a cursor in a mode.
    pub(crate) fn at(system: &Sys, cursor: Cursor<N>, region: Sys::Region) -> Self {
        let mut run = Self {
            accumulation: Accumulation::new(cursor.time),
            cursor,
            region,
            statistics: Statistics::default(),
            modes: Modes::default(),
        };
        run.cursor.mode = run.modes.number(system, region);
        run
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
    pub(crate) fn run_until<Met: Method, Obs: Observer<Sys::Region, N>>(
        &mut self,
        system: &Sys,
        (method, memory): (&Met, &mut Met::Memory<N>),
        until: f64,
        observer: &mut Obs,
    ) -> Result<EndedBy, Error> {
        loop {
            let (guard, rate) = match self.segment(system, (method, memory), until, observer)? {
                Ended::Finished => return Ok(EndedBy::EndTime),
                Ended::Stopped => return Ok(EndedBy::Observer),
                Ended::AtGuard { guard, rate } => (guard, rate),
            };
            if observer.point(&self.point()).is_break() {
                return Ok(EndedBy::Observer);
            }
            let told = |transition: &_| observer.transition(transition);
            if self.next_mode(system, (guard, rate), told)?.is_break()
                || observer.point(&self.point()).is_break()
            {
                return Ok(EndedBy::Observer);
            }
        }
    }

    /// A segment in the present mode.
    #[inline(always)]
    pub(crate) fn segment<Met: Method, Obs: Observer<Sys::Region, N>>(
        &mut self,
        system: &Sys,
        (method, memory): (&Met, &mut Met::Memory<N>),
        until: f64,
        observer: &mut Obs,
    ) -> Result<Ended, Error> {
        if self.modes.are_given_anew() {
            method.forget_modes(memory);
        }
        let region = self.region;
        let Self {
            cursor, statistics, ..
        } = self;
        let way = (method, cursor, memory, until);
        let ended = if const { Obs::LISTENS } {
            let mut listener = InMode { region, observer };
            let mut sink = Observed::new(&mut listener, statistics);
            segment_in(system, region, way, &mut sink)
        } else if const { Sys::IS_INTERPRETED } {
            let mut silent = Silent { statistics };
            let mut sink: Observed<'_, N> = silent.erased();
            segment_in(system, region, way, &mut sink)
        } else {
            segment_in(system, region, way, &mut Silent { statistics })
        };
        match ended {
            Ok(Ended::AtGuard { guard, rate }) => {
                if let Some(side) = system.metadata().end(guard).and_then(|end| end.side) {
                    self.move_past_end(system, (guard, rate), side, until);
                }
                Ok(Ended::AtGuard { guard, rate })
            }
            Ok(ended) => Ok(ended),
            Err(failure) => Err(self.error(system, failure)),
        }
    }

    /// At the end of a sliding motion the field that the solution leaves with is tangential to the
    /// interface: rounding errors decide on the sign of dg/dt. By the wrong one the solution would
    /// come back at once, so it slides on, as little as the time can tell, until the sign is right.
    #[cold]
    #[inline(never)]
    fn move_past_end(&mut self, system: &Sys, (guard, rate): (usize, f64), side: Side, until: f64) {
        /// Doublings of the distance between two doubles.
        const MOST: u32 = 20;
        let Cursor { time, state, .. } = self.cursor;
        let field = system.vector_field(self.region, time.value, &state.x);
        let mut later = 0.0;
        for _ in 0..MOST {
            let there = (
                time.after(later),
                state.after(&(field * later)).normalised(),
            );
            let Ok(next) = enter(system, (self.region, rate), guard, there.0, &there.1) else {
                return;
            };
            let leaves = next.kind == Some(TransitionKind::LeftSlide);
            if !leaves || there.0.value > until {
                return;
            }
            if next.rate * side.sign() > 0.0 {
                (self.cursor.time, self.cursor.state) = there;
                return;
            }
            let between = time.value.abs().next_up() - time.value.abs();
            later = f64::max(2.0 * later, between);
        }
    }

    /// What is behind a guard that was met at a rate: into the next mode, with what `told` makes of the
    /// transition. Nothing is told of an interface that has to do with events alone, where none happens.
    #[inline(always)]
    pub(crate) fn next_mode(
        &mut self,
        system: &Sys,
        (guard, rate): (usize, f64),
        told: impl FnOnce(&Transition<Sys::Region, N>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, Error> {
        let Cursor { time, state, .. } = &self.cursor;
        if let Some(condition) = system.metadata().condition(guard) {
            let region = system.of_region(self.region).name;
            return Err(condition_error(condition, region, time.value, &state.x));
        }
        (self.accumulation).count(system, (guard, self.region), *time, &state.x)?;
        let next = enter(system, (self.region, rate), guard, *time, state)?;
        let mut flow = ControlFlow::Continue(());
        if let Some(kind) = next.kind {
            kind.count(&mut self.statistics);
            flow = told(&Transition {
                t: time.value,
                time: *time,
                x: state.x,
                remainder: state.remainder,
                after: next.state.map_or(state.x, |after| after.x),
                kind,
                interface: system.metadata().interface(guard),
                guard,
                from: self.region,
                to: next.mode,
                rate_from: rate,
                rate_to: next.rate,
            });
        }
        self.region = next.mode;
        if let Some(state) = next.state {
            self.cursor.state = state;
        }
        let mode = self.modes.number(system, next.mode);
        self.cursor.enter(mode, next.active);
        Ok(flow)
    }

    /// What stopped a method, with names.
    #[cold]
    fn error(&self, system: &Sys, failure: Failure) -> Error {
        let mut error = failure.named(system, &self.cursor, self.region);
        if let Some(kind) = self.accumulation.explains(self.cursor.time, &error.kind) {
            error.kind = kind;
        }
        error
    }
}

/// A segment in a mode.
#[inline(always)]
fn segment_in<Sys: System<N>, Met: Method, S: Sink<N>, const N: usize>(
    system: &Sys,
    region: Sys::Region,
    (method, cursor, memory, until): (&Met, &mut Cursor<N>, &mut Met::Memory<N>, f64),
    sink: &mut S,
) -> Result<Ended, Failure> {
    let segment = Segment {
        method,
        cursor,
        until,
        memory,
        sink,
    };
    system.visit(region, segment)
}
