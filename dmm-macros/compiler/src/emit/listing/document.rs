//! A listing: sections of equations, before it is written in one notation or another.

use super::findings::Finding;
use crate::algebra::display::text::Letters;
use crate::algebra::display::{FormulaId, Formulas, Symbol};

/// The listing of a system.
#[derive(Debug)]
pub(super) struct Document {
    /// The declaration; empty in a part of a listing.
    pub(super) source: String,
    /// The DAG of the formulas of the sections.
    pub(super) formulas: Formulas,
    /// The letters that they are written with.
    pub(super) letters: Letters,
    /// What was derived, in order.
    pub(super) sections: Vec<Section>,
}

/// A heading with what belongs to it.
#[derive(Debug, Default)]
pub(super) struct Section {
    /// The kind of heading.
    pub(super) level: Level,
    /// The heading.
    pub(super) heading: Phrase,
    /// What follows the heading on its line.
    pub(super) remark: Phrase,
    /// Sentences before the equations.
    pub(super) reasons: Vec<Phrase>,
    /// The equations.
    pub(super) rows: Vec<Row>,
    /// What their shared formulas stand for.
    pub(super) shared: Vec<Row>,
    /// Sentences after the equations.
    pub(super) notes: Vec<Phrase>,
    /// Statements, with how they are known.
    pub(super) findings: Vec<Finding>,
}

/// The kind of a heading.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    /// Of an interface or a region.
    Part,
    /// Of a step within it.
    #[default]
    Step,
}

/// Words and formulas in a row.
pub(super) type Phrase = Vec<Piece>;

/// A piece of a phrase.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Piece {
    /// Words, with mathematical signs among them.
    Words(String),
    /// Mathematics in signs of the compiler's own.
    Signs(&'static str),
    /// A formula.
    Formula(FormulaId),
}

impl From<&str> for Piece {
    fn from(words: &str) -> Self {
        Self::Words(words.into())
    }
}

impl From<String> for Piece {
    fn from(words: String) -> Self {
        Self::Words(words)
    }
}

impl From<FormulaId> for Piece {
    fn from(formula: FormulaId) -> Self {
        Self::Formula(formula)
    }
}

/// The equation `left = right`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Row {
    /// The left-hand side.
    pub(super) left: Vec<Part>,
    /// The right-hand side.
    pub(super) right: FormulaId,
    /// The first and the last index for which it holds, where it stands for several.
    pub(super) range: Option<(usize, usize)>,
}

/// A part of a left-hand side.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) enum Part {
    /// Signs of the compiler's own.
    Sign(&'static str),
    /// The name of a conserved quantity.
    Name(String),
    /// A variable.
    Symbol(Symbol),
    /// The name of a shared formula: its number, and whether there is one for every row.
    Shared(usize, bool),
}
