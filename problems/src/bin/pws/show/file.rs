//! Systems declared in a file: Rust with `pws!` in it, or a declaration alone.

use std::path::Path;

use dmm_compiler::diagnostics::Diagnostics;
use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};

use crate::failure::Failure;

/// The declarations in a file, in their order.
pub(crate) fn declarations(path: &Path) -> Result<Vec<TokenStream>, Failure> {
    let shown = path.display();
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failure::Request(format!("cannot read {shown}: {error}")))?;
    let tokens: TokenStream = text.parse().map_err(|error: proc_macro2::LexError| {
        Failure::Request(located(
            path,
            error.span(),
            "this is not made of Rust's tokens",
        ))
    })?;
    let mut found = Vec::new();
    blocks(tokens.clone(), &mut found);
    if found.is_empty() && is_declaration(&tokens) {
        found.push(tokens);
    }
    match found.is_empty() {
        true => Err(Failure::Request(format!(
            "{shown} declares no system: it has neither `pws! {{ … }}` nor `system Name {{ … }}`"
        ))),
        false => Ok(found),
    }
}

/// Writes every error to standard error with its place in the file, and sums them up.
pub(crate) fn report(path: &Path, diagnostics: &[Diagnostics]) -> Failure {
    let errors = diagnostics.iter().flat_map(Diagnostics::errors);
    let mut count = 0;
    for error in errors {
        count += 1;
        eprintln!("{}", located(path, error.span(), &error.to_string()));
    }
    let plural = if count == 1 { "" } else { "s" };
    Failure::Request(format!("{count} error{plural} in {}", path.display()))
}

/// `file:line:column: message`, columns counted from 1 as editors do.
fn located(path: &Path, span: Span, message: &str) -> String {
    let start = span.start();
    format!(
        "{}:{}:{}: {message}",
        path.display(),
        start.line,
        start.column + 1
    )
}

/// The contents of every `pws! { … }`.
fn blocks(tokens: TokenStream, found: &mut Vec<TokenStream>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut rest = tokens.as_slice();
    loop {
        rest = match rest {
            [
                TokenTree::Ident(name),
                TokenTree::Punct(mark),
                TokenTree::Group(group),
                rest @ ..,
            ] if name == "pws" && mark.as_char() == '!' => {
                found.push(group.stream());
                rest
            }
            [TokenTree::Group(group), rest @ ..] => {
                blocks(group.stream(), found);
                rest
            }
            [_, rest @ ..] => rest,
            [] => return,
        };
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
