//! Formulas as written.

use proc_macro2::Ident;

use super::{Comparison, Range};
use crate::algebra::Rational;
use crate::diagnostics::Extent;
use crate::diagnostics::catalogue::syntax::DEPTH;

/// The longest chain of operations; later stages go through formulas recursively.
const TALLEST: usize = 400;

/// A formula as written.
#[derive(Debug, Clone)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Where it stands.
    pub extent: Extent,
    /// The length of the longest path to a leaf.
    height: usize,
}

/// The kinds of formulas.
#[derive(Debug, Clone)]
pub enum ExpressionKind {
    /// An exact constant, with the literal that it was read from.
    Number {
        /// Its value.
        value: Rational,
        /// Its literal.
        text: String,
    },
    /// A name.
    Name(Ident),
    /// `function(arguments)`
    Call {
        /// The function's name.
        function: Ident,
        /// Its arguments.
        arguments: Vec<Expression>,
    },
    /// `group[index]`
    Element {
        /// The group's name.
        group: Ident,
        /// Which element: a formula of constants whose value is an integer.
        index: Box<Expression>,
    },
    /// `sum(i in start..end, term)`
    Sum {
        /// The name that counts.
        variable: Ident,
        /// What it counts through.
        range: Box<Range>,
        /// The term.
        term: Box<Expression>,
    },
    /// `if a > b { then } else { otherwise }`, `if a > b sliding { … } else { … }`
    If {
        /// What decides.
        condition: Box<Comparison>,
        /// Whether a solution may slide where the two are equal.
        slides: bool,
        /// The value where it holds.
        then: Box<Expression>,
        /// The value where it does not.
        otherwise: Box<Expression>,
    },
    /// −operand
    Negative(Box<Expression>),
    /// left operator right
    Binary {
        /// The operation.
        operator: Operator,
        /// The operand on its left.
        left: Box<Expression>,
        /// The operand on its right.
        right: Box<Expression>,
    },
    /// A formula in parentheses.
    Parenthesised(Box<Expression>),
}

/// The operations on two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
    /// `%`: the remainder, of integer constants alone (`q[(i + 1) % n]`); never negative.
    Remainder,
}

impl Operator {
    /// The sign that it is written with.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
            Self::Remainder => "%",
        }
    }
}

impl Expression {
    pub(super) fn new(kind: ExpressionKind, extent: Extent) -> syn::Result<Self> {
        let below = match &kind {
            ExpressionKind::Number { .. } | ExpressionKind::Name(_) => 0,
            ExpressionKind::Call { arguments, .. } => {
                arguments.iter().map(|a| a.height).max().unwrap_or(0)
            }
            ExpressionKind::Negative(operand)
            | ExpressionKind::Parenthesised(operand)
            | ExpressionKind::Element { index: operand, .. } => operand.height,
            ExpressionKind::Sum { range, term, .. } => {
                term.height.max(range.start.height).max(range.end.height)
            }
            ExpressionKind::Binary { left, right, .. } => left.height.max(right.height),
            ExpressionKind::If {
                condition,
                then,
                otherwise,
                ..
            } => {
                let parts = [&condition.left, &condition.right, then, otherwise];
                parts.map(|part| part.height).into_iter().max().unwrap_or(0)
            }
        };
        if below >= TALLEST {
            let message = "this formula is too long; name parts of it with `let`";
            return Err(DEPTH.error(extent, message));
        }
        Ok(Self {
            kind,
            extent,
            height: below + 1,
        })
    }

    /// The formula that is an integer, which stands for what is at `extent`.
    pub(super) fn integer(value: usize, extent: Extent) -> Self {
        Self {
            kind: ExpressionKind::Number {
                value: Rational::from_integer(value.into()),
                text: value.to_string(),
            },
            extent,
            height: 1,
        }
    }

    pub(super) fn binary(operator: Operator, left: Self, right: Self) -> syn::Result<Self> {
        let extent = left.extent.to(right.extent);
        let kind = ExpressionKind::Binary {
            operator,
            left: Box::new(left),
            right: Box::new(right),
        };
        Self::new(kind, extent)
    }

    /// The formula without the parentheses around all of it.
    pub fn inside_parentheses(&self) -> &Self {
        match &self.kind {
            ExpressionKind::Parenthesised(inner) => inner.inside_parentheses(),
            _ => self,
        }
    }

    /// The name, if the formula is nothing else.
    pub fn as_name(&self) -> Option<&Ident> {
        match &self.kind {
            ExpressionKind::Name(ident) => Some(ident),
            _ => None,
        }
    }
}
