//! Names and words of the language, and how parsing goes on after an error.

use std::fmt::Display;

use proc_macro2::{Delimiter, Ident, TokenTree};
use syn::Token;
use syn::ext::IdentExt;
use syn::parse::ParseStream;

/// The words that begin an item or belong to one; none of them can be a name.
pub(super) const KEYWORDS: &[&str] = &[
    "system",
    "state",
    "param",
    "const",
    "let",
    "interface",
    "region",
    "where",
    "der",
    "conserved",
    "on",
    "and",
];

/// The words that begin an item.
pub(super) const ITEMS: &[&str] = &[
    "state",
    "param",
    "const",
    "let",
    "interface",
    "region",
    "der",
    "conserved",
    "on",
];

/// The word at the front of `input`, Rust keywords included.
pub(super) fn peek_word(input: ParseStream<'_>) -> Option<Ident> {
    input.cursor().ident().map(|(ident, _)| ident)
}

/// Takes the word at the front of `input`, Rust keywords included.
pub(super) fn word(input: ParseStream<'_>) -> syn::Result<Ident> {
    Ident::parse_any(input)
}

/// Whether the next word is `text`.
pub(super) fn peek_is(input: ParseStream<'_>, text: &str) -> bool {
    peek_word(input).is_some_and(|ident| ident == text)
}

/// A name that the declaration introduces.
pub(super) fn declared(input: ParseStream<'_>) -> syn::Result<Ident> {
    let Some(ident) = peek_word(input) else {
        return Err(error_here(input, "expected a name"));
    };
    if let Some(reason) = unusable(&ident) {
        let rest = input.fork();
        skip_one(&rest);
        if rest.cursor().ident().is_none() {
            // it was meant as a name, and does not begin the next item
            skip_one(input);
        }
        return Err(syn::Error::new(ident.span(), reason));
    }
    word(input)
}

/// Why a word cannot be a name.
fn unusable(ident: &Ident) -> Option<String> {
    let text = ident.to_string();
    if text.starts_with("r#") {
        return Some(format!(
            "`{text}` cannot be a name: raw identifiers are not supported"
        ));
    }
    if KEYWORDS.contains(&text.as_str()) {
        return Some(format!(
            "`{text}` is a word of the declaration language and cannot be a name"
        ));
    }
    if text == "_" {
        return Some("`_` is not a name".into());
    }
    // `parse_str` accepts what Rust accepts as an identifier
    syn::parse_str::<Ident>(&text)
        .is_err()
        .then(|| format!("`{text}` is a keyword of Rust and cannot be a name"))
}

/// An error at the front of `input`, or at its closing delimiter; syn's own would say that the
/// input ends there.
pub(super) fn error_here(input: ParseStream<'_>, message: impl Display) -> syn::Error {
    syn::Error::new(input.span(), message)
}

/// Takes one token tree.
pub(super) fn skip_one(input: ParseStream<'_>) -> Option<TokenTree> {
    input.parse::<TokenTree>().ok()
}

/// Takes what is left.
pub(super) fn skip_all(input: ParseStream<'_>) {
    while skip_one(input).is_some() {}
}

/// Goes on after an error: behind the next `;` or block, or in front of the word that begins
/// the next item if that comes first.
pub(super) fn recover(input: ParseStream<'_>) {
    while !input.is_empty() && !at_item(input) {
        match skip_one(input) {
            Some(TokenTree::Punct(punct)) if punct.as_char() == ';' => return,
            // a block ends an item, but not the `if x { … } else { … }` of a formula
            Some(TokenTree::Group(group))
                if group.delimiter() == Delimiter::Brace
                    && !input.peek(Token![;])
                    && !peek_is(input, "else") =>
            {
                return;
            }
            _ => {}
        }
    }
}

/// Whether an item begins here.
pub(super) fn at_item(input: ParseStream<'_>) -> bool {
    input.peek(Token![#])
        || peek_word(input).is_some_and(|ident| ITEMS.contains(&ident.to_string().as_str()))
}
