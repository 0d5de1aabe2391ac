//! The integrator: a system, a scheme and a start, run until an end time.

use std::ops::ControlFlow;

use super::Recording;
use super::run::Run;
use super::start::Start;
use crate::contract::{InitialState, System, Vector};
use crate::error::{Error, ErrorKind, invalid, number};
use crate::method::Method;
use crate::output::{End, EndedBy, Halted, Interrupted, Observer, Point, Solution};

/// Beyond it products of times overflow.
const LARGEST_TIME: f64 = 1e250;

/// An initial value problem ẋ = f(t, x), x(t₀) = x₀ for a piecewise-smooth system, with the
/// method to integrate it.
///
/// ```
/// use dmm_runtime::{Integrator, Symmetric, pws};
///
/// pws! {
///     /// A pendulum.
///     pub system Pendulum {
///         state q, p;
///         param k = 1.0;
///         der(q) = p;
///         der(p) = -k * sin(q);
///         conserved energy = p^2 / 2 - k * cos(q);
///     }
/// }
///
/// let system = Pendulum { k: 4.0 };
/// let solution = Integrator::new(&system, Symmetric::step_size(1e-2))
///     .initial(0.0, [0.5, 1.0])
///     .run_until(10.0)?;
/// let x = solution.at(3.7)?;
/// let energy = |x: &[f64]| x[1].powi(2) / 2.0 - 4.0 * x[0].cos();
/// assert!((energy(x.as_slice()) - energy(&[0.5, 1.0])).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Integrator<'a, Sys, Met> {
    pub(crate) system: &'a Sys,
    pub(crate) method: Met,
}

impl<'a, Sys, Met: Method> Integrator<'a, Sys, Met> {
    /// The integrator of `system` by `method`.
    pub fn new(system: &'a Sys, method: Met) -> Self {
        Self { system, method }
    }

    /// The initial value x(t₀) = x₀: an array, a vector or a slice, see [`InitialState`].
    #[must_use]
    pub fn initial<const N: usize>(
        self,
        t0: f64,
        x0: impl InitialState<Sys, N>,
    ) -> InitialValueProblem<'a, Sys, Met, N>
    where
        Sys: System<N>,
    {
        InitialValueProblem {
            t0,
            x0: x0.into_state(self.system),
            integrator: self,
            region: None,
        }
    }
}

/// An [`Integrator`] with its initial value; see [`Integrator::initial`].
#[derive(Clone, Debug)]
pub struct InitialValueProblem<'a, Sys: System<N>, Met, const N: usize> {
    pub(crate) integrator: Integrator<'a, Sys, Met>,
    pub(crate) t0: f64,
    /// A slice of the wrong length is refused when the run starts.
    pub(crate) x0: Result<Vector<f64, N>, Error>,
    pub(crate) region: Option<Sys::Region>,
}

