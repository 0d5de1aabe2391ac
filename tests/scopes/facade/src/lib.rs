//! Systems and their integration, for those who depend on this crate alone.

pub use dmm_runtime::{Best, Integrator, System, pws};
