//! Sparse Laurent polynomials with Gaussian-rational coefficients, as elements of the free
//! ring over the atoms: relations between atoms are the business of
//! [`Algebra`](super::algebra::Algebra).

use std::cmp::Ordering;

use super::Obstacle;
use super::monomial::{self, Atom, Exponent, Monomial, Power};
use super::number::{Coefficient, Number};

/// No polynomial has more terms than this.
const MOST_TERMS: usize = 20_000;
/// No product forms more terms than this, before equal ones are collected.
const MOST_PRODUCTS: usize = 120_000;

/// coefficient · monomial, the coefficient not zero.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Term {
    pub(super) monomial: Monomial,
    pub(super) coefficient: Coefficient,
}

impl Term {
    pub(super) fn mul(&self, other: &Self) -> Result<Self, Obstacle> {
        Ok(Self {
            monomial: monomial::product(&self.monomial, &other.monomial)?,
            coefficient: self.coefficient.mul(&other.coefficient),
        })
    }

    /// 1/self
    pub(super) fn inverse(&self) -> Result<Self, Obstacle> {
        Ok(Self {
            monomial: monomial::inverse(&self.monomial)?,
            coefficient: self.coefficient.recip().ok_or(Obstacle::Undefined)?,
        })
    }
}

/// A sum of terms in falling order of their monomials; zero has none.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Polynomial {
    terms: Vec<Term>,
}

impl Polynomial {
    pub(super) fn zero() -> Self {
        Self::default()
    }

    pub(super) fn one() -> Self {
        Self::constant(Coefficient::ONE)
    }

    pub(super) fn constant(coefficient: Coefficient) -> Self {
        Self::from(Term {
            monomial: Monomial::new(),
            coefficient,
        })
    }

    pub(super) fn atom(atom: Atom, exponent: Exponent) -> Self {
        Self::from(Term {
            monomial: vec![Power { atom, exponent }],
            coefficient: Coefficient::ONE,
        })
    }

    /// The sum of `terms`, which come in any order and may repeat.
    pub(super) fn collect(mut terms: Vec<Term>) -> Self {
        terms.sort_by(|a, b| monomial::compare(&b.monomial, &a.monomial));
        let mut collected: Vec<Term> = Vec::with_capacity(terms.len());
        for term in terms {
            match collected.last_mut() {
                Some(last) if last.monomial == term.monomial => {
                    last.coefficient = last.coefficient.add(&term.coefficient);
                }
                _ => {
                    if collected
                        .last()
                        .is_some_and(|last| last.coefficient.is_zero())
                    {
                        collected.pop();
                    }
                    collected.push(term);
                }
            }
        }
        if collected
            .last()
            .is_some_and(|last| last.coefficient.is_zero())
        {
            collected.pop();
        }
        Self { terms: collected }
    }

    /// The sum of `terms`, which come in falling order of their monomials.
    pub(super) fn from_sorted(terms: Vec<Term>) -> Self {
        Self { terms }
    }

    pub(super) fn terms(&self) -> &[Term] {
        &self.terms
    }

    pub(super) fn into_terms(self) -> Vec<Term> {
        self.terms
    }

    pub(super) fn len(&self) -> usize {
        self.terms.len()
    }

    pub(super) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// What going over all terms takes, that of a term with small coefficients being 1.
    pub(super) fn work(&self) -> usize {
        self.terms.iter().map(|term| term.coefficient.work()).sum()
    }

    /// What multiplying with `other` takes.
    pub(super) fn work_of_product(&self, other: &Self) -> usize {
        let own = self.work().saturating_mul(other.len());
        own.saturating_add(other.work().saturating_mul(self.len())) / 2
    }

    /// What multiplying with `term` takes.
    pub(super) fn work_of_product_with(&self, term: &Term) -> usize {
        (self.work() + self.len().saturating_mul(term.coefficient.work())) / 2
    }

    pub(super) fn is_one(&self) -> bool {
        self.as_constant().is_some_and(Coefficient::is_one)
    }

    /// The only term, if there is just one.
    pub(super) fn as_term(&self) -> Option<&Term> {
        match self.terms.as_slice() {
            [term] => Some(term),
            _ => None,
        }
    }

    /// The value, if there is just a term without atoms.
    pub(super) fn as_constant(&self) -> Option<&Coefficient> {
        self.as_term()
            .filter(|term| term.monomial.is_empty())
            .map(|term| &term.coefficient)
    }

    pub(super) fn add(&self, other: &Self) -> Result<Self, Obstacle> {
        let sum = merge(self.terms.clone(), other.terms.clone());
        Self { terms: sum }.checked()
    }

    fn checked(self) -> Result<Self, Obstacle> {
        if self.len() > MOST_TERMS {
            return Err(Obstacle::TooLarge);
        }
        Ok(self)
    }

    pub(super) fn neg(&self) -> Self {
        let terms = self.terms.iter().map(|term| Term {
            monomial: term.monomial.clone(),
            coefficient: term.coefficient.neg(),
        });
        Self {
            terms: terms.collect(),
        }
    }

