//! The field operations on fractions: sums, products, integer powers and inverses.

use super::Obstacle;
use super::algebra::Algebra;
use super::denominator::{Factors, merge_factors, missing_factors};
use super::fraction::Fraction;
use super::monomial::{self, Exponent};
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};

/// Integer powers above this size are not expanded.
const LARGEST_POWER: i64 = 1024;

impl Algebra {
    pub(super) fn add(&mut self, a: &Fraction, b: &Fraction) -> Result<Fraction, Obstacle> {
        if a.is_zero() {
            return Ok(b.clone());
        }
        if b.is_zero() {
            return Ok(a.clone());
        }
        self.spend(a.numerator.work() + b.numerator.work())?;
        if a.denominator == b.denominator {
            let numerator = a.numerator.add(&b.numerator)?;
            return Ok(self.fraction(numerator, a.denominator.clone()));
        }
        let common = merge_factors(&a.denominator, &b.denominator, |m, n| Some(m.max(n)))?;
        let [a, b] = [a, b].map(|term| {
            let missing = missing_factors(&common, &term.denominator);
            let extension = self.expand(&missing)?;
            let numerator = Fraction::from(term.numerator.clone());
            self.mul(&numerator, &extension)
        });
        // the extensions are polynomials up to the bases of roots
        let (a, b) = (a?, b?);
        if a.denominator == b.denominator {
            let numerator = a.numerator.add(&b.numerator)?;
            let denominator = merge_factors(&common, &a.denominator, u32::checked_add)?;
            return Ok(self.fraction(numerator, denominator));
        }
        let sum = self.add(&a, &b)?;
        let denominator = merge_factors(&common, &sum.denominator, u32::checked_add)?;
        Ok(self.fraction(sum.numerator, denominator))
    }

    fn fraction(&self, numerator: Polynomial, denominator: Factors) -> Fraction {
        if numerator.is_zero() {
            return Fraction::zero();
        }
        Fraction {
            numerator,
            denominator,
        }
    }

    pub(super) fn sub(&mut self, a: &Fraction, b: &Fraction) -> Result<Fraction, Obstacle> {
        self.add(a, &b.neg())
    }

    /// Π factorᵐ as a fraction (of which the denominator comes from roots alone).
    pub(super) fn expand(&mut self, factors: &[(usize, u32)]) -> Result<Fraction, Obstacle> {
        let mut product = Fraction::one();
        for &(index, multiplicity) in factors {
            let factor = self.factor(index).cloned().ok_or(Obstacle::Undefined)?;
            for _ in 0..multiplicity {
                product = self.mul(&product, &Fraction::from(factor.clone()))?;
            }
        }
        Ok(product)
    }

    pub(super) fn mul(&mut self, a: &Fraction, b: &Fraction) -> Result<Fraction, Obstacle> {
        if a.is_zero() || b.is_zero() {
            return Ok(Fraction::zero());
        }
        let (mut above_a, mut above_b) = (a.numerator.clone(), b.numerator.clone());
        let mut below_a = a.denominator.clone();
        let mut below_b = b.denominator.clone();
        self.cancel_small(&mut above_a, &mut below_b);
        self.cancel_small(&mut above_b, &mut below_a);
        let denominator = merge_factors(&below_a, &below_b, u32::checked_add)?;
        self.spend(above_a.work_of_product(&above_b))?;
        let numerator = above_a.mul(&above_b)?;
        let reduced = self.reduce(numerator)?;
        let denominator = merge_factors(&denominator, &reduced.denominator, u32::checked_add)?;
        Ok(self.fraction(reduced.numerator, denominator))
    }

    /// aⁿ
    pub(super) fn integer_power(&mut self, a: &Fraction, n: i64) -> Result<Fraction, Obstacle> {
        if n < 0 {
            let inverse = self.inverse(a)?;
            return self.integer_power(&inverse, n.checked_neg().ok_or(Obstacle::TooLarge)?);
        }
        if a.denominator.is_empty()
            && let Some(term) = a.numerator.as_term()
            && term.coefficient.is_one()
        {
            let exponent = Exponent::from_number(&Number::integer(n))?;
            let monomial = monomial::power(&term.monomial, exponent)?;
            return self.reduce(Polynomial::from(Term {
                monomial,
                coefficient: Coefficient::ONE,
            }));
        }
        if n > LARGEST_POWER {
            return Err(Obstacle::TooLarge);
        }
        let mut result = Fraction::one();
        let mut square = a.clone();
        let mut rest = n;
        while rest > 0 {
            if rest % 2 == 1 {
                result = self.mul(&result, &square)?;
            }
            rest /= 2;
            if rest > 0 {
                square = self.mul(&square, &square)?;
            }
        }
        Ok(result)
    }

    /// A polynomial as a term times factors, or times one over a sum of roots.
    fn factorise_roots(
        &mut self,
        polynomial: &Polynomial,
    ) -> Result<(Term, Factors, Option<Fraction>), Obstacle> {
        if self.decides && polynomial.len() > 1 {
            let (unit, primitive) = self.primitive_part(polynomial)?;
            if let Some(roots) = self.inverse_of_roots(&primitive)? {
                return Ok((unit, Factors::new(), Some(roots)));
            }
        }
        let (unit, factors) = self.factorise(polynomial)?;
        Ok((unit, factors, None))
    }

    /// 1/a
    pub(super) fn inverse(&mut self, a: &Fraction) -> Result<Fraction, Obstacle> {
        if a.is_zero() {
            return Err(Obstacle::Undefined);
        }
        let (unit, factors, roots) = self.factorise_roots(&a.numerator)?;
        let numerator = self.reduce(Polynomial::from(unit.inverse()?))?;
        let expanded = self.expand(&a.denominator)?;
        let mut numerator = self.mul(&numerator, &expanded)?;
        if let Some(roots) = roots {
            numerator = self.mul(&numerator, &roots)?;
        }
        let denominator = merge_factors(&numerator.denominator, &factors, u32::checked_add)?;
        let mut result = Fraction {
            numerator: numerator.numerator,
            denominator,
        };
        self.cancel_small(&mut result.numerator, &mut result.denominator);
        Ok(result)
    }

    pub(super) fn div(&mut self, a: &Fraction, b: &Fraction) -> Result<Fraction, Obstacle> {
        let inverse = self.inverse(b)?;
        self.mul(a, &inverse)
    }
}
