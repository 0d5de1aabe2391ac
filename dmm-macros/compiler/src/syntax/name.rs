//! Names and words of the language, and how parsing goes on after an error.

use proc_macro2::{Delimiter, Ident, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Lit, Token, token};

use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::syntax::{NAME, RESERVED_WORD};

/// The words that begin an item or belong to one; none of them can be a name.
pub(super) const KEYWORDS: &[&str] = &[
    "system",
    "state",
    "param",
    "const",
    "let",
    "fn",
    "interface",
    "region",
    "where",
    "der",
    "hamiltonian",
    "conserved",
    "assume",
    "for",
    "in",
    "sum",
    "on",
    "and",
    "discrete",
    "every",
    "at",
    "conserves",
    "sliding",
];

/// The words that begin an item.
pub(super) const ITEMS: &[&str] = &[
    "state",
    "param",
    "const",
    "let",
    "fn",
    "interface",
    "region",
    "der",
    "hamiltonian",
    "conserved",
    "assume",
    "for",
    "on",
    "discrete",
    "every",
    "at",
    "sliding",
];

/// Types that every Rust program knows, and that a system of this name would hide from the code
/// that is emitted for it.
const PRIMITIVE_TYPES: &[&str] = &[
    "bool", "char", "str", "f16", "f32", "f64", "f128", "i8", "i16", "i32", "i64", "i128", "isize",
    "u8", "u16", "u32", "u64", "u128", "usize",
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

/// Whether a type of Rust, Modelica or C stands here, and a name behind it or nothing.
pub(super) fn is_type(input: ParseStream<'_>) -> bool {
    const OTHERS: &[&str] = &[
        "Real", "real", "double", "float", "Float64", "int", "Integer",
    ];
    let Some(word) = peek_word(input).map(|word| word.to_string()) else {
        return false;
    };
    let rest = input.fork();
    skip_one(&rest);
    let is_last = rest.is_empty() || rest.peek(Token![;]) || rest.peek(Token![=]);
    PRIMITIVE_TYPES.contains(&word.as_str())
        || OTHERS.contains(&word.as_str()) && (is_last || peek_word(&rest).is_some())
}

/// A name that the declaration introduces or refers to.
pub(super) fn declared(input: ParseStream<'_>) -> syn::Result<Ident> {
    let (ident, refusal) = word_as_name(input)?;
    refusal.map_or(Ok(ident), Err)
}

/// A name that the declaration introduces, which is kept even if it cannot be one: the stub of
/// a wrong declaration has as many states, parameters and regions as were meant.
pub(super) fn declared_or_reported(
    input: ParseStream<'_>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Ident> {
    let (ident, refusal) = word_as_name(input)?;
    if let Some(refusal) = refusal {
        report(diagnostics, refusal);
    }
    Ok(ident)
}

/// The word that stands as a name, and why it cannot be one.
fn word_as_name(input: ParseStream<'_>) -> syn::Result<(Ident, Option<syn::Error>)> {
    let Some(ident) = peek_word(input) else {
        let message = match input.fork().parse::<Lit>() {
            Ok(Lit::Int(_) | Lit::Float(_)) => "a name does not begin with a digit",
            _ => "expected a name",
        };
        return Err(NAME.error(input.span(), message));
    };
    if begins_item(input) && ident != "der" {
        return Err(NAME.error(&ident, format!("expected a name in front of `{ident}`")));
    }
    word(input)?;
    let refusal =
        refusal_of_word(&ident).or_else(|| Some(RESERVED_WORD.error(&ident, unusable(&ident)?)));
    Ok((ident, refusal))
}

/// The name of a system, which becomes a type. It is kept even if it cannot be one, for the stub.
pub(super) fn declared_type(
    input: ParseStream<'_>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Ident> {
    let ident = declared_or_reported(input, diagnostics)?;
    if PRIMITIVE_TYPES.contains(&ident.to_string().as_str()) {
        let message = format!("`{ident}` is a type of Rust and cannot be the name of a system");
        diagnostics.report(RESERVED_WORD, &ident, message);
    }
    Ok(ident)
}

/// Whether Rust accepts `text` as the name of a type that hides none of its own.
pub(crate) fn is_name_of_type(text: &str) -> bool {
    is_identifier(text) && !PRIMITIVE_TYPES.contains(&text)
}

/// The error on a word of the language that is used as a name.
pub(super) fn refusal_of_word(ident: &Ident) -> Option<syn::Error> {
    let text = ident.to_string();
    KEYWORDS.contains(&text.as_str()).then(|| {
        let message =
            format!("`{text}` is a word of the declaration language and cannot be a name");
        RESERVED_WORD.error(ident, message)
    })
}

/// Why a word that means nothing in the language cannot be a name.
fn unusable(ident: &Ident) -> Option<String> {
    let text = ident.to_string();
    if text.starts_with("r#") {
        return Some(format!(
            "`{text}` cannot be a name: raw identifiers are not supported"
        ));
    }
    if text == "_" {
        return Some("`_` is not a name".into());
    }
    if text == "mut" {
        return Some("nothing that is declared changes: leave out `mut`".into());
    }
    (!is_identifier(&text)).then(|| format!("`{text}` is a keyword of Rust and cannot be a name"))
}

/// Whether Rust accepts `text` as an identifier, in every edition.
pub(crate) fn is_identifier(text: &str) -> bool {
    // `gen` is a keyword since 2024
    text != "gen" && syn::parse_str::<Ident>(text).is_ok()
}

/// Reports `error`; but one that a word cannot be a name once, however often it is used.
pub(super) fn report(diagnostics: &mut Diagnostics, error: syn::Error) {
    let message = error.to_string();
    let is_reserved = message.ends_with(&format!("[{RESERVED_WORD}]"));
    if !is_reserved || !diagnostics.messages().contains(&message) {
        diagnostics.push(error);
    }
}

/// Takes one token tree.
pub(super) fn skip_one(input: ParseStream<'_>) -> Option<TokenTree> {
    input.parse::<TokenTree>().ok()
}

/// Takes what is left.
pub(super) fn skip_all(input: ParseStream<'_>) {
    while skip_one(input).is_some() {}
}

/// Whether the bracket that comes next has these signs in a row, not within another one.
pub(super) fn group_has(input: ParseStream<'_>, signs: &[char]) -> bool {
    let Ok(TokenTree::Group(group)) = input.fork().parse() else {
        return false;
    };
    let tokens: Vec<Option<char>> = (group.stream().into_iter())
        .map(|tree| match tree {
            TokenTree::Punct(punct) => Some(punct.as_char()),
            _ => None,
        })
        .collect();
    let is_there = |window: &[Option<char>]| {
        window
            .iter()
            .zip(signs)
            .all(|(token, sign)| *token == Some(*sign))
    };
    tokens.windows(signs.len()).any(is_there)
}

/// Goes on after an error: behind the next `;` or block, or in front of the next item if that
/// comes first.
pub(super) fn recover(input: ParseStream<'_>) {
    while !input.is_empty() && !begins_item(input) {
        match skip_one(input) {
            Some(TokenTree::Punct(punct)) if punct.as_char() == ';' => return,
            // a block ends an item, but not the `if x { … } else { … }` of a formula
            Some(TokenTree::Group(group))
                if group.delimiter() == Delimiter::Brace
                    && !input.peek(Token![;])
                    && !input.peek(Token![,])
                    && !peek_is(input, "else") =>
            {
                return;
            }
            _ => {}
        }
    }
}

/// Goes on after an error in a list: at its next element, or else behind the item.
pub(super) fn recover_in_list(input: ParseStream<'_>) -> bool {
    while !input.is_empty()
        && !input.peek(Token![,])
        && !input.peek(Token![;])
        && !input.peek(token::Brace)
        && !begins_item(input)
    {
        skip_one(input);
    }
    let rest = input.fork();
    let goes_on = rest.parse::<Token![,]>().is_ok() && begins_element(&rest);
    if goes_on {
        skip_one(input);
    } else {
        recover(input);
    }
    goes_on
}

/// Whether a name stands here that goes on as an element of a list does.
fn begins_element(input: ParseStream<'_>) -> bool {
    let rest = input.fork();
    word(&rest).is_ok()
        && (rest.peek(Token![=])
            || rest.peek(Token![,])
            || rest.peek(Token![;])
            || rest.peek(Token![:])
            || rest.peek(token::Bracket))
}

/// Whether a word stands here that begins an item, or documentation.
pub(super) fn at_item(input: ParseStream<'_>) -> bool {
    is_documentation(input)
        || peek_word(input).is_some_and(|ident| ITEMS.contains(&ident.to_string().as_str()))
}

/// Whether an item begins here: its word goes on as an item does, and is not used as a name.
pub(super) fn begins_item(input: ParseStream<'_>) -> bool {
    if is_documentation(input) {
        return true;
    }
    let Some(word) = peek_word(input).filter(|_| at_item(input)) else {
        return false;
    };
    let rest = input.fork();
    skip_one(&rest);
    if peek_word(&rest).is_some() {
        return true;
    }
    if word != "der" || !rest.peek(token::Paren) {
        return false;
    }
    skip_one(&rest);
    rest.peek(Token![=])
}

/// `/// …`, which is `#[doc = …]`
fn is_documentation(input: ParseStream<'_>) -> bool {
    input.peek(Token![#]) && input.peek2(token::Bracket)
}
