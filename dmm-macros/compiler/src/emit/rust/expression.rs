//! Expressions of emitted code: how tightly they bind, and how long they are.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

/// How tightly an expression binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

/// An expression of emitted code.
#[derive(Clone)]
pub(super) struct Expression {
    pub(super) tokens: TokenStream,
    pub(super) binding: Binding,
    pub(super) operations: usize,
}

impl Expression {
    /// One that needs no parentheses anywhere.
    pub(super) fn atom(tokens: TokenStream) -> Self {
        Self {
            tokens,
            binding: Binding::Atom,
            operations: 0,
        }
    }

    /// In parentheses if it binds less tightly than its place asks for.
    pub(super) fn at(&self, place: Binding) -> TokenStream {
        let tokens = &self.tokens;
        if self.binding < place {
            quote!((#tokens))
        } else {
            tokens.clone()
        }
    }
}

/// The name of a scalar's method.
pub(super) fn method(name: &str) -> Ident {
    quote::format_ident!("{name}")
}

/// The scalar nearest to `value`.
pub(super) fn constant(scalar: &TokenStream, value: f64) -> TokenStream {
    let value = double(value);
    quote!(#scalar::from_f64(#value))
}

/// A double as an expression.
pub(super) fn double(value: f64) -> TokenStream {
    let magnitude = if value.is_finite() {
        let literal = Literal::f64_unsuffixed(value.abs());
        quote!(#literal)
    } else {
        quote!(f64::INFINITY)
    };
    if value < 0.0 {
        quote!(-#magnitude)
    } else {
        magnitude
    }
}
