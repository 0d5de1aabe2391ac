//! The scheme as readable mathematics: what was declared, what was derived from it and how,
//! and what was proved of it.
//!
//! A [`Document`](document::Document) holds the listing as sections of equations, and is
//! written as aligned text, or with the feature `explore` as LaTeX:
//!
//! ```text
//! Scheme ──region, interface──▶ Document ──text / latex──▶ String
//! ```
//!
//! Systems of many states stay readable: rows and terms that differ by the index alone are
//! written once with a range, parts of long formulas get a name, only those entries of the
//! Jacobian are shown that are not those of the unit matrix, and what is left out is said.

mod compose;
mod document;
mod findings;
mod jacobian;
#[cfg(feature = "explore")]
mod latex;
mod lister;
mod region;
mod strategy;
mod text;

use crate::scheme::Scheme;

/// Columns of a line of text.
const TEXT_WIDTH: usize = 96;
/// Characters, as text, of a line in LaTeX.
#[cfg(feature = "explore")]
const LATEX_WIDTH: usize = 66;
/// Lines of a documentation comment.
const LONGEST_DOCUMENTATION: usize = 400;

/// The listing of a whole system as text.
pub(super) fn listing(scheme: &Scheme) -> String {
    text::write(&region::document(scheme, TEXT_WIDTH), TEXT_WIDTH)
}

/// The listing of a whole system as a fragment of a LaTeX document.
#[cfg(feature = "explore")]
pub(super) fn latex(scheme: &Scheme) -> String {
    let model = &scheme.model;
    let document = region::document(scheme, LATEX_WIDTH);
    let style = latex::style(model, &document.letters);
    latex::write(&model.name.to_string(), &document, &style, LATEX_WIDTH)
}

/// f^τ of a region as text: what the documentation of its variant shows.
pub(super) fn discrete_vector_field(scheme: &Scheme, region: usize) -> String {
    text::write(
        &region::discrete_vector_field(scheme, region, TEXT_WIDTH),
        TEXT_WIDTH,
    )
}

/// A listing as a documentation comment: a block of text, cut where it gets too long.
pub(super) fn documentation(listing: &str) -> String {
    let lines: Vec<&str> = listing.trim_matches('\n').lines().collect();
    let mut text = String::from(" ```text\n");
    for line in lines.iter().take(LONGEST_DOCUMENTATION) {
        // a fence in a declaration's own comments would end the block
        let line = line.replace("```", "'''");
        text.push_str(format!(" {line}").trim_end());
        text.push('\n');
    }
    if lines.len() > LONGEST_DOCUMENTATION {
        let more = lines.len() - LONGEST_DOCUMENTATION;
        text.push_str(&format!(
            " … and {more} more lines, in the constant `LISTING`\n"
        ));
    }
    text.push_str(" ```");
    text
}
