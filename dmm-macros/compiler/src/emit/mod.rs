//! Emission: a [`Scheme`] as Rust ([`rust()`]), and as readable mathematics ([`listing()`], [`latex()`]).
//!
//! Nothing is derived here. Emitted code uses the module `::dmm_runtime::support` and nothing
//! else outside `core` and `std`; its locals are kept apart from whatever names a declaration
//! uses.

mod boundary;
mod code;
mod constant;
mod flow;
mod function;
mod listing;
mod lower;
mod methods;
mod minimal_norm;
mod names;
mod nodes;
mod operations;
mod paths;
mod readable;
mod series;
mod store;
mod system;

use proc_macro2::TokenStream;

use crate::scheme::Scheme;
pub use operations::{Evaluated, Operations};

/// The items that `pws!` expands to.
pub fn rust(scheme: &Scheme) -> TokenStream {
    rust_of(scheme, &Operations::new(scheme))
}

/// As [`rust()`], from the operations of `scheme`.
pub fn rust_of(scheme: &Scheme, operations: &Operations) -> TokenStream {
    system::system(scheme, operations)
}

/// The scheme in readable mathematics, as text.
pub fn listing(scheme: &Scheme) -> String {
    listing::listing(scheme)
}

/// The scheme in readable mathematics, as a fragment of a LaTeX document that loads amsmath.
pub fn latex(scheme: &Scheme) -> String {
    listing::latex(scheme)
}
