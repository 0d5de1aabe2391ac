//! Fractions of Laurent polynomials with factored denominators: the elements of the
//! [`Algebra`](super::algebra::Algebra), which alone can add and multiply them.

use super::denominator::Factors;
use super::monomial::{Atom, Exponent};
use super::number::{Coefficient, Number};
use super::polynomial::Polynomial;

/// numerator / Π factorᵐ, the factors by their index in the table and rising.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Fraction {
    pub(super) numerator: Polynomial,
    pub(super) denominator: Factors,
}

impl Fraction {
    pub(super) fn zero() -> Self {
        Self::default()
    }

    pub(super) fn one() -> Self {
        Self::from(Polynomial::one())
    }

    pub(super) fn number(value: Number) -> Self {
        Self::from(Polynomial::constant(Coefficient::real(value)))
    }

    pub(super) fn atom(atom: Atom) -> Self {
        Self::from(Polynomial::atom(atom, Exponent::ONE))
    }

    pub(super) fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }

    pub(super) fn neg(&self) -> Self {
        Self {
            numerator: self.numerator.neg(),
            denominator: self.denominator.clone(),
        }
    }

    pub(super) fn scaled(&self, factor: &Coefficient) -> Self {
        Self {
            numerator: self.numerator.scaled(factor),
            denominator: self.denominator.clone(),
        }
    }

    /// The value, if it is a rational number.
    pub(super) fn as_number(&self) -> Option<Number> {
        if self.is_zero() {
            return Some(Number::ZERO);
        }
        let constant = self.numerator.as_constant()?;
        (constant.is_real() && self.denominator.is_empty()).then(|| constant.re.clone())
    }

    /// Whether the leading coefficient of the numerator is negative.
    pub(super) fn leads_negative(&self) -> bool {
        self.numerator.leads_negative()
    }
}

impl From<Polynomial> for Fraction {
    fn from(numerator: Polynomial) -> Self {
        Self {
            numerator,
            denominator: Vec::new(),
        }
    }
}
