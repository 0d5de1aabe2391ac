//! Emission: a [`Program`] as Rust ([`rust()`]), a [`Scheme`] as readable mathematics
//! ([`listing()`], and with the feature `explore` as LaTeX).
//!
//! Nothing is derived or chosen here but how it is written. Emitted code uses the module
//! `::dmm_runtime::support` and nothing else outside `core` and `std`; its locals are kept apart
//! from whatever names a declaration uses.

mod listing;
mod rust;

use proc_macro2::TokenStream;

use crate::program::Program;
use crate::scheme::Scheme;

/// The items that `pws!` expands to.
pub fn rust(program: &Program<'_>) -> TokenStream {
    rust::system(program)
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
