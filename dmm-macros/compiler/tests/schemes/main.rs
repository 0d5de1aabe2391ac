//! The derived schemes: which strategy fits, what f^τ is, that it is right at random points,
//! and what is printed and emitted.

#[path = "../support/corpus.rs"]
mod corpus;
mod fields;
mod numbers;
mod snapshots;
mod systems;

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::scheme::Scheme;
use dmm_compiler::{derive, syntax};
use proc_macro2::TokenStream;

/// A declaration as tokens.
fn tokens(source: &str) -> TokenStream {
    source
        .parse()
        .expect("the declaration is made of Rust tokens")
}

/// The scheme of a declaration.
fn scheme(source: &str) -> Scheme {
    let mut diagnostics = Diagnostics::new();
    let declaration = syntax::parse(tokens(source), &mut diagnostics);
    declaration
        .and_then(|declaration| derive(declaration, &mut diagnostics))
        .unwrap_or_else(|| panic!("{:#?}", diagnostics.messages()))
}
