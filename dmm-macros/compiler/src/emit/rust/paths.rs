//! Paths to what emitted code is written against.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// The hidden module of the runtime that emitted code uses, under a short name, and the primitive
/// types, whatever these names mean around the declaration.
pub(super) fn import(runtime: &TokenStream) -> TokenStream {
    quote!(
        use #runtime::support as dmm;
        #[allow(unused_imports)]
        use ::core::primitive::{bool, f64, str, u32, usize};
    )
}

/// `#[derive(…)]` of traits by their paths: a scope may have others under their names.
pub(super) fn derive(names: &[&str]) -> TokenStream {
    let paths = names.iter().map(|name| match *name {
        "Clone" => quote!(::core::clone::Clone),
        "Copy" => quote!(::core::marker::Copy),
        "Debug" => quote!(::core::fmt::Debug),
        "Hash" => quote!(::core::hash::Hash),
        name => {
            let name = format_ident!("{name}");
            quote!(::core::cmp::#name)
        }
    });
    quote!(#[derive(#(#paths),*)])
}

/// `dmm::name`, after [`import`].
pub(super) fn support(name: &str) -> TokenStream {
    let name = format_ident!("{name}");
    quote!(dmm::#name)
}

/// A dimension or an index.
pub(super) fn count(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}
