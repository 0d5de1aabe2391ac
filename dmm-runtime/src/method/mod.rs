//! Methods of integration: each moves a cursor through one mode of a system.
//!
//! A [`Method`] sees the [`Dynamics`] of the mode, the [`Cursor`], what it remembers itself, and a
//! [`Sink`] for what happens. It knows neither the system nor the names of its modes, and nothing
//! of the driver, which decides on the next mode.

pub(crate) mod best;
mod cursor;
pub(crate) mod exact;
mod failure;
pub(crate) mod one_step;
mod sink;
mod statistics;
pub(crate) mod taylor;
mod variation;

pub(crate) use cursor::{Active, Cursor, Several};
pub use failure::StepFailure;
pub(crate) use failure::{Failure, FailureKind};
pub(crate) use sink::{Listener, Observed, Silent, Sink};
pub use statistics::Statistics;
pub use variation::Variation;

use std::fmt::Debug;

use crate::arithmetic::{Scalar, Vector};
use crate::contract::Dynamics;
use crate::error::{Error, invalid, number};

/// What an [`Integrator`](crate::Integrator) integrates by: [`Best`](crate::Best),
/// [`Taylor`](crate::Taylor), or a one-step scheme such as [`Symmetric`](crate::Symmetric) with
/// [`Uniform`](crate::Uniform) or [`Adaptive`](crate::Adaptive) steps.
pub trait Method: Clone + Sync {
    /// What is carried from segment to segment.
    type Memory<const N: usize>: Clone + Debug;

    /// Checks the settings for a run.
    ///
    /// # Errors
    /// Settings that make no sense.
    fn check(&self, t0: f64, t_end: f64) -> Result<(), Error>;

    /// What an ensemble that integrates in lanes by Taylor's method is to keep to, if the method is
    /// that.
    fn in_lanes(&self) -> Option<InLanes> {
        None
    }

    /// The memory at the start of a run.
    fn memory<const N: usize>(&self, t0: f64, t_end: f64) -> Self::Memory<N>;

    /// Forgets what was prepared for modes by their numbers.
    fn forget_modes<const N: usize>(&self, _memory: &mut Self::Memory<N>) {}

    /// Steps in one mode, until one of its guards is met or the time `until` is reached.
    ///
    /// # Errors
    /// A step that cannot be made; the cursor is at its start.
    fn segment<D, S, const N: usize, const M: usize>(
        &self,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        until: f64,
        memory: &mut Self::Memory<N>,
        sink: &mut S,
    ) -> Result<Ended, Failure>
    where
        D: Dynamics<f64, N, M>,
        S: Sink<N>;

    /// Moves the cursor to the time `to` in the same mode, whatever its guards do.
    ///
    /// # Errors
    /// A step that cannot be made; the cursor is at its start.
    fn reach<D, const N: usize, const M: usize>(
        &self,
        memory: &Self::Memory<N>,
        dynamics: &D,
        cursor: &mut Cursor<N>,
        to: f64,
    ) -> Result<(), Failure>
    where
        D: Dynamics<f64, N, M>;

    /// The increment of a step over dual numbers, whose derivatives are those of the step; nothing if
    /// there are none.
    fn differentiate<D, S, const N: usize, const M: usize>(
        &self,
        step: &Variation<'_, D, S, N>,
    ) -> Option<Vector<S, N>>
    where
        D: Dynamics<S, N, M>,
        S: Scalar;
}

/// The settings of Taylor's method in lanes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct InLanes {
    pub(crate) tolerance: f64,
    pub(crate) level_correction: bool,
}

/// How a segment ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Ended {
    /// At the end time.
    Finished,
    /// By the sink's wish.
    Stopped,
    /// At a guard; the cursor's time and state are (t̂*, x̂*).
    AtGuard {
        /// Which one.
        guard: usize,
        /// dg/dt under the mode's field.
        rate: f64,
    },
}

/// Refuses a tolerance that no step can have.
fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    if (f64::EPSILON..=0.1).contains(&tolerance) {
        return Ok(());
    }
    let requirement = "must lie between 2.2e-16 and 0.1";
    invalid("tolerance", number(tolerance), requirement)
}
