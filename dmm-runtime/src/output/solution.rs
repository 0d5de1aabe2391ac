//! What an integration returns.

use std::fmt;
use std::ops::ControlFlow;

use super::{Observer, Point, Transition};
use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, DynamicsVisitor, System, Vector};
use crate::error::{Error, ErrorKind};
use crate::method::{Active, Cursor, Failure, Method, Statistics};

/// A trajectory: points, transitions, statistics, and the solution at any time in between.
#[derive(Clone, Debug)]
pub struct Solution<Sys: System<N>, Met: Method, const N: usize> {
    system: Sys,
    method: Met,
    memory: Met::Memory<N>,
    recorder: Recorder<Sys::Region, N>,
    statistics: Statistics,
}

impl<Sys: System<N>, Met: Method, const N: usize> Solution<Sys, Met, N> {
    pub(crate) fn new(
        system: Sys,
        method: Met,
        memory: Met::Memory<N>,
        recorder: Recorder<Sys::Region, N>,
        statistics: Statistics,
    ) -> Self {
        Self {
            system,
            method,
            memory,
            recorder,
            statistics,
        }
    }

    /// The points, in the order of time: ends of steps or the times asked for. A transition
    /// appears twice, with the region that is left and with the region that is entered.
    pub fn points(&self) -> &[Point<Sys::Region, N>] {
        &self.recorder.points
    }

    /// The transitions, in the order of time.
    pub fn transitions(&self) -> &[Transition<Sys::Region, N>] {
        &self.recorder.transitions
    }

    /// What was done.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// The last point that was reached; nothing if not even the start was valid.
    pub fn last(&self) -> Option<&Point<Sys::Region, N>> {
        self.recorder.last.as_ref()
    }

    /// The solution at time `t`: by the steps of the run from the last point kept before it
    /// and a step of the scheme that ends at `t`, so that it conserves what the scheme
    /// conserves. It is never interpolated across a transition;
    /// at a transition itself it is the transition point.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] if `t` was not integrated, or whatever the step runs into.
    pub fn at(&self, t: f64) -> Result<Vector<f64, N>, Error> {
        let (from, to) = match (&self.recorder.start, &self.recorder.last) {
            (Some(start), Some(last)) => (start, last),
            _ => {
                return Err(ErrorKind::OutOfRange {
                    t,
                    from: f64::NAN,
                    to: f64::NAN,
                }
                .into());
            }
        };
        if !(from.t..=to.t).contains(&t) {
            return Err(ErrorKind::OutOfRange {
                t,
                from: from.t,
                to: to.t,
            }
            .into());
        }
        let anchor = self.recorder.anchor(t, *from);
        let (time, state) = (Time::new(anchor.t), State::new(anchor.x));
        let mut cursor = Cursor::new(time, state, 0, Active::default());
        let reach = Reach {
            method: &self.method,
            memory: &self.memory,
            cursor: &mut cursor,
            to: t,
        };
        match self.system.visit(anchor.region, reach) {
            Ok(()) => Ok(cursor.state.rounded()),
            Err(failure) => Err(failure.named(&self.system, &cursor, anchor.region)),
        }
    }
}

/// Steps to a time, in one mode.
struct Reach<'a, Met: Method, const N: usize> {
    method: &'a Met,
    memory: &'a Met::Memory<N>,
    cursor: &'a mut Cursor<N>,
    to: f64,
}

impl<Met: Method, const N: usize> DynamicsVisitor<N> for Reach<'_, Met, N> {
    type Output = Result<(), Failure>;

    fn visit<const M: usize, D: Dynamics<f64, N, M>>(self, dynamics: &D) -> Self::Output {
        (self.method).reach(self.memory, dynamics, self.cursor, self.to)
    }
}

