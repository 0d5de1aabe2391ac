//! The language of expressions: an [`egg`] language, so that one hash-consed DAG serves
//! parsing, proofs, derivation, optimisation and emission alike.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::mem::discriminant;
use std::slice;
use std::str::FromStr;
use std::sync::Arc;

use egg::{FromOp, FromOpError, Id, Language};
use num_rational::BigRational;

use super::functions::{Function, PairFunction};

/// A node of an expression: an operation on other nodes of the same [`Dag`](super::Dag).
///
/// Not made by egg's `define_language!`, for the sake of the hash: that of a [`Rational`] is
/// Euclid's algorithm, in a time that grows with the square of its length, every time that a
/// node is looked up.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Math {
    /// π
    Pi,
    /// a + b
    Add([Id; 2]),
    /// a − b
    Sub([Id; 2]),
    /// a·b
    Mul([Id; 2]),
    /// a/b
    Div([Id; 2]),
    /// −a
    Neg(Id),
    /// aᵇ
    Pow([Id; 2]),
    /// An exact number.
    Constant(Rational),
    /// A function of one argument.
    Call(Function, Id),
    /// A function of two arguments.
    Pair(PairFunction, [Id; 2]),
    /// A variable.
    Variable(Name),
}

impl Hash for Math {
    fn hash<H: Hasher>(&self, state: &mut H) {
        discriminant(self).hash(state);
        match self {
            Self::Constant(value) => hash_number(value, state),
            Self::Variable(name) => name.hash(state),
            Self::Call(function, _) => function.hash(state),
            Self::Pair(function, _) => function.hash(state),
            _ => {}
        }
        self.children().hash(state);
    }
}

/// Hashes a number by its numerator and denominator; equal numbers are in the same, lowest
/// terms.
pub(super) fn hash_number<H: Hasher>(value: &Rational, state: &mut H) {
    value.numer().hash(state);
    value.denom().hash(state);
}

impl Language for Math {
    type Discriminant = std::mem::Discriminant<Self>;

    fn discriminant(&self) -> Self::Discriminant {
        discriminant(self)
    }

    fn matches(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Constant(a), Self::Constant(b)) => a == b,
            (Self::Variable(a), Self::Variable(b)) => a == b,
            (Self::Call(a, _), Self::Call(b, _)) => a == b,
            (Self::Pair(a, _), Self::Pair(b, _)) => a == b,
            _ => discriminant(self) == discriminant(other),
        }
    }

    fn children(&self) -> &[Id] {
        match self {
            Self::Pi | Self::Constant(_) | Self::Variable(_) => &[],
            Self::Neg(child) | Self::Call(_, child) => slice::from_ref(child),
            Self::Add(children)
            | Self::Sub(children)
            | Self::Mul(children)
            | Self::Div(children)
            | Self::Pow(children)
            | Self::Pair(_, children) => children,
        }
    }

    fn children_mut(&mut self) -> &mut [Id] {
        match self {
            Self::Pi | Self::Constant(_) | Self::Variable(_) => &mut [],
            Self::Neg(child) | Self::Call(_, child) => slice::from_mut(child),
            Self::Add(children)
            | Self::Sub(children)
            | Self::Mul(children)
            | Self::Div(children)
            | Self::Pow(children)
            | Self::Pair(_, children) => children,
        }
    }
}

impl fmt::Display for Math {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pi => f.write_str("pi"),
            Self::Add(_) => f.write_str("+"),
            Self::Sub(_) => f.write_str("-"),
            Self::Mul(_) => f.write_str("*"),
            Self::Div(_) => f.write_str("/"),
            Self::Neg(_) => f.write_str("neg"),
            Self::Pow(_) => f.write_str("^"),
            Self::Constant(value) => value.fmt(f),
            Self::Call(function, _) => function.fmt(f),
            Self::Pair(function, _) => function.fmt(f),
            Self::Variable(name) => name.fmt(f),
        }
    }
}

/// Reads the patterns of rules.
impl FromOp for Math {
    type Error = FromOpError;

    fn from_op(op: &str, children: Vec<Id>) -> Result<Self, FromOpError> {
        Ok(match (op, children.as_slice()) {
            ("pi", []) => Self::Pi,
            ("+", &[a, b]) => Self::Add([a, b]),
            ("-", &[a, b]) => Self::Sub([a, b]),
            ("*", &[a, b]) => Self::Mul([a, b]),
            ("/", &[a, b]) => Self::Div([a, b]),
            ("^", &[a, b]) => Self::Pow([a, b]),
            ("neg", &[a]) => Self::Neg(a),
            (name, &[]) => match name.parse() {
                Ok(value) => Self::Constant(value),
                Err(_) => Self::Variable(Name::new(name)),
            },
            (name, &[a]) => match name.parse() {
                Ok(function) => Self::Call(function, a),
                Err(_) => return Err(FromOpError::new(op, children)),
            },
            (name, &[a, b]) => match name.parse() {
                Ok(function) => Self::Pair(function, [a, b]),
                Err(_) => return Err(FromOpError::new(op, children)),
            },
            _ => return Err(FromOpError::new(op, children)),
        })
    }
}

/// An exact rational constant; it becomes a floating-point number only at emission.
pub type Rational = BigRational;

/// The name of a variable: a state, a parameter, the time, or a symbol of the compiler's own.
///
/// The values of a state `x` at the two ends of a step are the variables `x₀` and `x₁`
/// ([`Name::at_start`], [`Name::at_end`]); no identifier of a declaration can clash with
/// them, because a subscript digit is not allowed in one. Names are ordered as strings, so
/// that nothing depends on the order in which they were met.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Name(Arc<str>);

impl Name {
    /// The variable called `text`.
    pub fn new(text: &str) -> Self {
        Self(text.into())
    }

    /// The value of this variable at the start of a step, written `x₀`.
    pub fn at_start(&self) -> Self {
        Self(format!("{self}₀").into())
    }

    /// The value of this variable at the end of a step, written `x₁`.
    pub fn at_end(&self) -> Self {
        Self(format!("{self}₁").into())
    }

    /// The name as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl FromStr for Name {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(Self::new(text))
    }
}
