//! The integrator: a system, a scheme and a start, run until an end time.

use std::ops::ControlFlow;

use crate::end::{End, Halted};
use crate::error::{Error, invalid, number};
use crate::observer::Observer;
use crate::recording::Recording;
use crate::scheme::Scheme;
use crate::solution::{Interrupted, Solution};
use crate::state::State;
use crate::statistics::Statistics;
use crate::system::{System, Vector};
use crate::time::Time;
use crate::transition::{Locator, NewtonLocator, Start, check_guards, check_region, find_region};
use crate::walk::{Walk, run_segments};

/// Beyond it products of times overflow.
const LARGEST_TIME: f64 = 1e250;

/// An initial value problem ẋ = f(t, x), x(t₀) = x₀ for a piecewise-smooth system, with the
/// scheme to integrate it.
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
pub struct Integrator<'a, Sys, Sch, Loc = NewtonLocator> {
    pub(crate) system: &'a Sys,
    pub(crate) scheme: Sch,
    locator: Loc,
}

impl<'a, Sys, Sch: Scheme> Integrator<'a, Sys, Sch> {
    /// The integrator of `system` by `scheme`.
    pub fn new(system: &'a Sys, scheme: Sch) -> Self {
        Self {
            system,
            scheme,
            locator: NewtonLocator,
        }
    }
}

impl<'a, Sys, Sch: Scheme, Loc: Locator> Integrator<'a, Sys, Sch, Loc> {
    /// Replaces the locator of crossings (default: [`NewtonLocator`]).
    #[must_use]
    pub fn locator<Other: Locator>(self, locator: Other) -> Integrator<'a, Sys, Sch, Other> {
        Integrator {
            system: self.system,
            scheme: self.scheme,
            locator,
        }
    }

    /// The initial value x(t₀) = x₀.
    #[must_use]
    pub fn initial<const N: usize>(
        self,
        t0: f64,
        x0: impl Into<Vector<f64, N>>,
    ) -> InitialValueProblem<'a, Sys, Sch, Loc, N>
    where
        Sys: System<N>,
    {
        InitialValueProblem {
            integrator: self,
            t0,
            x0: x0.into(),
            region: None,
        }
    }
}

/// An [`Integrator`] with its initial value; see [`Integrator::initial`].
#[derive(Clone, Debug)]
pub struct InitialValueProblem<'a, Sys: System<N>, Sch, Loc, const N: usize> {
    pub(crate) integrator: Integrator<'a, Sys, Sch, Loc>,
    pub(crate) t0: f64,
    x0: Vector<f64, N>,
    region: Option<Sys::Region>,
}

impl<'a, Sys, Sch, Loc, const N: usize> InitialValueProblem<'a, Sys, Sch, Loc, N>
where
    Sys: System<N>,
    Sch: Scheme,
    Loc: Locator,
{
    /// Names the region to start in. Only a start on an interface from which both vector
    /// fields lead away needs it; elsewhere it is checked.
    #[must_use]
    pub fn region(self, region: Sys::Region) -> Self {
        Self {
            region: Some(region),
            ..self
        }
    }

    /// Keeps the ends of every `every`-th step only (default 1, at least 1); the start, the
    /// end and both sides of each transition are always kept.
    #[must_use]
    pub fn every(self, every: u64) -> Recording<'a, Sys, Sch, Loc, N> {
        Recording::new(self).every(every)
    }

    /// Keeps the solution at these times, in ascending order, instead of the ends of steps.
    /// The steps do not change.
    #[must_use]
    pub fn output_times(self, times: impl Into<Vec<f64>>) -> Recording<'a, Sys, Sch, Loc, N> {
        Recording::new(self).output_times(times)
    }

    /// Integrates until `t_end` and returns the trajectory, with the end of every step.
    ///
    /// # Errors
    /// Bad input, or whatever stopped the integration; the error carries the solution up to
    /// there.
    pub fn run_until(self, t_end: f64) -> Result<Solution<Sys, Sch, N>, Interrupted<Sys, Sch, N>> {
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
        let start = self.start(t_end).map_err(Halted::at_start)?;
        let mut walk = Walk {
            system: self.integrator.system,
            scheme: &self.integrator.scheme,
            locator: &self.integrator.locator,
            observer,
            progress: self.progress(t_end),
            time: Time::new(self.t0),
            state: State::new(self.x0),
            region: start.region,
            fresh: start.interface,
            statistics: Statistics::default(),
        };
        walk.start_outputs();
        let result = match walk.tell_point() {
            ControlFlow::Continue(()) => run_segments(&mut walk),
            ControlFlow::Break(()) => Ok(()),
        };
        let end = End {
            point: walk.point(),
            remainder: walk.state.remainder,
            statistics: walk.statistics,
        };
        match result {
            Ok(()) => Ok(end),
            Err(error) => Err(Halted::new(error, end)),
        }
    }

    /// The region to start in, after all input is checked.
    pub(crate) fn start(&self, t_end: f64) -> Result<Start<Sys::Region>, Error> {
        self.check_input(t_end)?;
        let system = self.integrator.system;
        let start = match self.region {
            Some(region) => check_region(system, region, self.t0, &self.x0),
            None => find_region(system, self.t0, &self.x0),
        }?;
        check_guards(system, start.region, self.t0, &self.x0)?;
        Ok(start)
    }

    pub(crate) fn progress(&self, t_end: f64) -> Sch::Progress {
        self.integrator.scheme.progress(self.t0, t_end)
    }

    fn check_input(&self, t_end: f64) -> Result<(), Error> {
        self.integrator.scheme.check(self.t0, t_end)?;
        if !self.t0.is_finite() {
            return invalid("initial time", number(self.t0), "must be finite");
        }
        if !(t_end.is_finite() && t_end >= self.t0) {
            return invalid(
                "end time",
                number(t_end),
                "must be finite and not before the initial time",
            );
        }
        if self.t0.abs().max(t_end.abs()) > LARGEST_TIME {
            return invalid(
                "time",
                format!("{:e}", self.t0.abs().max(t_end.abs())),
                "must be at most 1e250",
            );
        }
        if let Some(i) = (0..N).find(|&i| !self.x0[i].is_finite()) {
            return invalid(
                "initial state",
                format!("{} = {}", Sys::STATES[i], self.x0[i]),
                "must be finite",
            );
        }
        let parameters = self.integrator.system.parameters();
        if let Some((name, value)) = Sys::PARAMETERS
            .iter()
            .zip(parameters)
            .find(|(_, value)| !value.is_finite())
        {
            return invalid("parameter", format!("{name} = {value}"), "must be finite");
        }
        Ok(())
    }
}
