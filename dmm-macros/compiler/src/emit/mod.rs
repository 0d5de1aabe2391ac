//! Emission: a [`Program`] as Rust ([`rust()`]), a [`Scheme`] as readable mathematics
//! ([`listing()`], and with the feature `explore` as LaTeX).
//!
//! Nothing is derived or chosen here but how it is written. Emitted code uses the module
//! `support` of the runtime and nothing else outside `core` and `std`, by paths that no name around
//! it changes; its locals are kept apart from whatever names a declaration uses.

mod listing;
mod rust;

use proc_macro2::TokenStream;

use crate::program::Program;
use crate::scheme::Scheme;

/// The items that `pws!` expands to, where `runtime` is the path of the crate `dmm-runtime`.
pub fn rust(program: &Program<'_>, runtime: &TokenStream) -> TokenStream {
    rust::system(program, runtime)
}

/// The scheme in readable mathematics, as text.
pub fn listing(scheme: &Scheme) -> String {
    listing::listing(scheme)
}

/// The scheme in readable mathematics, as a fragment of a LaTeX document that loads amsmath.
#[cfg(feature = "explore")]
pub fn latex(scheme: &Scheme) -> String {
    listing::latex(scheme)
}
