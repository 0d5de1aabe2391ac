//! A segment: a method with the dynamics of one mode, and an observer that is told of the mode.

use std::ops::ControlFlow;

use crate::arithmetic::{State, Time};
use crate::contract::{Dynamics, DynamicsVisitor, Vector};
use crate::method::{Cursor, Ended, Failure, Listener, Method, Sink};
use crate::output::{Observer, Point};

/// An observer with the mode that it is told of.
pub(super) struct InMode<'a, R, Obs> {
    pub(super) region: R,
    pub(super) observer: &'a mut Obs,
}

impl<R: Copy, Obs: Observer<R, N>, const N: usize> Listener<N> for InMode<'_, R, Obs> {
    fn point(&mut self, time: Time, state: &State<N>) -> ControlFlow<()> {
        self.observer.point(&Point {
            t: time.value,
            time,
            x: state.rounded(),
            region: self.region,
        })
    }

    fn next_output(&self) -> Option<f64> {
        self.observer.next_output()
    }

    fn output(&mut self, t: f64, x: Vector<f64, N>) {
        self.observer.output(&Point {
            t,
            time: Time::new(t),
            x,
            region: self.region,
        });
    }
}

/// A segment to be made with the dynamics of its mode.
pub(super) struct Segment<'a, Met: Method, S, const N: usize> {
    pub(super) method: &'a Met,
    pub(super) cursor: &'a mut Cursor<N>,
    pub(super) until: f64,
    pub(super) memory: &'a mut Met::Memory<N>,
    pub(super) sink: &'a mut S,
}

impl<Met: Method, S: Sink<N>, const N: usize> DynamicsVisitor<N> for Segment<'_, Met, S, N> {
    type Output = Result<Ended, Failure>;

    #[inline]
    fn visit<const M: usize, D: Dynamics<f64, N, M>>(self, dynamics: &D) -> Self::Output {
        let Self {
            method,
            cursor,
            until,
            memory,
            sink,
        } = self;
        if dynamics.keeps_signs() {
            let dynamics = dynamics.oriented(cursor.time.value, &cursor.state.x);
            return method.segment(&dynamics, cursor, until, memory, sink);
        }
        method.segment(dynamics, cursor, until, memory, sink)
    }
}