/// Keeps points and transitions.
#[derive(Clone, Debug)]
pub(crate) struct Recorder<R, const N: usize> {
    start: Option<Point<R, N>>,
    last: Option<Point<R, N>>,
    points: Vec<Point<R, N>>,
    transitions: Vec<Transition<R, N>>,
    every: u64,
    /// Points since the last one that was kept.
    skipped: u64,
    output_times: Option<Vec<f64>>,
    /// How many of them are served.
    served: usize,
}

impl<R: Copy, const N: usize> Recorder<R, N> {
    pub(crate) fn new(every: u64, output_times: Option<Vec<f64>>) -> Self {
        Self {
            start: None,
            last: None,
            points: Vec::new(),
            transitions: Vec::new(),
            every,
            skipped: 0,
            output_times,
            served: 0,
        }
    }

    /// Closes the record: the last point is kept even where every `every`-th is.
    pub(crate) fn finish(&mut self)
    where
        R: PartialEq,
    {
        if self.output_times.is_none()
            && let Some(last) = self.last
            && self.points.last() != Some(&last)
        {
            self.points.push(last);
        }
    }

    /// The latest known point at or before `t`: a point or the far side of a transition.
    fn anchor(&self, t: f64, start: Point<R, N>) -> Point<R, N> {
        let mut anchor = start;
        let points = self.points.partition_point(|point| point.t <= t);
        if let Some(point) = self.points[..points].last() {
            anchor = *point;
        }
        let transitions = self
            .transitions
            .partition_point(|transition| transition.t <= t);
        if let Some(transition) = self.transitions[..transitions].last()
            && transition.t >= anchor.t
        {
            anchor = Point {
                t: transition.t,
                time: transition.time,
                x: transition.after,
                region: transition.to,
            };
        }
        anchor
    }
}

impl<R: Copy, const N: usize> Observer<R, N> for Recorder<R, N> {
    #[inline]
    fn point(&mut self, point: &Point<R, N>) -> ControlFlow<()> {
        self.last = Some(*point);
        if self.start.is_none() {
            self.start = Some(*point);
            self.skipped = self.every;
        } else {
            self.skipped += 1;
        }
        if self.skipped >= self.every && self.output_times.is_none() {
            self.skipped = 0;
            self.points.push(*point);
        }
        ControlFlow::Continue(())
    }

    fn transition(&mut self, transition: &Transition<R, N>) -> ControlFlow<()> {
        self.transitions.push(*transition);
        if self.output_times.is_none() {
            // the near side, if it was skipped; the far side is the next point
            if self.skipped > 0
                && let Some(last) = self.last
            {
                self.points.push(last);
            }
            self.skipped = self.every - 1;
        }
        ControlFlow::Continue(())
    }

    #[inline]
    fn next_output(&self) -> Option<f64> {
        self.output_times.as_ref()?.get(self.served).copied()
    }

    fn output(&mut self, point: &Point<R, N>) {
        self.served += 1;
        self.points.push(*point);
    }
}

/// An integration that stopped before its end time, with the solution up to there.
pub struct Interrupted<Sys: System<N>, Met: Method, const N: usize> {
    error: Error,
    solution: Box<Solution<Sys, Met, N>>,
}

impl<Sys: System<N>, Met: Method, const N: usize> Interrupted<Sys, Met, N> {
    pub(crate) fn new(error: Error, solution: Solution<Sys, Met, N>) -> Self {
        Self {
            error,
            solution: Box::new(solution),
        }
    }

    /// What stopped it.
    pub fn error(&self) -> &Error {
        &self.error
    }

    /// What was computed before.
    pub fn solution(&self) -> &Solution<Sys, Met, N> {
        &self.solution
    }

    /// Both.
    pub fn into_parts(self) -> (Error, Solution<Sys, Met, N>) {
        (self.error, *self.solution)
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> fmt::Debug for Interrupted<Sys, Met, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Interrupted")
            .field("error", &self.error)
            .field("points", &self.solution.recorder.points.len())
            .finish_non_exhaustive()
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> fmt::Display for Interrupted<Sys, Met, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> std::error::Error for Interrupted<Sys, Met, N> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.error.source()
    }
}
