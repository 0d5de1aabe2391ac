//! Sums and products of formulas: signs taken out, like terms and equal factors brought together.

use num_traits::{One, Signed, Zero};

use super::formula::{Formula, FormulaId, Formulas, Product, Term};
use crate::algebra::Rational;

impl Formulas {
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
