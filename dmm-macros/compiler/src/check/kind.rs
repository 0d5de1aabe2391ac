//! The kinds of names.

use std::fmt::{self, Display, Formatter};

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A state, or a group of states.
    State,
    /// A parameter, or a group of parameters.
    Parameter,
    /// A discrete state.
    Discrete,
    /// A `const`.
    Constant,
    /// A `let`.
    Let,
    /// An interface.
    Interface,
    /// A `fn`.
    Function,
    /// An argument of a `fn`.
    Argument,
    /// The variable of a `for` or a `sum`.
    Counter,
}

impl Kind {
    /// What a formula is made of.
    pub(super) const QUANTITIES: &[Self] = &[
        Self::State,
        Self::Parameter,
        Self::Discrete,
        Self::Constant,
        Self::Let,
        Self::Argument,
        Self::Counter,
    ];

    /// With its article: `an interface`.
    pub(super) fn article(self) -> String {
        let article = match self {
            Self::Interface | Self::Argument => "an",
            _ => "a",
        };
        format!("{article} {self}")
    }
}

impl Display for Kind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::State => "state",
            Self::Parameter => "parameter",
            Self::Discrete => "discrete state",
            Self::Constant => "constant",
            Self::Let => "`let`",
            Self::Interface => "interface",
            Self::Function => "function",
            Self::Argument => "argument",
            Self::Counter => "loop variable",
        })
    }
}
