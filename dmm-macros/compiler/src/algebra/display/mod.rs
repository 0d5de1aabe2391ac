//! Readable mathematics: expression → formula → text in the notation of declarations, or LaTeX.
//!
//! A [`Formula`] is an expression as it is written on paper: sums are lists of signed terms,
//! products one numerator over one denominator. It is made in an arena of [`Formulas`], where
//! equal formulas are the same [`FormulaId`], as in the [`Dag`] that they come from; so
//! [`patterns`] can be recognised and shared parts [`shared`] by name whatever the size of the
//! tree.
//!
//! ```text
//! Dag ──build──▶ Formulas ──patterns, shared──▶ Formulas ──text / latex──▶ String
//! ```

mod build;
mod collect;
pub mod formula;
mod hash;
#[cfg(feature = "explore")]
pub mod latex;
pub mod patterns;
pub mod shared;
pub mod size;
pub mod symbol;
pub mod text;
#[cfg(feature = "explore")]
pub mod unicode;
mod writer;

use super::{Dag, Id};
pub use formula::{Formula, FormulaId, Formulas};
pub use symbol::{End, Position, Symbol};

/// `root` as text, with no more parentheses than the grammar of declarations needs:
/// `k*(x₁ + x₀)/2`, `x^2 - 2*x + 1`. What is too long is cut off with `…`.
pub fn to_text(dag: &Dag, root: Id) -> String {
    let mut formulas = Formulas::as_they_are();
    let root = formulas.build(dag, root);
    text::write(&formulas, root)
}
