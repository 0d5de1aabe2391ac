//! Systems declared in a file: Rust with `pws!` in it, or a declaration alone.

use std::path::Path;

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::text;
use proc_macro2::TokenStream;

use crate::failure::Failure;

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path)
        .map_err(|error| Failure::Request(format!("cannot read {}: {error}", path.display())))
}

/// The declarations in a file, in their order.
pub(crate) fn declarations(path: &Path) -> Result<Vec<TokenStream>, Failure> {
    text::declarations(&read(path)?)
        .map_err(|message| Failure::Request(format!("{}:{message}", path.display())))
}

/// Writes every warning to standard error with its place in the file.
pub(crate) fn warn(path: &Path, diagnostics: &Diagnostics) {
    for warning in text::warnings(diagnostics) {
        eprintln!("{}:{warning}", path.display());
    }
}

/// Writes every error to standard error with its place in the file, and sums them up.
pub(crate) fn report(path: &Path, diagnostics: &[Diagnostics]) -> Failure {
    let mut count = 0;
    for message in diagnostics.iter().flat_map(text::messages) {
        count += 1;
        eprintln!("{}:{message}", path.display());
    }
    let plural = if count == 1 { "" } else { "s" };
    Failure::Request(format!("{count} error{plural} in {}", path.display()))
}
