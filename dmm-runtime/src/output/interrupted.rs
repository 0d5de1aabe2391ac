//! A run that stopped before its end time.

use std::fmt;

use super::Solution;
use crate::contract::System;
use crate::error::Error;
use crate::method::Method;

/// An integration that stopped before its end time, with the solution up to there.
///
/// `?` turns it into an [`Error`], which is all that a function may want to return:
///
/// ```
/// use dmm_runtime::{Best, Integrator, pws};
///
/// pws! {
///     /// ẋ = x², which is infinite at t = 1/x(0).
///     pub system Blowup {
///         state x;
///         der(x) = x^2;
///     }
/// }
///
/// fn end(t_end: f64) -> Result<f64, dmm_runtime::Error> {
///     let problem = Integrator::new(&Blowup {}, Best::tolerance(1e-12)).initial(0.0, [1.0]);
///     let solution = problem.run_until(t_end)?;
///     solution.at(t_end).map(|x| x[0])
/// }
///
/// assert!((end(0.5).unwrap() - 2.0).abs() < 1e-10);
/// let error = end(2.0).unwrap_err();
/// assert!(error.place().is_some_and(|place| (place.t - 1.0).abs() < 1e-6));
/// // `main` prints an error that it returns by `Debug`: as text
/// assert_eq!(format!("{error:?}"), error.to_string());
/// ```
pub struct Interrupted<Sys: System<N>, Met: Method, const N: usize> {
    error: Error,
    solution: Box<Solution<Sys, Met, N>>,
}

impl<Sys: System<N>, Met: Method, const N: usize> Interrupted<Sys, Met, N> {
    pub(crate) fn new(error: Error, solution: Solution<Sys, Met, N>) -> Self {
        Self {
            error,
            solution: Box::new(solution),
        }
    }

    /// What stopped it.
    pub fn error(&self) -> &Error {
        &self.error
    }

    /// What was computed before.
    pub fn solution(&self) -> &Solution<Sys, Met, N> {
        &self.solution
    }

    /// Both.
    pub fn into_parts(self) -> (Error, Solution<Sys, Met, N>) {
        (self.error, *self.solution)
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> From<Interrupted<Sys, Met, N>> for Error {
    fn from(interrupted: Interrupted<Sys, Met, N>) -> Self {
        interrupted.error
    }
}

/// As [`Error`].
impl<Sys: System<N>, Met: Method, const N: usize> fmt::Debug for Interrupted<Sys, Met, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt_as_text_or(f, |f| {
            f.debug_struct("Interrupted")
                .field("error", &self.error)
                .field("points", &self.solution.points().len())
                .finish_non_exhaustive()
        })
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> fmt::Display for Interrupted<Sys, Met, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl<Sys: System<N>, Met: Method, const N: usize> std::error::Error for Interrupted<Sys, Met, N> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.error.source()
    }
}
