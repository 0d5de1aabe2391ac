//! The driver: from mode to mode, until the end.
//!
//! The algorithm is one page, `run`; [`Integrator`] pushes it to an end time, and
//! [`Stepper`] pulls it a step at a time.

mod accumulation;
mod around;
mod choice;
mod conditions;
mod events;
mod fit;
mod integrator;
mod modes;
mod next;
mod reading;
mod recording;
mod refusal;
mod run;
mod segment;
mod start;
mod stepper;

pub(crate) use accumulation::Accumulation;
pub(crate) use events::happening;
pub use integrator::{InitialValueProblem, Integrator};
pub(crate) use next::enter;
pub use recording::Recording;
pub(crate) use run::Run;
pub use stepper::{Stepped, Stepper};
