//! What an integration returns.

use super::{EndedBy, Point, Recorder, Transition};
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
    ended_by: EndedBy,
}

impl<Sys: System<N>, Met: Method, const N: usize> Solution<Sys, Met, N> {
    pub(crate) fn new(
        system: Sys,
        method: Met,
        memory: Met::Memory<N>,
        recorder: Recorder<Sys::Region, N>,
        (statistics, ended_by): (Statistics, EndedBy),
    ) -> Self {
        Self {
            system,
            method,
            memory,
            recorder,
            statistics,
            ended_by,
        }
    }

    /// The system, with its parameters.
    pub fn system(&self) -> &Sys {
        &self.system
    }

    /// The method that it was integrated by.
    pub fn method(&self) -> &Met {
        &self.method
    }

    /// The points, in the order of time: ends of steps or the times asked for. A transition
    /// appears twice, with the region that is left and with the region that is entered.
    pub fn points(&self) -> &[Point<Sys::Region, N>] {
        self.recorder.points()
    }

    /// The transitions, in the order of time.
    pub fn transitions(&self) -> &[Transition<Sys::Region, N>] {
        self.recorder.transitions()
    }

    /// What was done.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// What ended it.
    pub fn ended_by(&self) -> EndedBy {
        self.ended_by
    }

    /// The last point that was reached; nothing if not even the start was valid.
    pub fn last(&self) -> Option<&Point<Sys::Region, N>> {
        self.recorder.last()
    }

    /// The solution at time `t`: by the steps of the run from the last point kept before it
    /// and a step of the scheme that ends at `t`, so that it conserves what the scheme
    /// conserves. It is never interpolated across a transition;
    /// at a transition itself it is the transition point.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] if `t` was not integrated, or whatever the step runs into.
    pub fn at(&self, t: f64) -> Result<Vector<f64, N>, Error> {
        let (from, to) = match (self.recorder.start(), self.recorder.last()) {
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

/// The points, as of [`Solution::points`].
impl<'a, Sys: System<N>, Met: Method, const N: usize> IntoIterator for &'a Solution<Sys, Met, N> {
    type Item = &'a Point<Sys::Region, N>;
    type IntoIter = std::slice::Iter<'a, Point<Sys::Region, N>>;

    fn into_iter(self) -> Self::IntoIter {
        self.points().iter()
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
