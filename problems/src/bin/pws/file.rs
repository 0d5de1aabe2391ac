//! Systems declared in a file: Rust with `pws!` in it, or a declaration alone; and what is wrong
//! with them, underlined in the source.

use std::io::IsTerminal;
use std::ops::Range;
use std::path::Path;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::text;
use proc_macro2::TokenStream;

use crate::failure::Failure;

/// A file that declares systems.
pub(crate) struct Source<'a> {
    path: &'a Path,
    text: String,
}

impl<'a> Source<'a> {
    /// Reads a file.
    pub(crate) fn read(path: &'a Path) -> Result<Self, Failure> {
        let text = std::fs::read_to_string(path).map_err(|error| Failure::read(path, error))?;
        // no places are counted in a mark of the encoding
        let text = match text.strip_prefix('\u{feff}') {
            Some(rest) => rest.to_owned(),
            None => text,
        };
        Ok(Self { path, text })
    }

    /// What is in it.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The declarations, in their order.
    pub(crate) fn declarations(&self) -> Result<Vec<TokenStream>, Failure> {
        text::declarations(&self.text).map_err(|message| {
            let place = self.offset(message.line, message.column);
            self.show(Level::ERROR, place..place, &message.text);
            self.summary(1, &message.text)
        })
    }

    /// The only declaration.
    pub(crate) fn declaration(&self) -> Result<TokenStream, Failure> {
        let mut declarations = self.declarations()?;
        match (declarations.pop(), declarations.len()) {
            (Some(only), 0) => Ok(only),
            (_, others) => Err(Failure::Request(format!(
                "{} declares {} systems: leave one in the file",
                self.path.display(),
                others + 1
            ))),
        }
    }

    /// Shows every error on standard error where it is, and sums them up.
    pub(crate) fn report(&self, wrong: &[Diagnostics]) -> Failure {
        let errors: Vec<_> = wrong.iter().flat_map(Diagnostics::errors).collect();
        for error in &errors {
            self.show(Level::ERROR, error.span().byte_range(), &error.to_string());
        }
        let last = errors.last().map(ToString::to_string).unwrap_or_default();
        self.summary(errors.len(), &last)
    }

    /// Shows a warning on standard error at a line and a column.
    pub(crate) fn warn_at(&self, (line, column): (usize, usize), text: &str) {
        let place = self.offset(line, column);
        // the level says that it is one
        let text = text.strip_prefix("warning: ").unwrap_or(text);
        self.show(Level::WARNING, place..place, text);
    }

    /// Shows every warning on standard error where it is.
    pub(crate) fn warn(&self, diagnostics: &Diagnostics) {
        for warning in diagnostics.warnings() {
            let text = warning.to_string();
            self.show(Level::WARNING, warning.span().byte_range(), &text);
        }
    }

    /// Writes a message to standard error with the source that it is about.
    fn show(&self, level: Level<'_>, place: Range<usize>, message: &str) {
        let is_terminal = std::io::stderr().is_terminal();
        let is_coloured = is_terminal && std::env::var_os("NO_COLOR").is_none();
        let renderer = if is_coloured {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        let path = self.path.display().to_string();
        let end = self.text.len();
        let place = place.start.min(end)..place.end.min(end);
        let snippet = Snippet::source(&self.text)
            .path(path)
            .annotation(AnnotationKind::Primary.span(place));
        let group = level.primary_title(message).element(snippet);
        eprintln!("{}\n", renderer.render(&[group]));
    }

    /// How many errors there are, and where to read more about the last.
    fn summary(&self, count: usize, last: &str) -> Failure {
        let plural = if count == 1 { "" } else { "s" };
        let mut text = format!("{count} error{plural} in {}", self.path.display());
        let code = last
            .strip_suffix(']')
            .and_then(|text| text.rsplit_once('['));
        if let Some((_, code)) = code {
            text.push_str(&format!(" (`pws explain {code}` says more)"));
        }
        Failure::Request(text)
    }

    /// The byte at a line and a column, both from 1.
    fn offset(&self, line: usize, column: usize) -> usize {
        let lines = self.text.split_inclusive('\n');
        let before: usize = lines.take(line.saturating_sub(1)).map(str::len).sum();
        let line = self.text.get(before..).unwrap_or_default();
        let mut places = line.char_indices().map(|(place, _)| place);
        before + places.nth(column.saturating_sub(1)).unwrap_or(line.len())
    }
}
