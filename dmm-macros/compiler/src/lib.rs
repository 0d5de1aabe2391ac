//! Compiler of piecewise-smooth systems into conservative integrators: a declaration is read,
//! what it claims is proved, the Discrete Multiplier Method (Wan, Bihlo & Nave 2017) derives
//! the scheme that conserves it exactly, and the scheme becomes Rust.
//!
//! tokens → [`syntax`] → [`check`] → [`proofs`] → [`scheme`] → [`emit`] → tokens.
//!
//! A stage reports all that it can check to [`diagnostics`]; the next one starts if there was
//! nothing to report.
#![deny(missing_docs)]

pub mod algebra;
pub mod check;
pub mod diagnostics;
pub mod emit;
pub mod model;
pub mod proofs;
pub mod scheme;
pub mod stub;
pub mod syntax;

use proc_macro2::TokenStream;
use quote::quote;

use diagnostics::Diagnostics;
use scheme::Scheme;
use syntax::Declaration;

/// Compiles the declaration of a system into Rust items: the system's, or the diagnostics and
/// a [`stub`] of it.
pub fn compile(input: TokenStream) -> TokenStream {
    let mut diagnostics = Diagnostics::new();
    let Some(declaration) = syntax::parse(input, &mut diagnostics) else {
        return diagnostics.into_compile_errors();
    };
    let stub = stub::stub(&declaration);
    match derive(declaration, &mut diagnostics) {
        Some(scheme) => emit::rust(&scheme),
        None => {
            let errors = diagnostics.into_compile_errors();
            quote!(#errors #stub)
        }
    }
}

/// The scheme of a declaration in readable mathematics, or the messages of all diagnostics.
pub fn explain(input: TokenStream) -> Result<String, Vec<String>> {
    let mut diagnostics = Diagnostics::new();
    syntax::parse(input, &mut diagnostics)
        .and_then(|declaration| derive(declaration, &mut diagnostics))
        .map(|scheme| emit::listing(&scheme))
        .ok_or_else(|| diagnostics.messages())
}

/// The scheme of a declaration without errors.
pub fn derive(declaration: Declaration, diagnostics: &mut Diagnostics) -> Option<Scheme> {
    if !diagnostics.is_empty() {
        return None;
    }
    let mut model = check::resolve(declaration, diagnostics)?;
    proofs::check(&mut model, diagnostics);
    if !diagnostics.is_empty() {
        return None;
    }
    scheme::derive(model, diagnostics)
}