impl<'a, Sys, Met, const N: usize> InitialValueProblem<'a, Sys, Met, N>
where
    Sys: System<N>,
    Met: Method,
{
    /// Names the region to start in. Only a start on an interface from which both vector
    /// fields lead away needs it; elsewhere it is checked.
    ///
    /// A run is started again from a transition point with the region that was entered, whatever
    /// sign rounding has left of g there:
    ///
    /// ```
    /// use dmm_runtime::{Best, Integrator, pws};
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
    /// let from = |t, x| Integrator::new(&Ball {}, Best::tolerance(1e-12)).initial(t, x);
    /// let whole = from(0.0, [1.0, 0.0].into()).run_until(20.0)?;
    /// for transition in whole.transitions() {
    ///     let rest = from(transition.t, transition.x).region(transition.to).run_until(20.0)?;
    ///     let after = whole.transitions().iter().filter(|other| other.t > transition.t).count();
    ///     assert_eq!(rest.transitions().len(), after);
    ///     assert!((rest.at(20.0)? - whole.at(20.0)?).norm() < 1e-12);
    /// }
    /// # Ok::<(), dmm_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn region(self, region: Sys::Region) -> Self {
        Self {
            region: Some(region),
            ..self
        }
    }

    /// Keeps the ends of every `every`-th step only (default 1; 0 is refused); the start, the
    /// end and both sides of each transition are always kept.
    #[must_use]
    pub fn every(self, every: u64) -> Recording<'a, Sys, Met, N> {
        Recording::new(self).every(every)
    }

    /// Keeps the solution at these times, in ascending order, instead of the ends of steps.
    /// The steps do not change.
    #[must_use]
    pub fn output_times(self, times: impl Into<Vec<f64>>) -> Recording<'a, Sys, Met, N> {
        Recording::new(self).output_times(times)
    }

    /// Limits the memory for points and transitions, in bytes; see [`Recording::memory_limit`].
    #[must_use]
    pub fn memory_limit(self, bytes: usize) -> Recording<'a, Sys, Met, N> {
        Recording::new(self).memory_limit(bytes)
    }

    /// Tells `observer` of the run whose trajectory is kept; see [`Recording::observer`].
    #[must_use]
    pub fn observer<Obs: Observer<Sys::Region, N>>(
        self,
        observer: Obs,
    ) -> Recording<'a, Sys, Met, N, Obs> {
        Recording::observed(self, observer)
    }

    /// Integrates until `t_end` and returns the trajectory, with the end of every step.
    ///
    /// It is kept in memory, 1 GiB of it at most ([`Recording::memory_limit`]). Of a long run keep
    /// a part by [`every`](Self::every) or [`output_times`](Self::output_times), or watch it in
    /// constant memory by [`observe_until`](Self::observe_until).
    ///
    /// # Errors
    /// Bad input, or whatever stopped the integration, the limit of memory among it; the error
    /// carries the solution up to there.
    pub fn run_until(self, t_end: f64) -> Result<Solution<Sys, Met, N>, Interrupted<Sys, Met, N>> {
        Recording::new(self).run_until(t_end)
    }

    /// Integrates until `t_end` in constant memory, telling `observer` of it. What it is told
    /// of is the observer's to choose: see [`Observer::next_output`] for output at given times.
    ///
    /// # Errors
    /// Bad input, or whatever stopped the integration; the error carries the end that was
    /// reached and what was done until then.
    pub fn observe_until<Obs: Observer<Sys::Region, N>>(
        &self,
        t_end: f64,
        observer: &mut Obs,
    ) -> Result<End<Sys::Region, N>, Halted<Sys::Region, N>> {
        let (x0, start) = self.start(t_end).map_err(Halted::at_start)?;
        let Integrator { system, method } = &self.integrator;
        let system = *system;
        let mut memory = self.memory(t_end);
        let mut run = Run::new(system, (self.t0, x0), start);
        while let Some(t) = observer.next_output()
            && t <= self.t0
        {
            observer.output(&Point { t, ..run.point() });
        }
        let result = match observer.point(&run.point()) {
            ControlFlow::Continue(()) => {
                run.run_until(system, (method, &mut memory), t_end, observer)
            }
            ControlFlow::Break(()) => Ok(EndedBy::Observer),
        };
        match result {
            Ok(ended_by) => Ok(run.end(ended_by)),
            Err(error) => Err(Halted::new(error, run.end(EndedBy::Error))),
        }
    }

    /// The state and the region to start in, after all input is checked.
    pub(crate) fn start(&self, t_end: f64) -> Result<(Vector<f64, N>, Start<Sys::Region>), Error> {
        let Integrator { system, method } = &self.integrator;
        method.check(self.t0, t_end)?;
        check_times(self.t0, t_end)?;
        let x0 = self.x0.clone()?;
        let start = Start::checked(*system, (self.region, None), (self.t0, t_end), &x0)?;
        Ok((x0, start))
    }

    pub(crate) fn memory(&self, t_end: f64) -> Met::Memory<N> {
        self.integrator.method.memory(self.t0, t_end)
    }
}

/// Checks the ends of a run.
pub(super) fn check_times(t0: f64, t_end: f64) -> Result<(), Error> {
    if !t0.is_finite() {
        return invalid("initial time", number(t0), "must be finite");
    }
    if !t_end.is_finite() {
        return invalid("end time", number(t_end), "must be finite");
    }
    if t_end < t0 {
        return Err(ErrorKind::BackwardTime { t0, t_end }.into());
    }
    if t0.abs().max(t_end.abs()) > LARGEST_TIME {
        return invalid(
            "time",
            format!("{:e}", t0.abs().max(t_end.abs())),
            "must be at most 1e250",
        );
    }
    Ok(())
}
