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
    if found.is_empty() {
        Err(Failure::Request(format!(
            "{shown} declares no system: it has neither `pws! {{ … }}` nor `system Name {{ … }}`"
        )))
    } else {
        Ok(found)
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
