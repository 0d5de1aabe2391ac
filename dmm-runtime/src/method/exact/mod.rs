//! The exact flow of a mode whose field is affine, ẋ = A x + b: propagators over steps of many
//! sizes, and bounds of how the guards' functions bend in a step.

mod crossing;
mod propagator;
mod segment;
mod short;
mod step_sizes;
mod steps;
mod switching;

use super::{Cursor, Ended, Failure, Sink, StepFailure};
use crate::arithmetic::Time;
use crate::arithmetic::linear::is_finite;
use crate::contract::{Dynamics, Guards};
use segment::Segment;
use step_sizes::StepSizes;
use steps::Progress;

/// Beyond so many states a propagator, a full matrix, costs more than the recurrences of a Taylor
/// step of a field that has a few terms a component.
const LARGEST: usize = 8;

/// Whether a mode is integrated by its exact flow: f and the functions of its guards are affine,
/// and there are few states.
#[inline(always)]
pub(super) fn is_exact<D: Dynamics<f64, N, M>, const N: usize, const M: usize>(
    dynamics: &D,
) -> bool {
    dynamics.is_affine() && dynamics.guards().is_affine()
}

/// The same, where the type tells: then the other kind of flow is not compiled.
pub(super) const fn is_exact_type<D: Dynamics<f64, N, M>, const N: usize, const M: usize>()
-> Option<bool> {
    match (D::AFFINE, <D::Guards as Guards<f64, N>>::AFFINE) {
        _ if N > LARGEST => Some(false),
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}

/// What exact flows carry from segment to segment.
#[derive(Clone, Debug)]
pub(crate) struct Memory<const N: usize> {
    /// By mode.
    step_sizes: Vec<Option<StepSizes<N>>>,
    /// Of a segment that was stopped between two steps.
    stopped: Option<Progress<N>>,
}

impl<const N: usize> Default for Memory<N> {
    fn default() -> Self {
        Self {
            step_sizes: Vec::new(),
            stopped: None,
        }
    }
}

impl<const N: usize> Memory<N> {
    /// The step sizes of a mode, made if there are none; nothing if they cannot be.
    #[inline(always)]
    fn of(
        &mut self,
        mode: usize,
        make: impl FnOnce() -> Option<StepSizes<N>>,
    ) -> Option<(&mut StepSizes<N>, &mut Option<Progress<N>>)> {
        let is_known = matches!(self.step_sizes.get(mode), Some(Some(_)));
        if !is_known {
            self.keep(mode, make()?);
        }
        let step_sizes = self.step_sizes.get_mut(mode)?.as_mut()?;
        Some((step_sizes, &mut self.stopped))
    }

    #[cold]
    fn keep(&mut self, mode: usize, step_sizes: StepSizes<N>) {
        if self.step_sizes.len() <= mode {
            self.step_sizes.resize_with(mode + 1, || None);
        }
        self.step_sizes[mode] = Some(step_sizes);
    }
}

/// Steps of the exact flow in one mode, until a guard is met or the time `until` is reached.
pub(super) fn segment<D, S, const N: usize, const M: usize>(
    dynamics: &D,
    cursor: &mut Cursor<N>,
    until: f64,
    memory: &mut Memory<N>,
    (sink, corrects_level): (&mut S, bool),
) -> Result<Ended, Failure>
where
    D: Dynamics<f64, N, M>,
    S: Sink<N>,
{
    let end = Time::new(until);
    let remaining = end.since(cursor.time);
    if remaining <= 0.0 {
        return Ok(Ended::Finished);
    }
    let step_sizes = memory.of(cursor.mode, || StepSizes::new(dynamics, remaining));
    let Some((step_sizes, stopped)) = step_sizes else {
        return Err(StepFailure::NotFinite.over(remaining));
    };
    let mut segment = Segment {
        corrects_level,
        cursor,
        sink: &mut sink.erased(),
    };
    segment.run(dynamics, step_sizes, stopped, end)
}

/// Moves the cursor to the time `to` along the exact flow.
pub(super) fn reach<D, const N: usize, const M: usize>(
    dynamics: &D,
    cursor: &mut Cursor<N>,
    to: f64,
) -> Result<(), Failure>
where
    D: Dynamics<f64, N, M>,
{
    let tau = Time::new(to).since(cursor.time);
    if tau <= 0.0 {
        return Ok(());
    }
    let step_sizes = StepSizes::new(dynamics, tau);
    let state = step_sizes.map(|mut step_sizes| step_sizes.reach(&cursor.state, tau));
    let Some(state) = state.filter(|state| is_finite(&state.x)) else {
        return Err(StepFailure::NotFinite.over(tau));
    };
    (cursor.time, cursor.state) = (Time::new(to), state);
    Ok(())
}
