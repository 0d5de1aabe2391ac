//! The exact flow of a region whose field is affine, ẋ = A x + b: propagators over steps of many
//! sizes, and bounds of how the interfaces' switching functions bend in a step.

mod ladder;
mod propagator;
mod short;
mod switching;

pub(crate) use ladder::{FIRST, Ladder, Ladders};

use crate::system::{Boundary, Flow};

/// Beyond so many states a propagator, a full matrix, costs more than the recurrences of a Taylor
/// step of a field that has a few terms a component.
const LARGEST: usize = 8;

/// Whether a region is integrated by its exact flow: f and the switching functions that bound it
/// are affine, and there are few states.
pub(crate) const fn is_exact<F: Flow<f64, N, M>, const N: usize, const M: usize>() -> bool {
    F::AFFINE && <F::Boundary as Boundary<f64, N>>::AFFINE && N <= LARGEST
}
