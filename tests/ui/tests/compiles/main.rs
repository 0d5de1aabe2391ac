//! Declarations that compile, without warnings.

pub mod functions;
pub mod groups;
pub mod hamiltonian;
pub mod names_in_scope;
pub mod one_interface;
pub mod several;
pub mod smooth;
pub mod time_dependent;
pub mod unused;
