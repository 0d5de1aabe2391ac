//! Formulas in an arena: sums of signed terms, products over a denominator.

use std::collections::HashMap;
use std::ops::Index;

use num_traits::{One, Signed, Zero};

use super::symbol::Symbol;
use crate::algebra::{Function, Id, Name, PairFunction, Rational};

/// A formula of an arena.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FormulaId(u32);

/// A formula on formulas of the same arena.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
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
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
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
    collects: bool,
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

    /// The sum of signed terms; negative terms change the sign, and −(a + b) is taken apart.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = (bool, FormulaId)>) -> FormulaId {
        let mut collected: Vec<Term> = Vec::new();
        for (negative, formula) in terms {
            let (flipped, formula) = self.size_of_negative(formula);
            let negative = negative != flipped;
            match &self[formula] {
                Formula::Sum(inner) if flipped => {
                    collected.extend(inner.iter().map(|term| Term {
                        negative: term.negative != negative,
                        formula: term.formula,
                    }));
                }
                _ => collected.push(Term { negative, formula }),
            }
        }
        if self.collects {
            collected = self.like_terms(collected);
            // a - b reads better than -b + a
            if let Some(place) = collected.iter().position(|term| !term.negative) {
                collected[..=place].rotate_right(1);
            }
        }
        match &collected[..] {
            [] => self.integer(0),
            [only] if !only.negative => only.formula,
            [only] => self.product(true, [(false, only.formula)]),
            _ => self.insert(Formula::Sum(collected)),
        }
    }

    /// −u as (true, u), anything else as it is.
    fn size_of_negative(&mut self, id: FormulaId) -> (bool, FormulaId) {
        match &self[id] {
            Formula::Constant(value) if value.is_negative() => {
                let size = value.abs();
                (true, self.insert(Formula::Constant(size)))
            }
            Formula::Product(product) if product.negative => {
                let mut product = product.clone();
                product.negative = false;
                (true, self.finished(product))
            }
            _ => (false, id),
        }
    }

    /// Terms with their like terms added to them, at the place of the first.
    fn like_terms(&mut self, terms: Vec<Term>) -> Vec<Term> {
        let mut collected: Vec<(FormulaId, Term, Rational, usize)> = Vec::new();
        for term in terms {
            let (coefficient, rest) = self.coefficient(term);
            match collected.iter_mut().find(|other| other.0 == rest) {
                Some(other) => {
                    other.2 += coefficient;
                    other.3 += 1;
                }
                None => collected.push((rest, term, coefficient, 1)),
            }
        }
        let mut terms = Vec::new();
        for (_, term, coefficient, count) in collected {
            if count == 1 {
                terms.push(term);
            } else if !coefficient.is_zero() {
                let scaled = self.scaled(term.formula, coefficient.abs());
                terms.push(Term {
                    negative: coefficient.is_negative(),
                    formula: scaled,
                });
            }
        }
        terms
    }

    /// A term's coefficient, and the term without it and with its factors in a fixed order.
    fn coefficient(&mut self, term: Term) -> (Rational, FormulaId) {
        let sign = if term.negative {
            -Rational::one()
        } else {
            Rational::one()
        };
        match &self[term.formula] {
            Formula::Constant(value) => (sign * value, self.integer(1)),
            Formula::Product(product) => {
                let mut rest = product.clone();
                let coefficient = sign * std::mem::replace(&mut rest.constant, Rational::one());
                rest.above.sort_unstable();
                rest.below.sort_unstable();
                (coefficient, self.finished(rest))
            }
            _ => (sign, term.formula),
        }
    }

    /// `term` with the coefficient `size`, which is not negative, in place of its own.
    fn scaled(&mut self, term: FormulaId, size: Rational) -> FormulaId {
        let mut product = match &self[term] {
            Formula::Constant(_) => return self.insert(Formula::Constant(size)),
            Formula::Product(product) => product.clone(),
            _ => Product::of(term),
        };
        product.constant = size;
        self.finished(product)
    }

    /// The product of factors; those marked are divided by. Products among them are taken apart.
    pub fn product(
        &mut self,
        negative: bool,
        factors: impl IntoIterator<Item = (bool, FormulaId)>,
    ) -> FormulaId {
        let mut product = Product {
            negative,
            constant: Rational::one(),
            above: Vec::new(),
            below: Vec::new(),
        };
        for (inverse, factor) in factors {
            match &self[factor] {
                // a division by the constant zero is shown as it stands
                Formula::Constant(value) if !(inverse && value.is_zero()) => {
                    product.scale(value, inverse);
                }
                Formula::Product(inner) if !(inverse && inner.constant.is_zero()) => {
                    product.negative ^= inner.negative;
                    product.scale(&inner.constant, inverse);
                    let (above, below) = product.sides(inverse);
                    above.extend(&inner.above);
                    below.extend(&inner.below);
                }
                _ => product.sides(inverse).0.push(factor),
            }
        }
        if self.collects {
            product.above = self.equal_factors(product.above);
            product.below = self.equal_factors(product.below);
            self.cancel(&mut product);
        }
        self.finished(product)
    }

    /// Factors with equal ones as powers, at the place of the first.
    fn equal_factors(&mut self, factors: Vec<FormulaId>) -> Vec<FormulaId> {
        let mut collected: Vec<(FormulaId, FormulaId, Rational, usize)> = Vec::new();
        for factor in factors {
            let (base, exponent) = self.base(factor);
            match collected.iter_mut().find(|other| other.1 == base) {
                Some(other) => {
                    other.2 += exponent;
                    other.3 += 1;
                }
                None => collected.push((factor, base, exponent, 1)),
            }
        }
        collected
            .into_iter()
            .map(|(factor, base, exponent, count)| match count {
                1 => factor,
                _ => self.power(base, exponent),
            })
            .collect()
    }

    /// A factor as a power with a constant exponent.
    fn base(&self, factor: FormulaId) -> (FormulaId, Rational) {
        if let Formula::Power(base, exponent) = self[factor]
            && let Formula::Constant(value) = &self[exponent]
        {
            return (base, value.clone());
        }
        (factor, Rational::one())
    }

    /// Cancels the powers above the bar that are lower than those of the same base below it: of
    /// these something is left, so that no condition on the base is lost.
    fn cancel(&mut self, product: &mut Product) {
        let powers: Vec<(FormulaId, Rational)> = (product.above.iter())
            .map(|&factor| self.base(factor))
            .collect();
        let mut gone = vec![false; powers.len()];
        for place in 0..product.below.len() {
            let (base, exponent) = self.base(product.below[place]);
            let Some(above) = powers.iter().position(|(other, _)| *other == base) else {
                continue;
            };
            let lower = &powers[above].1;
            if lower.is_positive() && *lower < exponent {
                product.below[place] = self.power(base, exponent - lower);
                gone[above] = true;
            }
        }
        let mut gone = gone.into_iter();
        product.above.retain(|_| gone.next() != Some(true));
    }

    /// A product, or what it amounts to.
    pub(super) fn finished(&mut self, product: Product) -> FormulaId {
        if product.below.is_empty() {
            if let Some(sum) = self.negated(&product) {
                return sum;
            }
            match &product.above[..] {
                [] => {
                    let sign = if product.negative {
                        -Rational::one()
                    } else {
                        Rational::one()
                    };
                    return self.insert(Formula::Constant(sign * product.constant));
                }
                [only] if !product.negative && product.constant.is_one() => return *only,
                _ => {}
            }
        }
        self.insert(Formula::Product(product))
    }

    /// b − a for −(a − b).
    fn negated(&mut self, product: &Product) -> Option<FormulaId> {
        let ([only], true) = (&product.above[..], self.collects) else {
            return None;
        };
        match &self[*only] {
            Formula::Sum(terms)
                if product.negative
                    && product.constant.is_one()
                    && terms.iter().any(|term| term.negative) =>
            {
                let terms = terms.clone();
                let flipped = terms.iter().map(|term| (!term.negative, term.formula));
                Some(self.sum(flipped))
            }
            _ => None,
        }
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

impl Product {
    fn of(factor: FormulaId) -> Self {
        Self {
            negative: false,
            constant: Rational::one(),
            above: vec![factor],
            below: Vec::new(),
        }
    }

    fn scale(&mut self, value: &Rational, inverse: bool) {
        self.negative ^= value.is_negative();
        let size = value.abs();
        if inverse {
            self.constant /= size;
        } else {
            self.constant *= size;
        }
    }

    /// The side that a factor stands on, and the other.
    fn sides(&mut self, inverse: bool) -> (&mut Vec<FormulaId>, &mut Vec<FormulaId>) {
        if inverse {
            (&mut self.below, &mut self.above)
        } else {
            (&mut self.above, &mut self.below)
        }
    }
}
