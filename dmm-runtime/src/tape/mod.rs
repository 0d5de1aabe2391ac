//! Systems that are compiled at run time: the program of a declaration, evaluated operation by
//! operation.
//!
//! The compiler's program is translated once into flat lists of operations on registers; a
//! [`Tape`] is a [`System`](crate::System) like those of `pws!`, with the same schemes, transitions
//! and proofs, and results that agree to rounding. The methods are compiled once for each of a few
//! numbers of states and quantities, and not for each system. Machine code made at run time would
//! take the place of the operations, behind the same dynamics.

mod code;
mod dynamics;
mod guards;
mod metadata;
mod operation;
mod series;
mod system;

use dmm_compiler::program::DefaultValue;

use operation::{Operation, constants, register};
pub(crate) use system::SystemCode;
pub(crate) use system::Tape;

/// The declared value of a parameter.
fn default_value(default: &DefaultValue) -> f64 {
    let mut registers = vec![0.0; default.lowered.dag().len()];
    for (register, value) in constants(&default.lowered) {
        registers[register as usize] = value;
    }
    operation::run(
        &Operation::all(&default.lowered, &default.operations),
        &mut registers,
    );
    registers[register(default.value) as usize]
}
