//! An integration that is recorded, and which of its points are kept.

use crate::end::Halted;
use crate::error::Error;
use crate::integrator::InitialValueProblem;
use crate::scheme::Scheme;
use crate::solution::{Interrupted, Recorder, Solution};
use crate::statistics::Statistics;
use crate::system::System;
use crate::transition::Locator;

/// An [`InitialValueProblem`] whose trajectory is to be kept, with what is kept of it; see
/// [`InitialValueProblem::every`] and [`InitialValueProblem::output_times`].
#[derive(Clone, Debug)]
pub struct Recording<'a, Sys: System<N>, Sch, Loc, const N: usize> {
    problem: InitialValueProblem<'a, Sys, Sch, Loc, N>,
    every: u64,
    output_times: Option<Vec<f64>>,
}

impl<'a, Sys, Sch, Loc, const N: usize> Recording<'a, Sys, Sch, Loc, N>
where
    Sys: System<N>,
    Sch: Scheme,
    Loc: Locator,
{
    /// Of every step.
    pub(crate) fn new(problem: InitialValueProblem<'a, Sys, Sch, Loc, N>) -> Self {
        Self {
            problem,
            every: 1,
            output_times: None,
        }
    }

    /// See [`InitialValueProblem::region`].
    #[must_use]
    pub fn region(self, region: Sys::Region) -> Self {
        Self {
            problem: self.problem.region(region),
            ..self
        }
    }

    /// See [`InitialValueProblem::every`].
    #[must_use]
    pub fn every(self, every: u64) -> Self {
        Self {
            every: every.max(1),
            ..self
        }
    }

    /// See [`InitialValueProblem::output_times`].
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
        let result = match self.check_output_times(t_end) {
            Ok(()) => self.problem.observe_until(t_end, &mut recorder),
            Err(error) => Err(Halted::at_start(error)),
        };
        recorder.finish();
        let (error, statistics) = match result {
            Ok(end) => (None, end.statistics),
            Err(halted) => {
                let (error, end) = halted.into_parts();
                let statistics = end.map_or_else(Statistics::default, |end| end.statistics);
                (Some(error), statistics)
            }
        };
        let solution = Solution::new(
            self.problem.integrator.system.clone(),
            self.problem.integrator.scheme.clone(),
            self.problem.progress(t_end),
            recorder,
            statistics,
        );
        match error {
            None => Ok(solution),
            Some(error) => Err(Interrupted::new(error, solution)),
        }
    }

    fn check_output_times(&self, t_end: f64) -> Result<(), Error> {
        let times = self.output_times.as_deref().unwrap_or_default();
        let mut previous = self.problem.t0;
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
