//! Factors of denominators: finding them, cancelling them, and the primitive polynomials that
//! stand for them in the table.

use super::Obstacle;
use super::algebra::Algebra;
use super::denominator::{Factors, merge_factors};
use super::fraction::Fraction;
use super::gcd::common_divisor;
use super::monomial::{self, Exponent, Power};
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};

/// A cancellation is tried along the way only up to this number of terms.
const CANCELLED_TERMS: usize = 64;

impl Algebra {
    /// The index of a primitive polynomial, which is added if it is new.
    pub(super) fn known_factor(&mut self, primitive: Polynomial) -> usize {
        match self.factors.iter().position(|factor| *factor == primitive) {
            Some(index) => index,
            None => {
                self.factors.push(primitive);
                self.factors.len() - 1
            }
        }
    }

    pub(super) fn cancel_small(&self, numerator: &mut Polynomial, denominator: &mut Factors) {
        if numerator.len() > 1 && numerator.len() <= CANCELLED_TERMS {
            self.cancel_polynomial(numerator, denominator);
        }
    }

    fn cancel_polynomial(&self, numerator: &mut Polynomial, denominator: &mut Factors) {
        for (index, multiplicity) in denominator.iter_mut() {
            let Some(factor) = self.factors.get(*index) else {
                continue;
            };
            while *multiplicity > 0 {
                match numerator.divide(factor, &self.budget) {
                    Some(quotient) => {
                        *numerator = quotient;
                        *multiplicity -= 1;
                    }
                    None => break,
                }
            }
        }
        denominator.retain(|&(_, multiplicity)| multiplicity > 0);
    }

    /// `fraction` without the factors of the denominator that divide the numerator.
    pub(super) fn cancel(&self, mut fraction: Fraction) -> Fraction {
        if fraction.is_zero() {
            return Fraction::zero();
        }
        self.cancel_polynomial(&mut fraction.numerator, &mut fraction.denominator);
        fraction
    }

    /// `fraction` in lowest terms: without what its numerator has in common with factors of the
    /// denominator, which are split for it.
    pub(super) fn lowest_terms(&mut self, fraction: Fraction) -> Result<Fraction, Obstacle> {
        let mut rest = self.cancel(fraction);
        let mut position = 0;
        while let Some(&(index, multiplicity)) = rest.denominator.get(position) {
            let factor = self.factor(index).cloned().ok_or(Obstacle::Undefined)?;
            let Some(common) = common_divisor(&rest.numerator, &factor, &self.budget) else {
                position += 1;
                continue;
            };
            // factor = common·other, both to the power `multiplicity`
            let (_, common) = self.primitive_part(&common)?;
            let other = factor
                .divide(&common, &self.budget)
                .ok_or(Obstacle::TooLarge)?;
            let (unit, other) = self.factorise(&other)?;
            let common = vec![(self.known_factor(common), multiplicity)];
            let inverse = unit.inverse()?;
            rest.denominator.remove(position);
            for _ in 0..multiplicity {
                rest.numerator = rest.numerator.times_term(&inverse)?;
                rest.denominator = merge_factors(&rest.denominator, &other, u32::checked_add)?;
            }
            rest.denominator = merge_factors(&rest.denominator, &common, u32::checked_add)?;
            rest = self.cancel(rest);
            position = 0;
        }
        Ok(rest)
    }

    /// A polynomial as a term times powers of factors of the table, which grows by what is new.
    pub(super) fn factorise(
        &mut self,
        polynomial: &Polynomial,
    ) -> Result<(Term, Factors), Obstacle> {
        let mut rest = polynomial.clone();
        let mut factors = Vec::new();
        for (index, factor) in self.factors.iter().enumerate() {
            let mut multiplicity = 0;
            while rest.len() > 1 {
                match rest.divide(factor, &self.budget) {
                    Some(quotient) => {
                        rest = quotient;
                        multiplicity += 1;
                    }
                    None => break,
                }
            }
            if multiplicity > 0 {
                factors.push((index, multiplicity));
            }
        }
        if let Some(term) = rest.as_term() {
            return Ok((term.clone(), factors));
        }
        let (unit, primitive) = self.primitive_part(&rest)?;
        let index = self.known_factor(primitive);
        // a known factor would have been divided out
        match factors.iter_mut().find(|(known, _)| *known == index) {
            Some((_, multiplicity)) => *multiplicity += 1,
            None => factors.push((index, 1)),
        }
        Ok((unit, factors))
    }

    /// `polynomial` = term · primitive: exponents from 0 upwards (phases centred on 0, and real
    /// where a unit makes it so), integer coefficients without a common factor, the first one
    /// positive.
    pub(super) fn primitive_part(
        &self,
        polynomial: &Polynomial,
    ) -> Result<(Term, Polynomial), Obstacle> {
        self.spend(polynomial.work())?;
        let mut monomial = Vec::new();
        for (atom, least, greatest) in polynomial.exponent_ranges() {
            let exponent = if self.is_phase(atom) {
                let half = Exponent::from_number(&Number::Small(1, 2))?;
                least.add(greatest)?.mul(half)?
            } else {
                least
            };
            if !exponent.is_zero() {
                monomial.push(Power { atom, exponent });
            }
        }
        let mut unit = Coefficient::ONE;
        let mut primitive = polynomial.times_term(&Term {
            monomial: monomial::inverse(&monomial)?,
            coefficient: Coefficient::ONE,
        })?;
        if let Some(phase) = self.real_unit(&primitive)? {
            unit = phase.recip().ok_or(Obstacle::Undefined)?;
            primitive = primitive.scaled(&phase);
        }
        let mut content = primitive.content();
        if primitive.leads_negative() {
            content = content.neg();
        }
        let scale = content.recip().ok_or(Obstacle::Undefined)?;
        let primitive = primitive.scaled(&Coefficient::real(scale));
        let coefficient = unit.mul(&Coefficient::real(content));
        Ok((
            Term {
                monomial,
                coefficient,
            },
            primitive,
        ))
    }

    /// w with w·p its own conjugate, if p has a complex coefficient or phases and there is one.
    fn real_unit(&self, p: &Polynomial) -> Result<Option<Coefficient>, Obstacle> {
        if !self.has_phases(p) && p.terms().iter().all(|term| term.coefficient.is_real()) {
            return Ok(None);
        }
        let conjugate = p.conjugate(|atom| self.is_phase(atom))?;
        let (Some(first), Some(second)) = (p.terms().first(), conjugate.terms().first()) else {
            return Ok(None);
        };
        let inverse = first.coefficient.recip().ok_or(Obstacle::Undefined)?;
        let ratio = second.coefficient.mul(&inverse);
        if conjugate != p.scaled(&ratio) {
            return Ok(None);
        }
        let unit = Coefficient::ONE.add(&ratio);
        Ok(Some(if unit.is_zero() { Coefficient::I } else { unit }))
    }
}
