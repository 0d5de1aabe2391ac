//! Formulas in an arena: sums of signed terms, products over a denominator.

use std::collections::HashMap;
use std::ops::Index;

use num_traits::{One, Zero};

use super::symbol::Symbol;
use crate::algebra::{Function, Id, Name, PairFunction, Rational};

/// A formula of an arena.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FormulaId(u32);

/// A formula on formulas of the same arena.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Formula {
    /// An exact constant.
    Constant(Rational),
    /// π
    Pi,
    /// A variable.
    Symbol(Symbol),
    /// A function of one argument.
    Call(Function, FormulaId),
    /// A function of two arguments.
    Pair(PairFunction, [FormulaId; 2]),
    /// A base with its exponent.
    Power(FormulaId, FormulaId),
    /// A sum of terms.
    Sum(Vec<Term>),
    /// A product.
    Product(Product),
    /// The sum of a term over `first..=last`, its index being [`InSum`](super::Position::InSum).
    Total {
        /// The term.
        term: FormulaId,
        /// The first value of the index.
        first: usize,
        /// The last one.
        last: usize,
    },
    /// The formula with that number in a list of shared ones, one for every row if it has the
    /// index that counts rows.
    Shared {
        /// The number.
        number: usize,
        /// Whether it depends on the row.
        in_row: bool,
    },
}

/// A term of a sum, with its sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Term {
    /// Whether it is subtracted.
    pub negative: bool,
    /// The term.
    pub formula: FormulaId,
}

/// ± constant · numerator / denominator
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Product {
    /// The sign.
    pub negative: bool,
    /// The constant, which is not negative.
    pub constant: Rational,
    /// The factors above the bar.
    pub above: Vec<FormulaId>,
    /// The factors below it.
    pub below: Vec<FormulaId>,
}

/// A formula for each formula of an arena, where there is one.
#[derive(Debug, Default)]
pub(super) struct Image(Vec<u32>);

impl Image {
    /// Nothing yet, with room for the formulas that there are.
    pub(super) fn of(formulas: &Formulas) -> Self {
        Self(vec![0; formulas.nodes.len()])
    }

    /// The image of `id`.
    pub(super) fn get(&self, id: FormulaId) -> Option<FormulaId> {
        let stored = self.0.get(id.0 as usize).copied().unwrap_or(0);
        stored.checked_sub(1).map(FormulaId)
    }

    /// Makes `image` the image of `id`.
    pub(super) fn insert(&mut self, id: FormulaId, image: FormulaId) {
        let place = id.0 as usize;
        if place >= self.0.len() {
            self.0.resize((place + 1).next_power_of_two(), 0);
        }
        self.0[place] = image.0 + 1;
    }
}

/// An arena of formulas.
#[derive(Debug, Default)]
pub struct Formulas {
    nodes: Vec<Formula>,
    memo: HashMap<Formula, FormulaId>,
    /// Whether equal factors and like terms are brought together.
    pub(super) collects: bool,
    /// What variables of the compiler's own are written as.
    pub(super) written_as: HashMap<Name, Symbol>,
    /// The formulas of expressions.
    pub(super) image: HashMap<Id, FormulaId>,
}

impl Index<FormulaId> for Formulas {
    type Output = Formula;

    fn index(&self, id: FormulaId) -> &Formula {
        &self.nodes[id.0 as usize]
    }
}

impl Formulas {
    /// An arena in which expressions are written as they are.
    pub fn as_they_are() -> Self {
        Self::default()
    }

    /// An arena in which equal factors become powers and like terms one term; `written_as`
    /// tells what variables of the compiler's own are written as.
    pub fn collected(written_as: HashMap<Name, Symbol>) -> Self {
        Self {
            collects: true,
            written_as,
            ..Self::default()
        }
    }

