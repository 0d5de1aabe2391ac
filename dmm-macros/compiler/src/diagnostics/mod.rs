//! The collector of diagnostics: every stage reports all that it can check, and what was
//! collected is shown at once.

pub mod catalogue;

use std::fmt::Display;

pub use catalogue::Code;

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// The stretch of source that a construct occupies, from its first token to its last.
///
/// Stable Rust does not join two spans, but it underlines everything between the first and the
/// last token of an error; so both are kept.
#[derive(Debug, Clone, Copy)]
pub struct Extent {
    start: Span,
    end: Span,
}

impl Extent {
    /// From the token at `start` to the token at `end`.
    pub fn new(start: Span, end: Span) -> Self {
        Self { start, end }
    }

    /// From the start of this to the end of `last`.
    pub fn to(self, last: impl Into<Extent>) -> Self {
        Self::new(self.start, last.into().end)
    }

    /// The first token.
    pub fn start(self) -> Span {
        self.start
    }

    /// The last token.
    pub fn end(self) -> Span {
        self.end
    }

    /// An error on this stretch of source; every one has a [`Code`].
    fn error(self, message: impl Display) -> syn::Error {
        let first = Ident::new("first", self.start);
        let last = Ident::new("last", self.end);
        syn::Error::new_spanned(quote!(#first #last), message)
    }
}

impl From<Span> for Extent {
    fn from(span: Span) -> Self {
        Self::new(span, span)
    }
}

impl From<&Ident> for Extent {
    fn from(ident: &Ident) -> Self {
        ident.span().into()
    }
}

/// Errors and warnings about one declaration, each on the tokens that it is about.
#[derive(Debug, Default)]
pub struct Diagnostics {
    errors: Vec<syn::Error>,
    warnings: Vec<Warning>,
}

/// A remark on a declaration that compiles all the same.
#[derive(Debug)]
struct Warning {
    code: Code,
    place: Extent,
    message: syn::Error,
}

impl Diagnostics {
    /// A collector without errors.
    pub fn new() -> Self {
        Self::default()
    }

    /// Reports an error of the kind `code` on the source at `place`.
    pub fn report(&mut self, code: Code, place: impl Into<Extent>, message: impl Display) {
        self.errors.push(code.error(place, message));
    }

    /// Reports an error that was made by [`Code::error`].
    pub fn push(&mut self, error: syn::Error) {
        self.errors.push(error);
    }

    /// Remarks on the source at `place`, with which the declaration compiles.
    pub fn warn(&mut self, code: Code, place: impl Into<Extent>, message: impl Display) {
        let place = place.into();
        self.warnings.push(Warning {
            code,
            place,
            message: code.error(place, message),
        });
    }

    /// Whether there is no error.
    pub fn is_empty(&self) -> bool {
        self.errors.is_empty()
    }

    /// The number of errors; a stage compares it to learn whether it added any.
    pub fn len(&self) -> usize {
        self.errors.len()
    }

    /// The errors with their places, in the order in which they were reported.
    pub fn errors(&self) -> &[syn::Error] {
        &self.errors
    }

    /// The warnings with their places, in the order in which they were found. There are none beside
    /// errors, which may be the reason for them: what is not used may be missing where one is.
    pub fn warnings(&self) -> impl Iterator<Item = &syn::Error> {
        let warnings = self.warnings.iter().filter(|_| self.is_empty());
        warnings.map(|warning| &warning.message)
    }

    /// The messages of the errors, in the order in which they were reported.
    pub fn messages(&self) -> Vec<String> {
        self.errors.iter().map(ToString::to_string).collect()
    }

    /// One `compile_error!` an error.
    pub fn into_compile_errors(self) -> TokenStream {
        self.errors
            .into_iter()
            .map(syn::Error::into_compile_error)
            .collect()
    }

    /// Items of which rustc warns with the messages of the warnings, on their tokens.
    ///
    /// A macro cannot warn in stable Rust. What it can do is to use something deprecated, of which
    /// rustc warns on the tokens that use it and with the note of its deprecation.
    pub fn warning_items(&self) -> TokenStream {
        self.warnings.iter().map(Warning::item).collect()
    }
}

impl Warning {
    fn item(&self) -> TokenStream {
        let name = Ident::new(&self.code.to_string(), Span::call_site());
        let mut used = name.clone();
        used.set_span(self.place.start);
        let note = self.message.to_string();
        quote! {
            const _: () = {
                #[deprecated(note = #note)]
                const #name: () = ();
                #used
            };
        }
    }
}

/// The candidate that `word` was probably meant to be, if one is close enough.
pub fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().count();
    let least = if length <= 2 { 0.9 } else { 0.75 };
    let folded = word.to_lowercase();
    let mut best: Option<(f64, &str)> = None;
    for candidate in candidates {
        if candidate.chars().count().abs_diff(length) > length.div_ceil(2) {
            continue;
        }
        let similarity = strsim::jaro_winkler(&folded, &candidate.to_lowercase());
        // one slip in a longer name is close however short the common beginning is
        let slip = length > 2 && strsim::osa_distance(&folded, candidate) == 1;
        if (similarity >= least || slip) && best.is_none_or(|(score, _)| similarity > score) {
            best = Some((similarity, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}
