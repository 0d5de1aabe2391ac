//! What several expressions have in common: where all of them vanish.
//!
//! uᵢ = unit · Π factors · cofactorᵢ, the unit without zeros where the uᵢ are defined. All uᵢ
//! are zero where a factor is, or all cofactors are.

use std::collections::BTreeSet;

use super::super::evaluate::Interval;
use super::super::{Dag, Id};
use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::form::normal_form;
use super::fraction::Fraction;
use super::gcd::common_divisor;
use super::monomial::{Atom, Exponent};
use super::number::Number;
use super::polynomial::Polynomial;
use super::write_back::Writer;

/// The terms that may be formed before giving up.
const MOST_WORK: usize = 12_000;
/// Expressions whose numerators have more terms than this are given up.
const MOST_TERMS: usize = 64;
/// The answer has no more terms than this.
const MOST_TOLD: usize = 48;

/// The common zeros of several expressions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommonZeros {
    /// The common factors that can vanish, each to the first power.
    pub factors: Vec<Id>,
    /// What is left of those that are not identically zero; empty if one of them never
    /// vanishes.
    pub cofactors: Vec<Id>,
}

/// Where all of `roots` vanish, within their domain; `None` if all of them are identically
/// zero, or it takes too long to find out.
pub fn common_zeros(dag: &mut Dag, roots: &[Id]) -> Option<CommonZeros> {
    let mut algebra = Algebra::with_budget(dag, MOST_WORK);
    algebra.assume_domain(dag, roots.iter().copied());
    let mut forms = Vec::new();
    for &root in roots {
        let form = normal_form(&mut algebra, dag, root).ok()?;
        if form.numerator.len() > MOST_TERMS {
            return None;
        }
        let form = algebra.lowest_terms(form).ok()?;
        if !form.is_zero() {
            forms.push(form);
        }
    }
    let mut search = Search::new(&mut algebra, &forms)?;
    let (common, cofactors) = search.split(forms).ok()??;
    let told: usize = common.iter().chain(&cofactors).map(Polynomial::len).sum();
    if told > MOST_TOLD {
        return None;
    }
    let mut writer = Writer::new(dag, &mut algebra);
    let factors: Vec<Id> = common
        .iter()
        .map(|factor| writer.polynomial(factor))
        .collect::<Option<_>>()?;
    let cofactors: Vec<Id> = cofactors
        .iter()
        .map(|cofactor| writer.polynomial(cofactor))
        .collect::<Option<_>>()?;
    let can_vanish = |dag: &Dag, id: Id| !Interval::of(dag, id).nonzero;
    let never = cofactors.iter().any(|&id| !can_vanish(dag, id));
    let factors = factors
        .into_iter()
        .filter(|&id| can_vanish(dag, id))
        .collect();
    let mut distinct = Vec::new();
    for cofactor in cofactors {
        if !never && !distinct.contains(&cofactor) {
            distinct.push(cofactor);
        }
    }
    Some(CommonZeros {
        factors,
        cofactors: distinct,
    })
}

/// The common factors, and the cofactors.
type Split = (Vec<Polynomial>, Vec<Polynomial>);

/// The search for common factors.
struct Search<'a> {
    algebra: &'a mut Algebra,
    /// Atoms without zeros on the domain.
    units: BTreeSet<Atom>,
    /// Polynomials without zeros on the domain.
    unit_polynomials: Vec<Polynomial>,
    roots: Vec<Atom>,
}

impl<'a> Search<'a> {
    fn new(algebra: &'a mut Algebra, forms: &[Fraction]) -> Option<Self> {
        // whatever is divided by has no zeros
        let mut indices: BTreeSet<usize> = BTreeSet::new();
        let mut units: BTreeSet<Atom> = BTreeSet::new();
        let mut atoms: BTreeSet<Atom> = BTreeSet::new();
        for form in forms {
            indices.extend(form.denominator.iter().map(|&(index, _)| index));
            for (atom, least, _) in form.numerator.exponent_ranges() {
                atoms.insert(atom);
                if least.is_negative() {
                    units.insert(atom);
                }
            }
        }
        let mut unit_polynomials: Vec<Polynomial> = indices
            .into_iter()
            .filter_map(|index| algebra.factor(index).cloned())
            .collect();
        let mut roots = Vec::new();
        for atom in atoms {
            match algebra.kind(atom)?.clone() {
                Kind::Exp(_) | Kind::Phase(_) | Kind::Pi => {
                    units.insert(atom);
                }
                Kind::Root(base) => {
                    roots.push(atom);
                    if unit_polynomials.contains(&base.numerator) {
                        units.insert(atom);
                    } else if units.contains(&atom) {
                        unit_polynomials.push(base.numerator);
                    }
                }
                _ => {}
            }
        }
        Some(Self {
            algebra,
            units,
            unit_polynomials,
            roots,
        })
    }

