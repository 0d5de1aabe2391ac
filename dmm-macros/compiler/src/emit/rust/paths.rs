//! Paths to what emitted code is written against.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// The hidden module of the runtime that emitted code uses, under a short name.
pub(super) fn import() -> TokenStream {
    quote!(
        use ::dmm_runtime::support as dmm;
    )
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
