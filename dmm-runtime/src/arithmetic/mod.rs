//! Numbers: scalars, pairs of doubles, time and state with their remainders, lanes, and the small
//! linear systems of a step.

mod chain;
pub(crate) mod double;
pub(crate) mod dual;
pub(crate) mod error_free;
pub(crate) mod factors;
pub(crate) mod lanes;
pub(crate) mod linear;
pub(crate) mod masked;
mod minimal_norm;
pub(crate) mod recorded;
pub(crate) mod rows;
mod scalar;
mod sparse;
mod state;
mod time;
pub(crate) mod traced;

use std::sync::atomic::{Ordering, compiler_fence};

pub use minimal_norm::MinimalNorm;
pub use scalar::Scalar;
pub(crate) use scalar::{Derived, noise};
pub use sparse::sparse;
pub use state::State;
pub use time::Time;

/// A column of N scalars.
pub type Vector<S, const N: usize> = nalgebra::SVector<S, N>;
/// A matrix of R rows and C columns.
pub type Matrix<S, const R: usize, const C: usize> = nalgebra::SMatrix<S, R, C>;

/// A number read by itself. LLVM reads numbers that lie side by side as one vector. Of one that was stored in
/// parts just before, the processor has nothing until the last part has left its store buffer, where it
/// passes on a number that was stored as a whole. LLVM joins no loads across a fence, which is no instruction.
#[inline(always)]
pub(crate) fn alone<S: Copy>(number: &S) -> S {
    let number = *number;
    compiler_fence(Ordering::Release);
    number
}

/// The matrix or vector of which every entry is `value`; not by a function of nalgebra, as what is not
/// inlined for certain does not compute in lanes.
#[inline(always)]
pub(crate) fn filled<S: Copy, const R: usize, const C: usize>(value: S) -> Matrix<S, R, C> {
    Matrix::from_array_storage(nalgebra::ArrayStorage([[value; R]; C]))
}