    /// The common factors and the cofactors; nothing if there are no forms.
    fn split(&mut self, forms: Vec<Fraction>) -> Result<Option<Split>, Obstacle> {
        let mut monomials: Vec<BTreeSet<Atom>> = Vec::new();
        let mut rests: Vec<Polynomial> = Vec::new();
        for form in forms {
            let (monomial, rest) = self.without_units(&form.numerator)?;
            monomials.push(monomial);
            rests.push(rest);
        }
        let Some((first, others)) = rests.split_first() else {
            return Ok(None);
        };
        let mut divisor = first.clone();
        for other in others {
            if self.quotient(other, &divisor)?.is_some() {
                continue;
            }
            match common_divisor(&divisor, other, &self.algebra.budget) {
                Some(common) => divisor = self.algebra.primitive_part(&common)?.1,
                None => {
                    divisor = Polynomial::one();
                    break;
                }
            }
        }
        let shared: BTreeSet<Atom> = monomials
            .iter()
            .skip(1)
            .fold(monomials.first().cloned().unwrap_or_default(), |a, b| {
                a.intersection(b).copied().collect()
            });
        let mut common: Vec<Polynomial> = shared
            .iter()
            .map(|&atom| Polynomial::atom(atom, Exponent::ONE))
            .collect();
        let mut cofactors = Vec::new();
        for (monomial, rest) in monomials.into_iter().zip(rests) {
            let quotient = self.quotient(&rest, &divisor)?.ok_or(Obstacle::TooLarge)?;
            let (_, mut cofactor) = self.without_units(&quotient)?;
            for atom in monomial.difference(&shared) {
                cofactor = cofactor.mul(&Polynomial::atom(*atom, Exponent::ONE))?;
            }
            cofactors.push(cofactor);
        }
        let (_, divisor) = self.without_units(&divisor)?;
        if divisor.len() > 1 {
            common.push(divisor);
        }
        Ok(Some((common, cofactors)))
    }

    /// The atoms that all terms have in common, and the polynomial without them and without
    /// what has no zeros.
    fn without_units(
        &mut self,
        polynomial: &Polynomial,
    ) -> Result<(BTreeSet<Atom>, Polynomial), Obstacle> {
        let mut rest = self.algebra.primitive_part(polynomial)?;
        let mut atoms: BTreeSet<Atom> = rest.0.monomial.iter().map(|power| power.atom).collect();
        atoms.retain(|atom| !self.units.contains(atom));
        for unit in &self.unit_polynomials {
            while rest.1.len() > 1
                && let Some(quotient) = rest.1.divide(unit, &self.algebra.budget)
            {
                rest.1 = quotient;
            }
        }
        if rest.1.as_term().is_some() {
            rest.1 = Polynomial::one();
        }
        Ok((atoms, rest.1))
    }

    /// `polynomial`/`divisor`, up to a unit: roots that have no zeros are multiplied with, so
    /// that √s·(a + b√s) = bs + a√s is found to be a multiple of a + b√s.
    fn quotient(
        &mut self,
        polynomial: &Polynomial,
        divisor: &Polynomial,
    ) -> Result<Option<Polynomial>, Obstacle> {
        if divisor.is_one() {
            return Ok(Some(polynomial.clone()));
        }
        if let Some(quotient) = polynomial.divide(divisor, &self.algebra.budget) {
            return Ok(Some(quotient));
        }
        for atom in self.roots.clone() {
            if !self.units.contains(&atom) {
                continue;
            }
            let half = Exponent::from_number(&Number::Small(1, 2))?;
            let root = Polynomial::atom(atom, half);
            let product = self.algebra.reduce(polynomial.mul(&root)?)?;
            if product.denominator.is_empty()
                && let Some(quotient) = product.numerator.divide(divisor, &self.algebra.budget)
            {
                return Ok(Some(quotient));
            }
        }
        Ok(None)
    }
}
