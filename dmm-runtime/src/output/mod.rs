//! What a run gives: points and transitions as they come, or a whole trajectory.

mod end;
mod failure;
mod observer;
mod solution;

pub use end::{End, Halted};
pub use observer::{Observer, Point, Transition, TransitionKind};
pub(crate) use solution::Recorder;
pub use solution::{Interrupted, Solution};
