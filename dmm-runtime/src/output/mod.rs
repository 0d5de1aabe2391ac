//! What a run gives: points and transitions as they come, or a whole trajectory.

#[cfg(feature = "ndarray")]
mod arrays;
mod closures;
mod csv;
mod discrete;
mod end;
mod failure;
mod interrupted;
mod kind;
mod observer;
mod recorder;
#[cfg(feature = "serde")]
mod serialise;
mod solution;

pub use closures::{
    IntoControlFlow, OnPoint, OnTransition, Progress, on_point, on_transition, progress,
};
pub use end::{End, EndedBy, Halted};
pub use interrupted::Interrupted;
pub use observer::{Observer, Point, Transition, TransitionKind};
pub(crate) use recorder::Recorder;
pub use solution::Solution;