    /// Forgets which formulas expressions have; from now on variables of the compiler's own are
    /// written as `written_as` tells.
    pub fn write_as(&mut self, written_as: HashMap<Name, Symbol>) {
        self.written_as = written_as;
        self.image.clear();
    }

    /// Adds a formula as it stands; an equal one is shared.
    pub(super) fn insert(&mut self, formula: Formula) -> FormulaId {
        if let Some(&id) = self.memo.get(&formula) {
            return id;
        }
        let id = FormulaId(self.nodes.len() as u32);
        self.nodes.push(formula.clone());
        self.memo.insert(formula, id);
        id
    }

    /// A symbol.
    pub fn symbol(&mut self, symbol: Symbol) -> FormulaId {
        self.insert(Formula::Symbol(symbol))
    }

    /// An integer.
    pub fn integer(&mut self, value: i64) -> FormulaId {
        self.insert(Formula::Constant(Rational::from_integer(value.into())))
    }

    /// Whether `id` is the constant zero.
    pub fn is_zero(&self, id: FormulaId) -> bool {
        matches!(&self[id], Formula::Constant(value) if value.is_zero())
    }

    /// base^exponent
    pub(super) fn power(&mut self, base: FormulaId, exponent: Rational) -> FormulaId {
        if exponent.is_one() {
            return base;
        }
        let exponent = self.insert(Formula::Constant(exponent));
        self.insert(Formula::Power(base, exponent))
    }

    /// Calls `visit` with every formula that `id` is directly made of.
    pub(super) fn for_each_part(&self, id: FormulaId, mut visit: impl FnMut(FormulaId)) {
        match &self[id] {
            Formula::Constant(_) | Formula::Pi | Formula::Symbol(_) | Formula::Shared { .. } => {}
            Formula::Call(_, u) => visit(*u),
            Formula::Total { term, .. } => visit(*term),
            Formula::Pair(_, [u, v]) | Formula::Power(u, v) => [*u, *v].into_iter().for_each(visit),
            Formula::Sum(terms) => terms.iter().for_each(|term| visit(term.formula)),
            Formula::Product(product) => {
                let factors = product.above.iter().chain(&product.below);
                factors.copied().for_each(visit);
            }
        }
    }

    /// The formula with its parts replaced. Nothing is taken apart or brought together anew.
    pub(super) fn with_parts(
        &mut self,
        id: FormulaId,
        mut replace: impl FnMut(FormulaId) -> FormulaId,
    ) -> FormulaId {
        let formula = match self[id].clone() {
            leaf @ (Formula::Constant(_)
            | Formula::Pi
            | Formula::Symbol(_)
            | Formula::Shared { .. }) => leaf,
            Formula::Call(function, u) => Formula::Call(function, replace(u)),
            Formula::Pair(function, parts) => Formula::Pair(function, parts.map(replace)),
            Formula::Power(base, exponent) => Formula::Power(replace(base), replace(exponent)),
            Formula::Total { term, first, last } => Formula::Total {
                term: replace(term),
                first,
                last,
            },
            Formula::Sum(mut terms) => {
                for term in &mut terms {
                    term.formula = replace(term.formula);
                }
                Formula::Sum(terms)
            }
            Formula::Product(mut product) => {
                for factor in product.above.iter_mut().chain(&mut product.below) {
                    *factor = replace(*factor);
                }
                Formula::Product(product)
            }
        };
        self.insert(formula)
    }

    /// The formulas that `roots` are made of, each once, parts before wholes.
    pub(super) fn reachable(&self, roots: &[FormulaId]) -> Vec<FormulaId> {
        let mut seen = vec![false; self.nodes.len()];
        let mut reached = Vec::new();
        let mut stack = roots.to_vec();
        while let Some(id) = stack.pop() {
            if !std::mem::replace(&mut seen[id.0 as usize], true) {
                reached.push(id);
                self.for_each_part(id, |part| stack.push(part));
            }
        }
        // parts are made before wholes
        reached.sort_unstable();
        reached
    }
}
