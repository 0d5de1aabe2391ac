//! Greatest common divisors of Laurent polynomials in the free ring, by primitive
//! pseudo-remainder sequences in one atom after the other. They serve the reading of results
//! and the cancellation of fractions; deciding zero does without.

use num_integer::Integer;
use num_traits::ToPrimitive;

use super::super::work::Budget;
use super::monomial::{self, Atom, Exponent, Power};
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};

/// Polynomials with more terms than this are left alone.
const MOST_TERMS: usize = 200;

/// A common divisor of `a` and `b` with more than one term, the greatest up to a unit; `None`
/// if there is none or it takes too long to find.
pub(super) fn common_divisor(
    a: &Polynomial,
    b: &Polynomial,
    budget: &Budget,
) -> Option<Polynomial> {
    let scale = common_denominators(a, b)?;
    let mut search = Search { budget };
    let a = stretched(&without_monomial(a)?, &scale, false)?;
    let b = stretched(&without_monomial(b)?, &scale, false)?;
    let divisor = search.gcd(&a, &b)?;
    if divisor.len() < 2 {
        return None;
    }
    stretched(&divisor, &scale, true)
}

/// `None` if it is too large.
fn least_common_multiple(a: i64, b: i64) -> Option<i64> {
    (a / a.gcd(&b)).checked_mul(b)
}

/// The least common denominator of the exponents of every atom.
fn common_denominators(a: &Polynomial, b: &Polynomial) -> Option<Vec<(Atom, i64)>> {
    let mut scale: Vec<(Atom, i64)> = Vec::new();
    for term in a.terms().iter().chain(b.terms()) {
        for power in &term.monomial {
            let denominator = match power.exponent.to_number() {
                Number::Small(_, denominator) => denominator,
                Number::Big(_) => return None,
            };
            match scale.iter_mut().find(|(atom, _)| *atom == power.atom) {
                Some((_, known)) => *known = least_common_multiple(*known, denominator)?,
                None => scale.push((power.atom, denominator)),
            }
        }
    }
    Some(scale)
}

/// `polynomial` with each exponent multiplied (or divided) by the scale of its atom.
fn stretched(polynomial: &Polynomial, scale: &[(Atom, i64)], divide: bool) -> Option<Polynomial> {
    let mut terms = Vec::with_capacity(polynomial.len());
    for term in polynomial.terms() {
        let mut term = term.clone();
        for power in &mut term.monomial {
            let factor = scale.iter().find(|(atom, _)| *atom == power.atom)?.1;
            let factor = if divide {
                Number::Small(1, factor)
            } else {
                Number::integer(factor)
            };
            let factor = Exponent::from_number(&factor).ok()?;
            power.exponent = power.exponent.mul(factor).ok()?;
        }
        terms.push(term);
    }
    Some(Polynomial::collect(terms))
}

/// `polynomial` over its monomial content: exponents from 0 upwards.
fn without_monomial(polynomial: &Polynomial) -> Option<Polynomial> {
    let powers: Vec<Power> = polynomial
        .exponent_ranges()
        .into_iter()
        .filter(|(_, least, _)| !least.is_zero())
        .map(|(atom, exponent, _)| Power { atom, exponent })
        .collect();
    polynomial
        .times_term(&Term {
            monomial: monomial::inverse(&powers).ok()?,
            coefficient: Coefficient::ONE,
        })
        .ok()
}

/// A polynomial in one atom: its coefficients from the constant one upwards.
type Univariate = Vec<Polynomial>;

struct Search<'a> {
    budget: &'a Budget,
}

