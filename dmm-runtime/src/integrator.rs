//! The integrator: a system, a scheme and a start, run until an end time.

use std::ops::ControlFlow;

use crate::error::Error;
use crate::observer::{Observer, Point};
use crate::scheme::Scheme;
use crate::solution::{Interrupted, Recorder, Solution};
use crate::state::State;
use crate::statistics::Statistics;
use crate::system::{System, Vector};
use crate::time::{Grid, Time};
use crate::transition::{Locator, NewtonLocator, check_region, find_region};
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
    system: &'a Sys,
    scheme: Sch,
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
            every: 1,
            output_times: None,
        }
    }
}

/// An [`Integrator`] with its initial value; see [`Integrator::initial`].
#[derive(Clone, Debug)]
pub struct InitialValueProblem<'a, Sys: System<N>, Sch, Loc, const N: usize> {
    integrator: Integrator<'a, Sys, Sch, Loc>,
    t0: f64,
    x0: Vector<f64, N>,
    region: Option<Sys::Region>,
    every: u64,
    output_times: Option<Vec<f64>>,
}

/// Where an integration ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct End<R, const N: usize> {
    /// The last point.
    pub point: Point<R, N>,
    /// What is missing from the last point's state, which is rounded.
    pub remainder: Vector<f64, N>,
    /// What was done.
    pub statistics: Statistics,
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
    pub fn every(self, every: u64) -> Self {
        Self {
            every: every.max(1),
            ..self
        }
    }

    /// Keeps the solution at these times, in ascending order, instead of the ends of steps.
    /// The steps do not change.
    #[must_use]
    pub fn output_times(self, times: impl Into<Vec<f64>>) -> Self {
        Self {
            output_times: Some(times.into()),
            ..self
        }
    }

    /// Integrates until `t_end` and returns the trajectory.
    ///
    /// # Errors
    /// Bad input, or whatever stopped the integration; the error carries the solution up to
    /// there.
    pub fn run_until(self, t_end: f64) -> Result<Solution<Sys, Sch, N>, Interrupted<Sys, Sch, N>> {
        let mut recorder = Recorder::new(self.every, self.output_times.clone());
        let mut statistics = Statistics::default();
        let result = self
            .check_output_times(t_end)
            .and_then(|()| self.walk(t_end, &mut recorder, &mut statistics));
        recorder.finish();
        let solution = Solution::new(
            self.integrator.system.clone(),
            self.integrator.scheme.clone(),
            self.grid(t_end),
            recorder,
            statistics,
        );
        match result {
            Ok(_) => Ok(solution),
            Err(error) => Err(Interrupted::new(error, solution)),
        }
    }

    /// Integrates until `t_end` in constant memory, telling `observer` of it.
    ///
    /// # Errors
    /// Bad input, or whatever stopped the integration.
    pub fn observe_until<Obs: Observer<Sys::Region, N>>(
        &self,
        t_end: f64,
        observer: &mut Obs,
    ) -> Result<End<Sys::Region, N>, Error> {
        self.walk(t_end, observer, &mut Statistics::default())
    }

    /// Integrates; `statistics` tells what was done even if it stops early.
    fn walk<Obs: Observer<Sys::Region, N>>(
        &self,
        t_end: f64,
        observer: &mut Obs,
        statistics: &mut Statistics,
    ) -> Result<End<Sys::Region, N>, Error> {
        self.check_input(t_end)?;
        let system = self.integrator.system;
        let start = match self.region {
            Some(region) => check_region(system, region, self.t0, &self.x0)?,
            None => find_region(system, self.t0, &self.x0)?,
        };
        let mut walk = Walk {
            system,
            scheme: &self.integrator.scheme,
            locator: &self.integrator.locator,
            observer,
            grid: self.grid(t_end),
            node: 1,
            at_node: true,
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
        *statistics = walk.statistics;
        result.map(|()| End {
            point: walk.point(),
            remainder: walk.state.remainder,
            statistics: walk.statistics,
        })
    }

    fn grid(&self, t_end: f64) -> Grid {
        Grid::new(self.t0, t_end, self.integrator.scheme.step_size())
    }

    fn check_input(&self, t_end: f64) -> Result<(), Error> {
        let step_size = self.integrator.scheme.step_size();
        let invalid = |what, value: String, requirement| {
            Err(Error::InvalidInput {
                what,
                value,
                requirement,
            })
        };
        if !(step_size > 0.0 && step_size.is_finite()) {
            return invalid(
                "step size",
                step_size.to_string(),
                "must be positive and finite",
            );
        }
        if !self.t0.is_finite() {
            return invalid("initial time", self.t0.to_string(), "must be finite");
        }
        if !(t_end.is_finite() && t_end >= self.t0) {
            return invalid(
                "end time",
                t_end.to_string(),
                "must be finite and not before the initial time",
            );
        }
        if t_end > self.t0
            && self.t0.abs().max(t_end.abs()) + step_size == self.t0.abs().max(t_end.abs())
        {
            return invalid(
                "step size",
                step_size.to_string(),
                "is below the rounding error of the time",
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

    fn check_output_times(&self, t_end: f64) -> Result<(), Error> {
        let times = self.output_times.as_deref().unwrap_or_default();
        let mut previous = self.t0;
        for &t in times {
            if !(t >= previous && t <= t_end) {
                return Err(Error::InvalidInput {
                    what: "output time",
                    value: t.to_string(),
                    requirement: "must lie between the initial and the end time, in ascending \
                                  order",
                });
            }
            previous = t;
        }
        Ok(())
    }
}
