//! Where an observed integration ended, or was halted.

use std::fmt;

use super::Point;
use crate::contract::Vector;
use crate::error::Error;
use crate::method::Statistics;

/// Where an integration ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct End<R, const N: usize> {
    /// The last point.
    pub point: Point<R, N>,
    /// What is missing from the last point's state, which is rounded.
    pub remainder: Vector<f64, N>,
    /// What was done.
    pub statistics: Statistics,
    /// What ended it.
    pub ended_by: EndedBy,
}

/// What ended an integration, or halted it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EndedBy {
    /// The end time was reached.
    EndTime,
    /// An observer returned `Break`.
    Observer,
    /// An error, which is returned beside it.
    Error,
}

/// An observed integration that stopped before its end time, with the end that it reached.
///
/// ```
/// use dmm_runtime::{Integrator, Symmetric, pws};
///
/// pws! {
///     /// ẋ = x², which is infinite at t = 1/x(0).
///     pub system Blowup {
///         state x;
///         der(x) = x^2;
///     }
/// }
///
/// let halted = Integrator::new(&Blowup {}, Symmetric::step_size(1e-3))
///     .initial(0.0, [1.0])
///     .observe_until(2.0, &mut ())
///     .unwrap_err();
/// let end = halted.end().expect("the start was valid");
/// assert!((end.point.t - 1.0).abs() < 0.01 && end.statistics.steps > 900);
/// ```
#[derive(Clone, PartialEq)]
pub struct Halted<R, const N: usize> {
    error: Error,
    end: Option<Box<End<R, N>>>,
}

impl<R, const N: usize> Halted<R, N> {
    pub(crate) fn new(error: Error, end: End<R, N>) -> Self {
        Self {
            error,
            end: Some(Box::new(end)),
        }
    }

    /// By bad input.
    pub(crate) fn at_start(error: Error) -> Self {
        Self { error, end: None }
    }

    /// What stopped it.
    pub fn error(&self) -> &Error {
        &self.error
    }

    /// The last point and what was done until then; nothing if the input was bad and nothing
    /// was integrated.
    pub fn end(&self) -> Option<&End<R, N>> {
        self.end.as_deref()
    }

    /// Both.
    pub fn into_parts(self) -> (Error, Option<End<R, N>>) {
        (self.error, self.end.map(|end| *end))
    }
}

impl<R, const N: usize> From<Halted<R, N>> for Error {
    fn from(halted: Halted<R, N>) -> Self {
        halted.error
    }
}

/// As [`Error`].
impl<R, const N: usize> fmt::Debug for Halted<R, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt_as_text_or(f, |f| {
            f.debug_struct("Halted")
                .field("error", &self.error)
                .field("t", &self.end.as_ref().map(|end| end.point.t))
                .finish_non_exhaustive()
        })
    }
}

impl<R, const N: usize> fmt::Display for Halted<R, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl<R, const N: usize> std::error::Error for Halted<R, N> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.error.source()
    }
}
