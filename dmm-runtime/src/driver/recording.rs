//! An integration that is recorded, and which of its points are kept.

use super::InitialValueProblem;
use crate::contract::System;
use crate::error::{Error, ErrorKind};
use crate::method::Method;
use crate::method::Statistics;
use crate::output::Halted;
use crate::output::{Interrupted, Recorder, Solution};

/// An [`InitialValueProblem`] whose trajectory is to be kept, with what is kept of it; see
/// [`InitialValueProblem::every`] and [`InitialValueProblem::output_times`].
#[derive(Clone, Debug)]
pub struct Recording<'a, Sys: System<N>, Met, const N: usize> {
    problem: InitialValueProblem<'a, Sys, Met, N>,
    every: u64,
    output_times: Option<Vec<f64>>,
}

impl<'a, Sys, Met, const N: usize> Recording<'a, Sys, Met, N>
where
    Sys: System<N>,
    Met: Method,
{
    /// Of every step.
    pub(crate) fn new(problem: InitialValueProblem<'a, Sys, Met, N>) -> Self {
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
    pub fn run_until(self, t_end: f64) -> Result<Solution<Sys, Met, N>, Interrupted<Sys, Met, N>> {
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
            self.problem.integrator.method.clone(),
            self.problem.memory(t_end),
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
                return Err(ErrorKind::InvalidInput {
                    what: "output time",
                    value: t.to_string(),
                    requirement: "must lie between the initial and the end time, in ascending \
                                  order",
                }
                .into());
            }
            previous = t;
        }
        Ok(())
    }
}
