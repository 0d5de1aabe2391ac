//! The language of the e-graph: [`Math`] in a few machine words, without anything that has to
//! be cloned or counted. Constants and variables are numbers; the operands of a sum or product
//! have no order, so that half as many nodes say the same.

use std::hash::{Hash, Hasher};

use egg::{Id, Language};

use crate::algebra::{Function, Math, PairFunction};

/// What an operation does with its operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Symbol {
    /// A leaf that depends on parameters alone, by its number.
    Fixed(u32),
    /// Another leaf, by its number.
    Varying(u32),
    /// An exact number, by its number in [`Constants`](super::constants::Constants).
    Constant(u32),
    /// π
    Pi,
    /// a + b
    Add,
    /// a − b
    Sub,
    /// a·b
    Mul,
    /// a/b
    Div,
    /// −a
    Neg,
    /// aᵇ
    Pow,
    /// A function of one argument.
    Call(Function),
    /// A function of two arguments.
    Pair(PairFunction),
}

impl Symbol {
    /// That of a node; leaves but π have none by themselves.
    pub(super) fn of(node: &Math) -> Option<Self> {
        Some(match node {
            Math::Constant(_) | Math::Variable(_) => return None,
            Math::Pi => Self::Pi,
            Math::Add(_) => Self::Add,
            Math::Sub(_) => Self::Sub,
            Math::Mul(_) => Self::Mul,
            Math::Div(_) => Self::Div,
            Math::Neg(_) => Self::Neg,
            Math::Pow(_) => Self::Pow,
            Math::Call(function, _) => Self::Call(*function),
            Math::Pair(function, _) => Self::Pair(*function),
        })
    }

    /// The node with this symbol; leaves but π have none by themselves.
    pub(super) fn node(self, operands: &[Id]) -> Option<Math> {
        Some(match (self, operands) {
            (Self::Pi, _) => Math::Pi,
            (Self::Add, &[a, b]) => Math::Add([a, b]),
            (Self::Sub, &[a, b]) => Math::Sub([a, b]),
            (Self::Mul, &[a, b]) => Math::Mul([a, b]),
            (Self::Div, &[a, b]) => Math::Div([a, b]),
            (Self::Pow, &[a, b]) => Math::Pow([a, b]),
            (Self::Neg, &[a]) => Math::Neg(a),
            (Self::Call(function), &[a]) => Math::Call(function, a),
            (Self::Pair(function), &[a, b]) => Math::Pair(function, [a, b]),
            _ => return None,
        })
    }

    /// The kind, without the number of a leaf or the name of a function.
    pub(super) fn kind(self) -> u8 {
        match self {
            Self::Fixed(_) => 0,
            Self::Varying(_) => 1,
            Self::Constant(_) => 2,
            Self::Pi => 3,
            Self::Add => 4,
            Self::Sub => 5,
            Self::Mul => 6,
            Self::Div => 7,
            Self::Neg => 8,
            Self::Pow => 9,
            Self::Call(_) => 10,
            Self::Pair(_) => 11,
        }
    }

    /// A number for every symbol.
    fn code(self) -> u64 {
        let number = match self {
            Self::Fixed(number) | Self::Varying(number) | Self::Constant(number) => number,
            Self::Call(function) => function as u32,
            Self::Pair(function) => function as u32,
            _ => 0,
        };
        u64::from(self.kind()) << 32 | u64::from(number)
    }

    /// Whether the order of the operands makes no difference.
    pub(super) fn is_commutative(self) -> bool {
        matches!(self, Self::Add | Self::Mul)
    }

    fn arity(self) -> usize {
        match self {
            Self::Fixed(_) | Self::Varying(_) | Self::Constant(_) | Self::Pi => 0,
            Self::Neg | Self::Call(_) => 1,
            _ => 2,
        }
    }
}

/// An operation on other nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Operation {
    /// What it does.
    pub(super) symbol: Symbol,
    /// The operands, those of a sum or product in rising order; what there is none of is 0.
    operands: [Id; 2],
}

impl Operation {
    /// `symbol` of as many operands as it has.
    pub(super) fn new(symbol: Symbol, operands: &[Id]) -> Self {
        let mut own = [Id::from(0); 2];
        for (own, operand) in own.iter_mut().zip(operands) {
            *own = *operand;
        }
        let mut operation = Self {
            symbol,
            operands: own,
        };
        operation.order();
        operation
    }

    /// Puts the operands in their order.
    fn order(&mut self) {
        let [a, b] = self.operands;
        if self.symbol.is_commutative() && b < a {
            self.operands = [b, a];
        }
    }
}

// the integers are written out: hashing is most of what an e-graph does
impl Hash for Operation {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let [a, b] = self.operands.map(usize::from);
        state.write_u64(self.symbol.code());
        state.write_u64((a as u64) << 32 | b as u64);
    }
}

impl Language for Operation {
    type Discriminant = u8;

    fn discriminant(&self) -> u8 {
        self.symbol.kind()
    }

    fn matches(&self, other: &Self) -> bool {
        self.symbol == other.symbol
    }

    fn children(&self) -> &[Id] {
        &self.operands[..self.symbol.arity()]
    }

    fn children_mut(&mut self) -> &mut [Id] {
        &mut self.operands[..self.symbol.arity()]
    }

    fn update_children<F: FnMut(Id) -> Id>(&mut self, mut f: F) {
        for operand in self.children_mut() {
            *operand = f(*operand);
        }
        self.order();
    }
}
