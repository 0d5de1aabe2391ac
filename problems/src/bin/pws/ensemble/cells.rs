//! Columns and cells of the table of results, whatever it is written as.

use crate::output;

/// What a column holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    Count,
    Number,
    Text,
}

/// What stands in a row; nothing where there is nothing to say.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Cell {
    Missing,
    Count(u64),
    Number(f64),
    Text(String),
}

impl Cell {
    /// As text.
    pub(super) fn written(&self) -> String {
        match self {
            Self::Missing => String::new(),
            Self::Count(count) => count.to_string(),
            Self::Number(value) => output::number(*value),
            Self::Text(text) => text.clone(),
        }
    }
}

/// A column: its name and what it holds.
pub(crate) type Column = (String, Kind);
