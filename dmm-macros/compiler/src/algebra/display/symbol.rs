//! The symbols of formulas: variables taken apart into a name, an index and an end of the step.

use std::sync::Arc;

use crate::algebra::Name;

/// A variable as it is written: `x`, `q[2]`, `q[i+1]₁`, `λ[energy]`, `w[q[2]]`.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol {
    /// What it is called, without index and end.
    pub base: Arc<str>,
    /// For a component that is named after something: that name.
    pub component: Option<Arc<str>>,
    /// The index, of the component if there is one.
    pub position: Option<Position>,
    /// The end of the step at which it is taken.
    pub end: Option<End>,
}

/// The index of an element of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Position {
    /// A number.
    At(usize),
    /// So much more than the index that counts rows.
    InRow(i64),
    /// So much more than the index that counts the terms of a sum.
    InSum(i64),
}

/// An end of the step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum End {
    /// The earlier one, `x₀`.
    Start,
    /// The later one, `x₁`.
    End,
}

impl Symbol {
    /// A symbol of the compiler's own, without index and end.
    pub fn plain(base: &str) -> Self {
        Self {
            base: base.into(),
            component: None,
            position: None,
            end: None,
        }
    }

    /// The component of `base` that belongs to the variable `name`: `f^τ[q[2]]`.
    pub fn component(base: &str, name: &Name) -> Self {
        let of = Self::from(name);
        Self {
            base: base.into(),
            component: Some(of.base),
            position: of.position,
            end: None,
        }
    }

    /// This symbol with its index measured from `from`.
    pub(crate) fn shifted(&self, from: usize, position: fn(i64) -> Position) -> Self {
        let shifted = match self.position {
            Some(Position::At(index)) => {
                let distance = i64::try_from(index).unwrap_or(i64::MAX)
                    - i64::try_from(from).unwrap_or(i64::MAX);
                Some(position(distance))
            }
            other => other,
        };
        Self {
            position: shifted,
            ..self.clone()
        }
    }
}

impl From<&Name> for Symbol {
    fn from(name: &Name) -> Self {
        let text = name.as_str();
        let (text, end) = match (text.strip_suffix('₀'), text.strip_suffix('₁')) {
            (Some(text), _) => (text, Some(End::Start)),
            (_, Some(text)) => (text, Some(End::End)),
            _ => (text, None),
        };
        let element = text
            .strip_suffix(']')
            .and_then(|text| text.split_once('['))
            .and_then(|(base, index)| Some((base, index.parse().ok()?)));
        let (base, position) = match element {
            Some((base, index)) => (base, Some(Position::At(index))),
            None => (text, None),
        };
        Self {
            base: base.into(),
            component: None,
            position,
            end,
        }
    }
}
