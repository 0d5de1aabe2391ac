//! Derivatives of solutions by the initial state and by parameters, beside closed forms, differences of
//! runs, and published multipliers.

mod adjoint;
mod discrete;
mod multipliers;
mod objective;
mod refusals;
mod second;
mod spiral;
mod stick_slip;
mod together;

use dmm_runtime::Error;

type Failure = Box<dyn std::error::Error>;

/// The kind of an error, as text.
fn kind(error: &Error) -> String {
    error.kind.to_string()
}
