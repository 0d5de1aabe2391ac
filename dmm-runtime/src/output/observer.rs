//! Watching an integration as it goes, in constant memory.

use std::ops::ControlFlow;

use crate::arithmetic::Time;
use crate::contract::Vector;

/// A point of the numerical solution.
///
/// At a transition the time appears twice, once with the region that is left and once with
/// the region that is entered: every point belongs to one region.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Point<R, const N: usize> {
    /// Time.
    pub t: f64,
    /// The time with the digits that a double cannot hold: at transitions.
    pub time: Time,
    /// State.
    pub x: Vector<f64, N>,
    /// Region.
    pub region: R,
}

/// What happened at a transition.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum TransitionKind {
    /// An interface was crossed.
    Crossed,
    /// An event has changed states or discrete states.
    Jumped,
    /// The solution goes on along an interface: where it was not on it, or on one more than before.
    BeganToSlide,
    /// The solution leaves an interface that it was sliding on.
    LeftSlide,
}

/// A crossing of an interface, or an event at one (both are "events" in other libraries).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Transition<R, const N: usize> {
    /// t̂*
    pub t: f64,
    /// t̂* with the digits that a double cannot hold.
    pub time: Time,
    /// x̂*, the state in front of the transition.
    pub x: Vector<f64, N>,
    /// The state behind the transition: x̂*, unless an event has changed it.
    pub after: Vector<f64, N>,
    /// What happened.
    pub kind: TransitionKind,
    /// What is missing from x̂*: with it g and ψ hold far beyond the digits of a double where the
    /// scheme is [`Taylor`](crate::Taylor).
    pub remainder: Vector<f64, N>,
    /// Index of the interface in [`Metadata::interfaces`](crate::Metadata::interfaces).
    pub interface: usize,
    /// Index of the guard that was met, see [`Metadata::guard_name`](crate::Metadata::guard_name): the
    /// interface, or the end of a sliding motion on it.
    pub guard: usize,
    /// The region that is left; of a system with events its [`Mode`](crate::Mode), which has the
    /// discrete states before.
    pub from: R,
    /// The region that is entered, with the discrete states behind the transition.
    pub to: R,
    /// dg/dt = ∂ₜg + ∇g·f at (t̂*, x̂*) under the vector field of `from`.
    pub rate_from: f64,
    /// dg/dt at (t̂*, x̂*) under the vector field of `to`.
    pub rate_to: f64,
}

/// What is told of an integration while it runs.
///
/// Every method has a default that ignores what it is told, and what is not listened to
/// costs nothing.
///
/// ```
/// use std::ops::ControlFlow;
/// use dmm_runtime::{Observer, Point};
///
/// /// The largest first component.
/// struct Largest(f64);
///
/// impl<R, const N: usize> Observer<R, N> for Largest {
///     fn point(&mut self, point: &Point<R, N>) -> ControlFlow<()> {
///         self.0 = self.0.max(point.x[0]);
///         ControlFlow::Continue(())
///     }
/// }
/// ```
pub trait Observer<R, const N: usize> {
    /// Whether anything is done with points and outputs. Where nothing is, transitions are told
    /// alone, and points are not even checked one by one for being finite.
    const LISTENS: bool = true;

    /// The solution has reached `point`: the start, the end of a step, a transition (twice:
    /// before and after). `ControlFlow::Break` ends the integration there.
    fn point(&mut self, _point: &Point<R, N>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// An interface was crossed. `ControlFlow::Break` ends the integration there.
    fn transition(&mut self, _transition: &Transition<R, N>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// The next time at which [`Observer::output`] is to be called; asked again after every
    /// call. The steps do not change: the solution there comes from a step of the scheme
    /// that ends there.
    fn next_output(&self) -> Option<f64> {
        None
    }

    /// The solution at the time that [`Observer::next_output`] asked for.
    fn output(&mut self, _point: &Point<R, N>) {}
}

/// Ignores everything.
impl<R, const N: usize> Observer<R, N> for () {
    const LISTENS: bool = false;
}

impl<R, const N: usize, O: Observer<R, N>> Observer<R, N> for &mut O {
    const LISTENS: bool = O::LISTENS;

    fn point(&mut self, point: &Point<R, N>) -> ControlFlow<()> {
        (**self).point(point)
    }

    fn transition(&mut self, transition: &Transition<R, N>) -> ControlFlow<()> {
        (**self).transition(transition)
    }

    fn next_output(&self) -> Option<f64> {
        (**self).next_output()
    }

    fn output(&mut self, point: &Point<R, N>) {
        (**self).output(point);
    }
}
