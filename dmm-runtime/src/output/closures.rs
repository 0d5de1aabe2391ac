//! Observers that are made from closures.

use std::ops::ControlFlow;

use super::{Observer, Point, Transition};

/// What a closure that observes returns: nothing, to go on, or a [`ControlFlow`], whose `Break` ends
/// the integration.
pub trait IntoControlFlow {
    /// Whether to go on.
    fn into_control_flow(self) -> ControlFlow<()>;
}

impl IntoControlFlow for () {
    fn into_control_flow(self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl IntoControlFlow for ControlFlow<()> {
    fn into_control_flow(self) -> ControlFlow<()> {
        self
    }
}

/// The observer that calls `observe` at the start, at the end of each step, and at each transition
/// twice: before and after it.
///
/// It returns nothing, or a [`ControlFlow`] whose `Break` ends the integration there; the
/// [`End`](crate::End) says so. Observers go together as a pair, and to a run whose trajectory is
/// kept by [`InitialValueProblem::observer`](crate::InitialValueProblem::observer).
///
/// ```
/// use std::ops::ControlFlow;
/// use dmm_runtime::{Best, EndedBy, Integrator, on_point, on_transition, pws};
///
/// pws! {
///     /// A ball between two springs.
///     pub system Ball {
///         state x, v;
///         interface spring = x;
///         region free where spring > 0 { der(x) = v; der(v) = -1; }
///         region pressed where spring < 0 { der(x) = v; der(v) = -1 - 4*x; }
///     }
/// }
///
/// let (mut highest, mut bounces) = (0.0f64, 0);
/// let height = on_point(|point| highest = highest.max(point.x[0]));
/// let bounce = on_transition(|transition| {
///     bounces += u32::from(transition.to == BallRegion::Pressed);
///     if bounces == 10 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// });
/// let end = Integrator::new(&Ball {}, Best::tolerance(1e-12))
///     .initial(0.0, [1.0, 0.0])
///     .observe_until(1e6, &mut (height, bounce))?;
/// assert_eq!(end.ended_by, EndedBy::Observer);
/// assert_eq!(end.statistics.transitions, 19);
/// assert_eq!((highest, end.point.x[0].abs() < 1e-15), (1.0, true));
/// # Ok::<(), dmm_runtime::Error>(())
/// ```
pub fn on_point<R, const N: usize, A, F>(observe: F) -> OnPoint<F>
where
    A: IntoControlFlow,
    F: FnMut(&Point<R, N>) -> A,
{
    OnPoint(observe)
}

/// See [`on_point`].
#[derive(Clone, Copy, Debug)]
pub struct OnPoint<F>(F);

impl<R, const N: usize, A, F> Observer<R, N> for OnPoint<F>
where
    A: IntoControlFlow,
    F: FnMut(&Point<R, N>) -> A,
{
    fn point(&mut self, point: &Point<R, N>) -> ControlFlow<()> {
        (self.0)(point).into_control_flow()
    }
}

/// The observer that calls `observe` at each transition, as [`on_point`] does at each point. Of
/// points it is told nothing, so that steps are as fast as without it.
pub fn on_transition<R, const N: usize, A, F>(observe: F) -> OnTransition<F>
where
    A: IntoControlFlow,
    F: FnMut(&Transition<R, N>) -> A,
{
    OnTransition(observe)
}

/// See [`on_transition`].
#[derive(Clone, Copy, Debug)]
pub struct OnTransition<F>(F);

impl<R, const N: usize, A, F> Observer<R, N> for OnTransition<F>
where
    A: IntoControlFlow,
    F: FnMut(&Transition<R, N>) -> A,
{
    const LISTENS: bool = false;

    fn transition(&mut self, transition: &Transition<R, N>) -> ControlFlow<()> {
        (self.0)(transition).into_control_flow()
    }
}

/// The observer that calls `observe` at the first point after each `interval` of time, counted from
/// the start: to tell how far a long run has come.
///
/// The interval is in the unit of time of the system; of one that is not positive every point is
/// told. See [`on_point`] for what `observe` may return.
pub fn progress<R, const N: usize, A, F>(interval: f64, observe: F) -> Progress<F>
where
    A: IntoControlFlow,
    F: FnMut(&Point<R, N>) -> A,
{
    Progress {
        interval,
        start: None,
        told: 0.0,
        observe,
    }
}

/// See [`progress`].
#[derive(Clone, Copy, Debug)]
pub struct Progress<F> {
    interval: f64,
    /// The time of the start, once there is one.
    start: Option<f64>,
    /// How many intervals were over when it was last told.
    told: f64,
    observe: F,
}

impl<R, const N: usize, A, F> Observer<R, N> for Progress<F>
where
    A: IntoControlFlow,
    F: FnMut(&Point<R, N>) -> A,
{
    fn point(&mut self, point: &Point<R, N>) -> ControlFlow<()> {
        let start = *self.start.get_or_insert(point.t);
        let over = ((point.t - start) / self.interval).floor();
        // of an interval that is zero there is no number
        if over <= self.told && self.interval > 0.0 {
            return ControlFlow::Continue(());
        }
        self.told = over;
        (self.observe)(point).into_control_flow()
    }
}

/// Both, the first one first. Either of them ends the integration; both are told of the point or the
/// transition at which it ends.
impl<R, const N: usize, A: Observer<R, N>, B: Observer<R, N>> Observer<R, N> for (A, B) {
    const LISTENS: bool = A::LISTENS || B::LISTENS;

    fn point(&mut self, point: &Point<R, N>) -> ControlFlow<()> {
        either(self.0.point(point), self.1.point(point))
    }

    fn transition(&mut self, transition: &Transition<R, N>) -> ControlFlow<()> {
        either(self.0.transition(transition), self.1.transition(transition))
    }

    fn next_output(&self) -> Option<f64> {
        match (self.0.next_output(), self.1.next_output()) {
            (Some(first), Some(second)) => Some(first.min(second)),
            (first, second) => first.or(second),
        }
    }

    fn output(&mut self, point: &Point<R, N>) {
        if self.0.next_output().is_some_and(|t| t <= point.t) {
            self.0.output(point);
        }
        if self.1.next_output().is_some_and(|t| t <= point.t) {
            self.1.output(point);
        }
    }
}

/// `Break` if one of them is.
fn either(first: ControlFlow<()>, second: ControlFlow<()>) -> ControlFlow<()> {
    first?;
    second
}