    pub(super) fn scaled(&self, factor: &Coefficient) -> Self {
        if factor.is_zero() {
            return Self::zero();
        }
        let terms = self.terms.iter().map(|term| Term {
            monomial: term.monomial.clone(),
            coefficient: term.coefficient.mul(factor),
        });
        Self {
            terms: terms.collect(),
        }
    }

    /// The complex conjugate where the powers of the atoms in `phases` lie on the unit circle
    /// and every other atom is real.
    pub(super) fn conjugate(&self, is_phase: impl Fn(Atom) -> bool) -> Result<Self, Obstacle> {
        let mut terms = Vec::with_capacity(self.len());
        for term in &self.terms {
            let mut monomial = term.monomial.clone();
            for power in &mut monomial {
                if is_phase(power.atom) {
                    power.exponent = power.exponent.neg()?;
                }
            }
            terms.push(Term {
                monomial,
                coefficient: term.coefficient.conjugate(),
            });
        }
        Ok(Self::collect(terms))
    }

    pub(super) fn times_term(&self, factor: &Term) -> Result<Self, Obstacle> {
        if factor.monomial.is_empty() {
            return Ok(if factor.coefficient.is_one() {
                self.clone()
            } else {
                self.scaled(&factor.coefficient)
            });
        }
        let terms: Result<_, _> = self.terms.iter().map(|term| term.mul(factor)).collect();
        Ok(Self { terms: terms? })
    }

    pub(super) fn mul(&self, other: &Self) -> Result<Self, Obstacle> {
        let (short, long) = if self.len() <= other.len() {
            (self, other)
        } else {
            (other, self)
        };
        if short.len() * long.len() > MOST_PRODUCTS {
            return Err(Obstacle::TooLarge);
        }
        // rows are merged in pairs of similar length
        let mut rows: Vec<Vec<Term>> = Vec::with_capacity(short.len());
        for term in &short.terms {
            rows.push(long.times_term(term)?.terms);
        }
        while rows.len() > 1 {
            let mut merged = Vec::with_capacity(rows.len().div_ceil(2));
            let mut rest = rows.into_iter();
            while let Some(first) = rest.next() {
                merged.push(match rest.next() {
                    Some(second) => merge(first, second),
                    None => first,
                });
            }
            rows = merged;
        }
        Self {
            terms: rows.pop().unwrap_or_default(),
        }
        .checked()
    }

    /// The positive rational that divides every coefficient, real and imaginary parts alike,
    /// and leaves integers without a common factor.
    pub(super) fn content(&self) -> Number {
        let parts = self
            .terms
            .iter()
            .flat_map(|term| [&term.coefficient.re, &term.coefficient.im])
            .filter(|number| !number.is_zero());
        let mut content: Option<Number> = None;
        for part in parts {
            content = Some(match content {
                None if part.is_negative() => part.neg(),
                None => part.clone(),
                Some(known) if known.is_one() && part.as_integer().is_some() => known,
                Some(known) => known.gcd(part),
            });
        }
        content.unwrap_or(Number::ONE)
    }

    /// Whether the leading coefficient is negative: its real part or, without one, its
    /// imaginary part.
    pub(super) fn leads_negative(&self) -> bool {
        self.terms.first().is_some_and(|term| {
            let Coefficient { re, im } = &term.coefficient;
            if re.is_zero() {
                im.is_negative()
            } else {
                re.is_negative()
            }
        })
    }
}

impl From<Term> for Polynomial {
    fn from(term: Term) -> Self {
        if term.coefficient.is_zero() {
            return Self::zero();
        }
        Self { terms: vec![term] }
    }
}

/// The sum of two sums in falling order.
pub(super) fn merge(first: Vec<Term>, second: Vec<Term>) -> Vec<Term> {
    if first.is_empty() {
        return second;
    }
    if second.is_empty() {
        return first;
    }
    let mut sum = Vec::with_capacity(first.len() + second.len());
    let mut first = first.into_iter();
    let mut second = second.into_iter();
    let (mut a, mut b) = (first.next(), second.next());
    loop {
        match (a, b) {
            (None, None) => break,
            (Some(rest), None) => {
                sum.push(rest);
                sum.extend(first);
                break;
            }
            (None, Some(rest)) => {
                sum.push(rest);
                sum.extend(second);
                break;
            }
            (Some(p), Some(q)) => match monomial::compare(&p.monomial, &q.monomial) {
                Ordering::Greater => {
                    sum.push(p);
                    (a, b) = (first.next(), Some(q));
                }
                Ordering::Less => {
                    sum.push(q);
                    (a, b) = (Some(p), second.next());
                }
                Ordering::Equal => {
                    let coefficient = p.coefficient.add(&q.coefficient);
                    if !coefficient.is_zero() {
                        sum.push(Term {
                            monomial: p.monomial,
                            coefficient,
                        });
                    }
                    (a, b) = (first.next(), second.next());
                }
            },
        }
    }
    sum
}
