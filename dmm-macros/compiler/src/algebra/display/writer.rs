//! Formula → text in some notation: what every notation has in common.

use super::formula::{Formula, FormulaId, Formulas, Product, Term};
use super::symbol::Symbol;
use crate::algebra::{Function, PairFunction, Rational};

/// A formula is cut off after this many parts (as a tree it may be exponentially larger than
/// its arena).
const LARGEST_TEXT: usize = 4_000;
/// Parts are cut off below this many levels.
const DEEPEST_NESTING: usize = 120;

/// How tightly the outermost operation of a text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Precedence {
    Sum,
    Product,
    /// Holds together in a product, but cannot be raised to a power.
    Factor,
    Atom,
}

/// A text with its outermost operation.
pub(super) type Written = (String, Precedence);

/// How the operations are written.
pub(super) trait Notation {
    /// Stands for what is cut off.
    const DOTS: &'static str;
    /// π
    const PI: &'static str;
    /// What an exponent needs to bind as tightly as.
    const EXPONENT: Precedence;
    /// What the term of a total needs to bind as tightly as.
    const TOTAL: Precedence;

    fn constant(&self, value: &Rational) -> Written;
    fn symbol(&self, symbol: &Symbol) -> Written;
    fn shared(&self, number: usize, in_row: bool) -> String;
    fn call(&self, function: Function, argument: &str) -> Written;
    fn pair(&self, function: PairFunction, arguments: [&str; 2]) -> Written;
    fn power(&self, base: &str, exponent: &str) -> String;
    fn total(&self, term: &str, first: usize, last: usize) -> Written;
    fn product(writer: &mut Writer<'_, Self>, product: &Product) -> Written
    where
        Self: Sized;
    fn in_parentheses(text: &str) -> String;
}

/// Writes the formulas of an arena, no more than [`LARGEST_TEXT`] parts of them.
pub(super) struct Writer<'a, N> {
    formulas: &'a Formulas,
    notation: N,
    budget: usize,
    depth: usize,
}

impl<'a, N: Notation> Writer<'a, N> {
    pub(super) fn new(formulas: &'a Formulas, notation: N) -> Self {
        Self {
            formulas,
            notation,
            budget: LARGEST_TEXT,
            depth: 0,
        }
    }

    /// The terms of `root`, if it is a sum: each with its sign, ` + ` or ` - ` between them.
    pub(super) fn terms(&mut self, root: FormulaId) -> Vec<String> {
        match &self.formulas[root] {
            Formula::Sum(terms) => self.signed(terms),
            _ => vec![self.operand(root, Precedence::Sum)],
        }
    }

    /// `id`, in parentheses where it binds less tightly than `least`.
    pub(super) fn operand(&mut self, id: FormulaId, least: Precedence) -> String {
        let (text, precedence) = self.formula(id);
        if precedence < least {
            N::in_parentheses(&text)
        } else {
            text
        }
    }

    fn formula(&mut self, id: FormulaId) -> Written {
        if self.budget == 0 || self.depth >= DEEPEST_NESTING {
            return (N::DOTS.into(), Precedence::Atom);
        }
        self.budget -= 1;
        self.depth += 1;
        let written = match &self.formulas[id] {
            Formula::Constant(value) => self.notation.constant(value),
            Formula::Pi => (N::PI.into(), Precedence::Atom),
            Formula::Symbol(symbol) => self.notation.symbol(symbol),
            Formula::Shared { number, in_row } => {
                (self.notation.shared(*number, *in_row), Precedence::Atom)
            }
            Formula::Call(function, u) => {
                let argument = self.operand(*u, Precedence::Sum);
                self.notation.call(*function, &argument)
            }
            Formula::Pair(function, [a, b]) => {
                let a = self.operand(*a, Precedence::Sum);
                let b = self.operand(*b, Precedence::Sum);
                self.notation.pair(*function, [&a, &b])
            }
            Formula::Power(base, exponent) => {
                let base = self.operand(*base, Precedence::Atom);
                let exponent = self.operand(*exponent, N::EXPONENT);
                (self.notation.power(&base, &exponent), Precedence::Factor)
            }
            Formula::Total { term, first, last } => {
                let term = self.operand(*term, N::TOTAL);
                self.notation.total(&term, *first, *last)
            }
            Formula::Sum(terms) => (self.signed(terms).concat(), Precedence::Sum),
            Formula::Product(product) => N::product(self, product),
        };
        self.depth -= 1;
        written
    }

    /// Terms with their signs.
    fn signed(&mut self, terms: &[Term]) -> Vec<String> {
        let mut written = Vec::with_capacity(terms.len());
        for (place, term) in terms.iter().enumerate() {
            let sign = if place == 0 {
                if term.negative { "-" } else { "" }
            } else if term.negative {
                " - "
            } else {
                " + "
            };
            let term = self.operand(term.formula, Precedence::Product);
            written.push(format!("{sign}{term}"));
        }
        written
    }
}
