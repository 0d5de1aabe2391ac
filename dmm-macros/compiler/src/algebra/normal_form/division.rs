//! Exact division of Laurent polynomials, bounded by the ranges of their exponents.

use std::cmp::Ordering;

use super::super::work::Budget;
use super::monomial::{self, Atom, Exponent, Power};
use super::polynomial::{Polynomial, Term, merge};

impl Polynomial {
    /// The smallest and largest exponent of every atom, in rising order of the atoms.
    pub(super) fn exponent_ranges(&self) -> Vec<(Atom, Exponent, Exponent)> {
        let mut ranges: Vec<(Atom, Exponent, Exponent, usize)> = Vec::new();
        for term in self.terms() {
            for power in &term.monomial {
                let Power { atom, exponent } = *power;
                match ranges.binary_search_by_key(&atom, |range| range.0) {
                    Ok(index) => {
                        if let Some((_, least, greatest, count)) = ranges.get_mut(index) {
                            *least = least.min(exponent);
                            *greatest = greatest.max(exponent);
                            *count += 1;
                        }
                    }
                    Err(index) => ranges.insert(index, (atom, exponent, exponent, 1)),
                }
            }
        }
        ranges
            .into_iter()
            .map(|(atom, least, greatest, count)| {
                if count == self.len() {
                    (atom, least, greatest)
                } else {
                    (
                        atom,
                        least.min(Exponent::ZERO),
                        greatest.max(Exponent::ZERO),
                    )
                }
            })
            .collect()
    }

    /// self/divisor, if that is a Laurent polynomial and the budget is enough.
    ///
    /// The exponents of a product range over the sum of the factors' ranges, which bounds the
    /// quotient's exponents: most divisions that fail do so before the first step, and every
    /// one ends.
    pub(super) fn divide(&self, divisor: &Self, budget: &Budget) -> Option<Self> {
        let leading = divisor.terms().first()?;
        if divisor.len() > 1 && !self.is_zero() && !self.has_what_varies(divisor) {
            return None;
        }
        let inverse = leading.inverse().ok()?;
        if divisor.len() == 1 {
            return self.times_term(&inverse).ok();
        }
        if self.is_zero() {
            return Some(Self::zero());
        }
        let bounds = self.quotient_bounds(divisor)?;
        let mut quotient: Vec<Term> = Vec::new();
        let mut rest = self.terms().to_vec();
        while let Some(first) = rest.first() {
            let term = first.mul(&inverse).ok()?;
            let work = divisor.work_of_product_with(&term) + rest.len() / 4;
            if !within(&term.monomial, &bounds) || !budget.spend(work) {
                return None;
            }
            let negated = Term {
                monomial: term.monomial.clone(),
                coefficient: term.coefficient.neg(),
            };
            rest = merge(rest, divisor.times_term(&negated).ok()?.into_terms());
            quotient.push(term);
        }
        Some(Self::from_sorted(quotient))
    }

    /// Whether the atoms whose exponents differ between the first and the last term of `divisor`
    /// occur here, as they do in every multiple. Most factors of a table are found out by it,
    /// without looking at all of their terms.
    fn has_what_varies(&self, divisor: &Self) -> bool {
        let (Some(first), Some(last)) = (divisor.terms().first(), divisor.terms().last()) else {
            return true;
        };
        let varying = |one: &Term, other: &Term| {
            one.monomial.iter().all(|power| {
                monomial::exponent_of(&other.monomial, power.atom) == power.exponent
                    || self.has_atom(power.atom)
            })
        };
        varying(first, last) && varying(last, first)
    }

    fn has_atom(&self, atom: Atom) -> bool {
        let mut terms = self.terms().iter();
        terms.any(|term| term.monomial.iter().any(|power| power.atom == atom))
    }

    fn quotient_bounds(&self, divisor: &Self) -> Option<Vec<(Atom, Exponent, Exponent)>> {
        let own = self.exponent_ranges();
        let mut bounds = Vec::with_capacity(own.len());
        let of_divisor = divisor.exponent_ranges();
        for (atom, least, greatest) in &of_divisor {
            if least != greatest && own.binary_search_by_key(atom, |range| range.0).is_err() {
                return None;
            }
        }
        for (atom, least, greatest) in own {
            let (low, high) = match of_divisor.binary_search_by_key(&atom, |range| range.0) {
                Ok(index) => of_divisor
                    .get(index)
                    .map(|&(_, low, high)| (low, high))
                    .unwrap_or((Exponent::ZERO, Exponent::ZERO)),
                Err(_) => (Exponent::ZERO, Exponent::ZERO),
            };
            let (least, greatest) = (least.sub(low).ok()?, greatest.sub(high).ok()?);
            if least.compare(greatest) == Ordering::Greater {
                return None;
            }
            bounds.push((atom, least, greatest));
        }
        for (atom, low, _) in of_divisor {
            if let Err(index) = bounds.binary_search_by_key(&atom, |range| range.0) {
                let exponent = low.neg().ok()?;
                bounds.insert(index, (atom, exponent, exponent));
            }
        }
        Some(bounds)
    }
}

fn within(monomial: &[Power], bounds: &[(Atom, Exponent, Exponent)]) -> bool {
    monomial.iter().all(|power| {
        bounds
            .binary_search_by_key(&power.atom, |bound| bound.0)
            .is_ok()
    }) && bounds.iter().all(|&(atom, least, greatest)| {
        let exponent = monomial::exponent_of(monomial, atom);
        exponent.compare(least).is_ge() && exponent.compare(greatest).is_le()
    })
}
