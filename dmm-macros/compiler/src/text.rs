//! Declarations in a text: Rust with `pws!` in it, or a declaration alone.

mod signs;

use std::fmt;

use proc_macro2::{Delimiter, LexError, Span, TokenStream, TokenTree};

use crate::diagnostics::Diagnostics;

/// A message about a place in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// What is wrong.
    pub text: String,
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.text)
    }
}

impl Message {
    fn new(span: Span, text: impl fmt::Display) -> Self {
        let start = span.start();
        Self {
            line: start.line,
            column: start.column + 1,
            text: text.to_string(),
        }
    }
}

/// The messages of the errors among diagnostics, by their places.
pub fn messages(diagnostics: &Diagnostics) -> Vec<Message> {
    let errors = diagnostics.errors().iter();
    errors
        .map(|error| Message::new(error.span(), error))
        .collect()
}

/// The warnings among diagnostics, by their places. Each begins with `warning: `.
pub fn warnings(diagnostics: &Diagnostics) -> Vec<Message> {
    let warnings = diagnostics.warnings();
    warnings
        .map(|warning| Message::new(warning.span(), format!("warning: {warning}")))
        .collect()
}

/// The declarations in a text, in their order.
///
/// # Errors
/// A text that is not made of Rust's tokens, or declares no system.
pub fn declarations(text: &str) -> Result<Vec<TokenStream>, Message> {
    let tokens: TokenStream = text.parse().map_err(|error: LexError| {
        let start = error.span().start();
        let line = text.lines().nth(start.line - 1).unwrap_or_default();
        let rest = line.char_indices().nth(start.column);
        let rest = rest.and_then(|(place, _)| line.get(place..));
        Message::new(error.span(), signs::reason(rest.unwrap_or_default()))
    })?;
    let mut found = Vec::new();
    blocks(tokens.clone(), &mut found);
    if found.is_empty() && is_declaration(&tokens) {
        found.push(tokens);
    }
    if found.is_empty() {
        return Err(Message {
            line: 1,
            column: 1,
            text: "this declares no system: it has neither `pws! { … }` nor `system Name { … }`"
                .to_owned(),
        });
    }
    Ok(found)
}

/// The contents of every `pws! { … }`, in their order. The search does not recurse: brackets may
/// be nested as deeply as the file likes.
fn blocks(tokens: TokenStream, found: &mut Vec<TokenStream>) {
    let mut open = vec![(tokens.into_iter().collect::<Vec<TokenTree>>(), 0)];
    while let Some((tokens, place)) = open.last_mut() {
        let inner = match tokens.get(*place..).unwrap_or_default() {
            [
                TokenTree::Ident(name),
                TokenTree::Punct(mark),
                TokenTree::Group(group),
                ..,
            ] if name == "pws" && mark.as_char() == '!' => {
                found.push(group.stream());
                *place += 3;
                continue;
            }
            [TokenTree::Group(group), ..] => group.stream(),
            [_, ..] => {
                *place += 1;
                continue;
            }
            [] => {
                open.pop();
                continue;
            }
        };
        *place += 1;
        open.push((inner.into_iter().collect(), 0));
    }
}

/// Whether there is `system Name { … }`.
fn is_declaration(tokens: &TokenStream) -> bool {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    tokens.windows(3).any(|three| match three {
        [
            TokenTree::Ident(word),
            TokenTree::Ident(_),
            TokenTree::Group(body),
        ] => word == "system" && body.delimiter() == Delimiter::Brace,
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_found_however_deep_brackets_are_nested() {
        let deep = format!("{}{}", "(".repeat(100_000), ")".repeat(100_000));
        let text = format!("pws! {{ a }} mod m {{ pws! {{ b }} {deep} }} pws! {{ c {deep} }}");
        let tokens: TokenStream = text.parse().expect("tokens");
        let mut found = Vec::new();
        blocks(tokens, &mut found);
        let first = |block: &TokenStream| block.clone().into_iter().next().map(|t| t.to_string());
        let names: Vec<String> = found.iter().filter_map(first).collect();
        assert_eq!(names, ["a", "b", "c"]);
    }
}
