//! What is told while a method moves, if anything is.

use std::ops::ControlFlow;

use super::statistics::Statistics;
use crate::arithmetic::{State, Time};
use crate::contract::Vector;

/// Takes what happens in a segment.
///
/// There are two: [`Silent`], of which nothing is left in the compiled loop over steps, and
/// [`Observed`], whatever observes. Neither knows the modes of a system.
pub trait Sink<const N: usize> {
    /// Whether anything is done with the points. Where nothing is, they are not even checked
    /// one by one for being finite.
    const LISTENS: bool;

    /// What is counted.
    fn statistics(&mut self) -> &mut Statistics;

    /// Whether anybody is told of the points.
    fn listens(&self) -> bool;

    /// The solution has reached a point, by a step or at a guard. `ControlFlow::Break` ends the
    /// segment there.
    fn point(&mut self, time: Time, state: &State<N>) -> ControlFlow<()>;

    /// The next time at which [`Sink::output`] is to be called.
    fn next_output(&self) -> Option<f64>;

    /// The solution at the time that [`Sink::next_output`] asked for.
    fn output(&mut self, t: f64, x: Vector<f64, N>);

    /// The same sink, of one type whether anybody listens or not: for methods whose steps take so
    /// long that they need not be compiled twice.
    fn erased(&mut self) -> Observed<'_, N>;
}

/// Only counts.
#[derive(Debug)]
pub(crate) struct Silent<'a> {
    /// What is counted.
    pub statistics: &'a mut Statistics,
}

impl<const N: usize> Sink<N> for Silent<'_> {
    const LISTENS: bool = false;

    #[inline(always)]
    fn statistics(&mut self) -> &mut Statistics {
        self.statistics
    }

    #[inline(always)]
    fn listens(&self) -> bool {
        false
    }

    #[inline(always)]
    fn point(&mut self, _time: Time, _state: &State<N>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    #[inline(always)]
    fn next_output(&self) -> Option<f64> {
        None
    }

    #[inline(always)]
    fn output(&mut self, _t: f64, _x: Vector<f64, N>) {}

    fn erased(&mut self) -> Observed<'_, N> {
        Observed {
            statistics: self.statistics,
            listener: None,
            next_output: None,
        }
    }
}

/// What [`Observed`] tells: an observer with the mode that it is told of, both known to the driver
/// alone.
pub(crate) trait Listener<const N: usize> {
    /// See [`Sink::point`].
    fn point(&mut self, time: Time, state: &State<N>) -> ControlFlow<()>;

    /// See [`Sink::next_output`].
    fn next_output(&self) -> Option<f64>;

    /// See [`Sink::output`].
    fn output(&mut self, t: f64, x: Vector<f64, N>);
}

/// Tells a listener, if there is one.
pub struct Observed<'a, const N: usize> {
    statistics: &'a mut Statistics,
    listener: Option<&'a mut dyn Listener<N>>,
    /// What the listener last asked for.
    next_output: Option<f64>,
}

impl<'a, const N: usize> Observed<'a, N> {
    /// The sink of a listener, which counts in `statistics`.
    pub(crate) fn new(listener: &'a mut dyn Listener<N>, statistics: &'a mut Statistics) -> Self {
        let next_output = listener.next_output();
        Self {
            statistics,
            listener: Some(listener),
            next_output,
        }
    }
}

/// Tells of a point. The state is a copy, so that nothing that steps work with is lent and has to be
/// kept in memory where nothing is told.
#[cold]
#[inline(never)]
fn tell<const N: usize>(
    listener: &mut dyn Listener<N>,
    time: Time,
    state: State<N>,
) -> ControlFlow<()> {
    listener.point(time, &state)
}

impl<const N: usize> Sink<N> for Observed<'_, N> {
    const LISTENS: bool = true;

    #[inline]
    fn statistics(&mut self) -> &mut Statistics {
        self.statistics
    }

    #[inline(always)]
    fn listens(&self) -> bool {
        self.listener.is_some()
    }

    #[inline(always)]
    fn point(&mut self, time: Time, state: &State<N>) -> ControlFlow<()> {
        match &mut self.listener {
            Some(listener) => tell(*listener, time, *state),
            None => ControlFlow::Continue(()),
        }
    }

    #[inline]
    fn next_output(&self) -> Option<f64> {
        self.next_output
    }

    fn output(&mut self, t: f64, x: Vector<f64, N>) {
        if let Some(listener) = &mut self.listener {
            listener.output(t, x);
            self.next_output = listener.next_output();
        }
    }

    fn erased(&mut self) -> Observed<'_, N> {
        Observed {
            statistics: self.statistics,
            listener: match &mut self.listener {
                Some(listener) => Some(&mut **listener),
                None => None,
            },
            next_output: self.next_output,
        }
    }
}
