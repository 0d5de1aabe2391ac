//! Emission: a [`Scheme`] as Rust ([`rust()`]), and as readable mathematics ([`listing()`]).
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
mod paths;
mod store;
mod system;

use proc_macro2::TokenStream;

use crate::scheme::Scheme;

/// The items that `pws!` expands to.
pub fn rust(scheme: &Scheme) -> TokenStream {
    system::system(scheme)
}

/// The scheme in readable mathematics.
pub fn listing(scheme: &Scheme) -> String {
    listing::listing(scheme)
}