impl Search<'_> {
    fn mul(&mut self, a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
        let small = a.len() <= MOST_TERMS && b.len() <= MOST_TERMS;
        (small && self.budget.spend(a.work_of_product(b)))
            .then(|| a.mul(b).ok())
            .flatten()
    }

    fn monic(&self, polynomial: &Polynomial) -> Option<Polynomial> {
        let leading = polynomial.terms().first()?;
        let inverse = leading.coefficient.recip()?;
        let work = polynomial.work() + polynomial.len().saturating_mul(inverse.work());
        self.budget.spend(work).then(|| polynomial.scaled(&inverse))
    }

    /// The greatest common divisor of polynomials with natural exponents.
    fn gcd(&mut self, a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
        if a.is_zero() {
            return self.monic(b);
        }
        if b.is_zero() {
            return self.monic(a);
        }
        let (in_a, in_b) = (a.exponent_ranges(), b.exponent_ranges());
        let Some(&(atom, _, _)) = in_a.first() else {
            return Some(Polynomial::one());
        };
        if in_b.is_empty() {
            return Some(Polynomial::one());
        }
        // an atom of one of them alone occurs in no common divisor
        let foreign = in_b
            .iter()
            .find(|range| in_a.iter().all(|other| other.0 != range.0));
        if let Some(&(foreign, _, _)) = foreign {
            let content = self.content(&univariate(b, foreign)?)?;
            return self.gcd(a, &content);
        }
        if in_b.iter().all(|range| range.0 != atom) {
            let content = self.content(&univariate(a, atom)?)?;
            return self.gcd(&content, b);
        }
        let (a, b) = (univariate(a, atom)?, univariate(b, atom)?);
        let (content_a, content_b) = (self.content(&a)?, self.content(&b)?);
        let content = self.gcd(&content_a, &content_b)?;
        let primitive = self.remainders(
            over(a, &content_a, self.budget)?,
            over(b, &content_b, self.budget)?,
        )?;
        let primitive = assembled(&primitive, atom)?;
        let product = self.mul(&content, &primitive)?;
        self.monic(&product)
    }

    /// The primitive pseudo-remainder sequence.
    fn remainders(&mut self, mut a: Univariate, mut b: Univariate) -> Option<Univariate> {
        if a.len() < b.len() {
            std::mem::swap(&mut a, &mut b);
        }
        while !b.is_empty() {
            let mut rest = self.pseudo_remainder(a, &b)?;
            if !rest.is_empty() {
                let content = self.content(&rest)?;
                rest = over(rest, &content, self.budget)?;
            }
            (a, b) = (b, rest);
        }
        Some(if a.len() == 1 {
            vec![Polynomial::one()]
        } else {
            a
        })
    }

    fn pseudo_remainder(&mut self, mut a: Univariate, b: &Univariate) -> Option<Univariate> {
        let leading = b.last()?;
        while a.len() >= b.len() {
            let top = a.pop()?;
            let shift = a.len() + 1 - b.len();
            for coefficient in &mut a {
                *coefficient = self.mul(coefficient, leading)?;
            }
            for (index, coefficient) in b.iter().enumerate().take(b.len() - 1) {
                let product = self.mul(&top, coefficient)?.neg();
                let target = a.get_mut(index + shift)?;
                *target = target.add(&product).ok()?;
            }
            while a.last().is_some_and(Polynomial::is_zero) {
                a.pop();
            }
        }
        Some(a)
    }

    /// The greatest common divisor of the coefficients.
    fn content(&mut self, a: &Univariate) -> Option<Polynomial> {
        let mut content = Polynomial::zero();
        for coefficient in a {
            content = self.gcd(&content, coefficient)?;
            if content.is_one() {
                break;
            }
        }
        Some(content)
    }
}

fn over(a: Univariate, divisor: &Polynomial, budget: &Budget) -> Option<Univariate> {
    a.iter()
        .map(|coefficient| coefficient.divide(divisor, budget))
        .collect()
}

fn univariate(polynomial: &Polynomial, atom: Atom) -> Option<Univariate> {
    let mut coefficients: Vec<Vec<Term>> = Vec::new();
    for term in polynomial.terms() {
        let degree = monomial::exponent_of(&term.monomial, atom)
            .to_number()
            .as_integer()?
            .to_usize()
            .filter(|&degree| degree <= MOST_TERMS)?;
        if coefficients.len() <= degree {
            coefficients.resize(degree + 1, Vec::new());
        }
        let mut term = term.clone();
        term.monomial.retain(|power| power.atom != atom);
        coefficients.get_mut(degree)?.push(term);
    }
    Some(coefficients.into_iter().map(Polynomial::collect).collect())
}

fn assembled(coefficients: &Univariate, atom: Atom) -> Option<Polynomial> {
    let mut sum = Polynomial::zero();
    for (degree, coefficient) in coefficients.iter().enumerate() {
        let exponent = Exponent::integer(i32::try_from(degree).ok()?);
        let monomial = match degree {
            0 => Vec::new(),
            _ => vec![Power { atom, exponent }],
        };
        let power = Term {
            monomial,
            coefficient: Coefficient::ONE,
        };
        sum = sum.add(&coefficient.times_term(&power).ok()?).ok()?;
    }
    Some(sum)
}
