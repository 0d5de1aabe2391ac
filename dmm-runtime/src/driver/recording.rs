//! An integration that is recorded, and which of its points are kept.

use super::InitialValueProblem;
use crate::contract::System;
use crate::error::{Error, ErrorKind, invalid};
use crate::method::{Method, Statistics};
use crate::output::{EndedBy, Halted, Interrupted, Observer, Recorder, Solution};

/// The memory for points and transitions, unless [`Recording::memory_limit`] says otherwise: 1 GiB.
const MEMORY_LIMIT: usize = 1 << 30;

/// An [`InitialValueProblem`] whose trajectory is to be kept, with what is kept of it; see
/// [`InitialValueProblem::every`] and [`InitialValueProblem::output_times`].
#[derive(Clone, Debug)]
pub struct Recording<'a, Sys: System<N>, Met, const N: usize, Obs = ()> {
    problem: InitialValueProblem<'a, Sys, Met, N>,
    every: u64,
    output_times: Option<Vec<f64>>,
    memory_limit: usize,
    observer: Obs,
}

impl<'a, Sys: System<N>, Met, const N: usize, Obs> Recording<'a, Sys, Met, N, Obs> {
    /// Of every step, told to an observer besides.
    pub(crate) fn observed(problem: InitialValueProblem<'a, Sys, Met, N>, observer: Obs) -> Self {
        Self {
            problem,
            every: 1,
            output_times: None,
            memory_limit: MEMORY_LIMIT,
            observer,
        }
    }
}

impl<'a, Sys: System<N>, Met, const N: usize> Recording<'a, Sys, Met, N> {
    /// Of every step.
    pub(crate) fn new(problem: InitialValueProblem<'a, Sys, Met, N>) -> Self {
        Self::observed(problem, ())
    }
}

impl<'a, Sys, Met, const N: usize, Obs> Recording<'a, Sys, Met, N, Obs>
where
    Sys: System<N>,
    Met: Method,
    Obs: Observer<Sys::Region, N>,
{
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
        Self { every, ..self }
    }

    /// See [`InitialValueProblem::output_times`].
    #[must_use]
    pub fn output_times(self, times: impl Into<Vec<f64>>) -> Self {
        Self {
            output_times: Some(times.into()),
            ..self
        }
    }

    /// Limits the memory for points and transitions, in bytes (default: 2³⁰, 1 GiB).
    ///
    /// A point takes 8N + 32 bytes about. A run that needs more ends there with
    /// [`ErrorKind::MemoryLimit`], and [`Interrupted`] carries all that was kept. So does a run for
    /// which the machine has no more memory.
    ///
    /// ```
    /// use dmm_runtime::{ErrorKind, Integrator, Symmetric, pws};
    ///
    /// pws! {
    ///     /// A pendulum.
    ///     pub system Pendulum {
    ///         state q, p;
    ///         der(q) = p;
    ///         der(p) = -sin(q);
    ///         conserved energy = p^2 / 2 - cos(q);
    ///     }
    /// }
    ///
    /// let problem = Integrator::new(&Pendulum {}, Symmetric::step_size(1e-2)).initial(0.0, [0.5, 1.0]);
    /// let recording = problem.memory_limit(100_000);
    /// let interrupted = recording.clone().run_until(1e9).unwrap_err();
    /// assert!(matches!(interrupted.error().kind, ErrorKind::MemoryLimit { bytes: 100_000, .. }));
    /// let kept = interrupted.solution();
    /// assert!(kept.points().len() > 1000 && kept.at(10.0).is_ok());
    /// // of a hundred times as long a run, every hundredth point
    /// let long = recording.every(100).run_until(1000.0)?;
    /// assert_eq!(long.points().len(), 1001);
    /// # Ok::<(), dmm_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn memory_limit(self, bytes: usize) -> Self {
        Self {
            memory_limit: bytes,
            ..self
        }
    }

    /// Tells `observer` of the run besides. Its `Break` ends the run, and the solution up to there
    /// is returned; [`Solution::ended_by`] says so.
    ///
    /// It sees the ends of steps, and exact flows take steps as long as there is no interface in
    /// them. Where a run is to end at a point, declare an interface there.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use dmm_runtime::{EndedBy, Integrator, Symmetric, on_point, pws};
    ///
    /// pws! {
    ///     /// Free fall.
    ///     pub system Fall {
    ///         state z, v;
    ///         der(z) = v;
    ///         der(v) = -1;
    ///     }
    /// }
    ///
    /// let solution = Integrator::new(&Fall {}, Symmetric::step_size(0.125))
    ///     .initial(0.0, [10.0, 0.0])
    ///     .observer(on_point(|point| {
    ///         if point.x[0] < 5.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    ///     }))
    ///     .run_until(1e6)?;
    /// assert_eq!(solution.ended_by(), EndedBy::Observer);
    /// assert_eq!(solution.last().map(|end| end.t), Some(3.25));
    /// # Ok::<(), dmm_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn observer<Other: Observer<Sys::Region, N>>(
        self,
        observer: Other,
    ) -> Recording<'a, Sys, Met, N, (Obs, Other)> {
        Recording {
            problem: self.problem,
            every: self.every,
            output_times: self.output_times,
            memory_limit: self.memory_limit,
            observer: (self.observer, observer),
        }
    }

    /// Integrates until `t_end` and returns the trajectory; see [`InitialValueProblem::run_until`].
    ///
    /// # Errors
    /// Bad input, or whatever stopped the integration, the limit of memory among it; the error
    /// carries the solution up to there.
    pub fn run_until(
        mut self,
        t_end: f64,
    ) -> Result<Solution<Sys, Met, N>, Interrupted<Sys, Met, N>> {
        let checked = self.check(t_end);
        let recorder = Recorder::new(self.every, self.output_times, self.memory_limit);
        let mut observers = (recorder, &mut self.observer);
        let result = match checked {
            Ok(()) => self.problem.observe_until(t_end, &mut observers),
            Err(error) => Err(Halted::at_start(error)),
        };
        let (mut recorder, _) = observers;
        recorder.finish();
        let system = self.problem.integrator.system;
        let full = recorder.out_of_memory(system);
        let (error, statistics, ended_by) = match result {
            Ok(end) => (full, end.statistics, end.ended_by),
            Err(halted) => {
                let (error, end) = halted.into_parts();
                let statistics = end.map_or_else(Statistics::default, |end| end.statistics);
                (Some(error), statistics, EndedBy::Error)
            }
        };
        let ended_by = match error {
            Some(_) => EndedBy::Error,
            None => ended_by,
        };
        let memory = self.problem.memory(t_end);
        let method = self.problem.integrator.method;
        let ended = (statistics, ended_by);
        let solution = Solution::new(system.clone(), method, memory, recorder, ended);
        match error {
            None => Ok(solution),
            Some(error) => Err(Interrupted::new(error, solution)),
        }
    }

    /// Checks what is to be kept.
    fn check(&self, t_end: f64) -> Result<(), Error> {
        if self.every == 0 {
            return invalid("every", self.every.to_string(), "must be at least 1");
        }
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
