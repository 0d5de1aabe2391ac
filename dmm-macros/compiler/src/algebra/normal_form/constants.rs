//! Relations between constants, for the zero test: quotients over roots of rational numbers are
//! rationalised, and a square root is written by an earlier one where their product is simpler.
//! (Nested roots are in `nested`.)
//!
//! | constant | becomes |
//! |---|---|
//! | 1/(A + B√c) | (A − B√c)/(A² − B²c) |
//! | √b, where √(ab) is simple | √(ab)·√a/a |

use num_integer::Integer;

use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::monomial::{self, Atom, Exponent, Power};
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};
use crate::algebra::Function;

type Result<T> = std::result::Result<T, Obstacle>;

/// Sums of roots of unity are inverted up to this order.
const LARGEST_ORDER: i64 = 31;

impl Algebra {
    /// Whether nothing varies in `fraction`; never said where constants are left as they are.
    pub(super) fn is_constant(&self, fraction: &Fraction) -> bool {
        let is_constant = |sum: &Polynomial| {
            let mut powers = sum.terms().iter().flat_map(|term| &term.monomial);
            powers.all(|power| match self.kind(power.atom) {
                Some(Kind::Pi) => true,
                Some(
                    Kind::Exp(of)
                    | Kind::Phase(of)
                    | Kind::Root(of)
                    | Kind::Call(_, of)
                    | Kind::Opaque(of),
                ) => self.is_constant(of),
                Some(Kind::Variable(_)) | None => false,
            })
        };
        let mut factors = fraction.denominator.iter();
        self.decides
            && is_constant(&fraction.numerator)
            && factors.all(|&(index, _)| self.factor(index).is_some_and(is_constant))
    }

    /// 1/`sum` of a sum of powers of exp(iπ/q): the product of its other conjugates, over all
    /// roots of unity of the same order, by its norm.
    fn inverse_on_circle(&mut self, sum: &Polynomial) -> Result<Option<Fraction>> {
        let Some(atom) = self.half_turn else {
            return Ok(None);
        };
        let mut order = 1;
        for term in sum.terms() {
            let exponent = match term.monomial.as_slice() {
                [] => continue,
                [power] if power.atom == atom => power.exponent,
                _ => return Ok(None),
            };
            match exponent.to_number() {
                Number::Small(_, d) if order == 1 || d == order => order = d,
                Number::Small(_, 1) => {}
                _ => return Ok(None),
            }
        }
        if odd_prime_of(order).is_none() || order > LARGEST_ORDER {
            return Ok(None);
        }
        let mut conjugates = Fraction::one();
        for j in (3..2 * order).step_by(2).filter(|j| j.gcd(&order) == 1) {
            let j = Exponent::from_number(&Number::integer(j))?;
            let mut terms = Vec::with_capacity(sum.len());
            for term in sum.terms() {
                terms.push(Term {
                    monomial: monomial::power(&term.monomial, j)?,
                    coefficient: term.coefficient.clone(),
                });
            }
            let conjugate = self.on_circle(Polynomial::collect(terms))?;
            conjugates = self.mul(&conjugates, &conjugate.into())?;
        }
        let norm = self.mul(&conjugates, &sum.clone().into())?;
        let inverse = match norm.numerator.as_constant() {
            Some(number) if norm.denominator.is_empty() => number.recip(),
            _ => None,
        };
        Ok(inverse.map(|inverse| conjugates.scaled(&inverse)))
    }

    /// Whether `fraction` is made of rational numbers by real roots.
    pub(super) fn is_algebraic(&self, fraction: &Fraction) -> bool {
        fraction.denominator.is_empty() && self.is_sum_of_roots(&fraction.numerator)
    }

    fn is_sum_of_roots(&self, sum: &Polynomial) -> bool {
        sum.terms().iter().all(|term| {
            term.coefficient.is_real() && term.monomial.iter().all(|p| self.is_root(p.atom))
        })
    }

    fn is_root(&self, atom: Atom) -> bool {
        match self.kind(atom) {
            Some(Kind::Root(base)) => self.is_algebraic(base),
            _ => false,
        }
    }

    /// The latest root in a sum, and its parts Aⱼ: the sum is Σ Aⱼ R^(j/d). Only for the degrees
    /// d = 2 and 3.
    pub(super) fn by_latest_root(&self, sum: &Polynomial) -> Option<(Atom, Vec<Fraction>)> {
        let powers = sum.terms().iter().flat_map(|term| &term.monomial);
        let atom = powers.map(|power| power.atom).max()?;
        let exponents = sum
            .terms()
            .iter()
            .map(|t| monomial::exponent_of(&t.monomial, atom));
        let mut degree = 1;
        for exponent in exponents.clone() {
            match exponent.to_number() {
                Number::Small(_, 1) => {}
                Number::Small(_, d @ (2 | 3)) if degree == 1 || degree == d => degree = d,
                _ => return None,
            }
        }
        if degree == 1 {
            return None;
        }
        let mut parts = vec![Vec::new(); usize::try_from(degree).ok()?];
        for (term, exponent) in sum.terms().iter().zip(exponents) {
            let place = match exponent.to_number() {
                Number::Small(n, d) => usize::try_from(n * (degree / d)).ok()?,
                Number::Big(_) => return None,
            };
            let mut term = term.clone();
            term.monomial.retain(|power| power.atom != atom);
            parts.get_mut(place)?.push(term);
        }
        let parts = parts
            .into_iter()
            .map(|terms| Polynomial::collect(terms).into());
        Some((atom, parts.collect()))
    }

    /// 1/`sum` of a sum of roots, without a denominator; nothing where that is not found.
    pub(super) fn inverse_of_roots(&mut self, sum: &Polynomial) -> Result<Option<Fraction>> {
        if !self.decides || sum.len() < 2 {
            return Ok(None);
        }
        if !self.is_sum_of_roots(sum) {
            return self.inverse_on_circle(sum);
        }
        let Some((atom, parts)) = self.by_latest_root(sum) else {
            return Ok(None);
        };
        let Some(Kind::Root(base)) = self.kind(atom).cloned() else {
            return Ok(None);
        };
        let root = |n, d| -> Result<Fraction> {
            Ok(Polynomial::atom(atom, Exponent::from_number(&Number::Small(n, d))?).into())
        };
        // sum·conjugate = norm, which lacks the root
        let (conjugate, norm) = match parts.as_slice() {
            [a, b] => {
                let rooted = self.mul(b, &root(1, 2)?)?;
                let conjugate = self.sub(a, &rooted)?;
                let square = self.mul(a, a)?;
                let other = self.mul(b, b)?;
                let other = self.mul(&other, &base)?;
                (conjugate, self.sub(&square, &other)?)
            }
            [a, b, c] => {
                let [aa, bb, cc] = [self.mul(a, a)?, self.mul(b, b)?, self.mul(c, c)?];
                let [ab, bc, ac] = [self.mul(a, b)?, self.mul(b, c)?, self.mul(a, c)?];
                let first = {
                    let bc = self.mul(&bc, &base)?;
                    self.sub(&aa, &bc)?
                };
                let second = {
                    let cc = self.mul(&cc, &base)?;
                    self.sub(&cc, &ab)?
                };
                let third = self.sub(&bb, &ac)?;
                let with_second = self.mul(&second, &root(1, 3)?)?;
                let with_third = self.mul(&third, &root(2, 3)?)?;
                let conjugate = self.add(&first, &with_second)?;
                let conjugate = self.add(&conjugate, &with_third)?;
                // a·first + base·(c·second + b·third)
                let [along_a, along_c, along_b] = [
                    self.mul(a, &first)?,
                    self.mul(c, &second)?,
                    self.mul(b, &third)?,
                ];
                let rest = self.add(&along_b, &along_c)?;
                let rest = self.mul(&rest, &base)?;
                (conjugate, self.add(&along_a, &rest)?)
            }
            _ => return Ok(None),
        };
        if norm.is_zero() || !self.is_algebraic(&norm) {
            return Ok(None);
        }
        let inverse = self.inverse(&norm)?;
        let inverse = self.mul(&conjugate, &inverse)?;
        Ok(self.is_algebraic(&inverse).then_some(inverse))
    }

    /// √`base` by the root of an earlier constant, where the product of both is simple.
    pub(super) fn by_earlier_root(&mut self, base: &Fraction) -> Result<Option<Fraction>> {
        if !self.decides || self.depth > 0 || base.as_number().is_some() || !self.is_algebraic(base)
        {
            return Ok(None);
        }
        let half = Exponent::from_number(&Number::Small(1, 2))?;
        let mut atom: Atom = 0;
        while let Some(kind) = self.kind(atom).cloned() {
            if let Kind::Root(earlier) = kind
                && earlier.as_number().is_none()
                && self.is_algebraic(&earlier)
                && earlier != *base
            {
                let product = self.mul(&earlier, base)?;
                if let Some(root) = self.denested(&product, 0)? {
                    let own: Fraction = Polynomial::atom(atom, half).into();
                    let above = self.mul(&root, &own)?;
                    return self.div(&above, &earlier).map(Some);
                }
            }
            atom += 1;
        }
        Ok(None)
    }

    /// ln `u` of a constant made of roots by that of an earlier one, if uⁿ bᵐ is rational.
    pub(super) fn ln_by_earlier(&mut self, u: &Fraction) -> Result<Option<Fraction>> {
        const POWERS: [(i64, i64); 8] = [
            (1, 1),
            (1, -1),
            (2, 1),
            (2, -1),
            (1, 2),
            (1, -2),
            (3, 1),
            (3, -1),
        ];
        if !self.decides || u.as_number().is_some() || !self.is_algebraic(u) {
            return Ok(None);
        }
        let mut atom: Atom = 0;
        while let Some(kind) = self.kind(atom).cloned() {
            if let Kind::Call(Function::Ln, earlier) = kind
                && earlier.as_number().is_none()
                && self.is_algebraic(&earlier)
                && earlier != *u
            {
                for (n, m) in POWERS {
                    let own = self.integer_power(u, n)?;
                    let other = self.integer_power(&earlier, m)?;
                    let product = self.mul(&own, &other)?;
                    if product
                        .as_number()
                        .is_some_and(|number| !number.is_negative())
                    {
                        let logarithm = self.ln(&product)?;
                        let other = Fraction::atom(atom);
                        let other = other.scaled(&Coefficient::real(Number::integer(m)));
                        let scale = Coefficient::real(Number::Small(1, n));
                        return Ok(Some(self.sub(&logarithm, &other)?.scaled(&scale)));
                    }
                }
            }
            atom += 1;
        }
        Ok(None)
    }

    /// A sum with exp(iπ n/3) and exp(iπ n/5) in it replaced by roots; nothing if there are none.
    pub(super) fn simple_turns(&mut self, sum: &Polynomial) -> Result<Option<Fraction>> {
        let Some(atom) = self.half_turn.filter(|_| self.decides) else {
            return Ok(None);
        };
        let turn = |term: &Term| monomial::exponent_of(&term.monomial, atom).to_number();
        let is_simple = |term: &Term| matches!(turn(term), Number::Small(_, 3 | 5));
        if !sum.terms().iter().any(is_simple) {
            return Ok(None);
        }
        let mut total = Fraction::zero();
        for term in sum.terms() {
            let mut part = term.clone();
            let mut factor = Fraction::one();
            if is_simple(term) {
                factor = self.root_of_unity(&turn(term))?;
                part.monomial.retain(|power| power.atom != atom);
            }
            let part = self.mul(&Polynomial::from(part).into(), &factor)?;
            total = self.add(&total, &part)?;
        }
        Ok(Some(total))
    }

    /// A sum with the powers of exp(iπ) in it as powers below 1, of a denominator that is a
    /// power of an odd prime p without those from (p − 1)/p: Σ (−1)ᵐ exp(iπ m/p) = 0 over m < p.
    pub(super) fn on_circle(&self, sum: Polynomial) -> Result<Polynomial> {
        let Some(atom) = self.half_turn.filter(|_| self.decides) else {
            return Ok(sum);
        };
        let mut rest = sum.into_terms();
        let mut done = Vec::new();
        while let Some(mut term) = rest.pop() {
            self.spend(1)?;
            let exponent = monomial::exponent_of(&term.monomial, atom);
            let whole = exponent.floor();
            if whole != 0 {
                let turn = [Power {
                    atom,
                    exponent: Exponent::integer(whole),
                }];
                term.monomial = monomial::product(&term.monomial, &monomial::inverse(&turn)?)?;
                if whole % 2 != 0 {
                    term.coefficient = term.coefficient.neg();
                }
            }
            let exponent = exponent.sub(Exponent::integer(whole))?;
            let Number::Small(n, d) = exponent.to_number() else {
                return Err(Obstacle::TooLarge);
            };
            match odd_prime_of(d) {
                Some(prime) if n * prime / d == prime - 1 => {
                    // exp(iπ (p − 1)/p) = −Σ (−1)ᵐ exp(iπ m/p) over m < p − 1
                    for m in 0..prime - 1 {
                        let turn = Exponent::from_number(&Number::Small(m - prime + 1, prime))?;
                        let turn = [Power {
                            atom,
                            exponent: turn,
                        }];
                        let sign = if m % 2 == 0 { -1 } else { 1 };
                        rest.push(Term {
                            monomial: monomial::product(&term.monomial, &turn)?,
                            coefficient: term
                                .coefficient
                                .mul(&Coefficient::real(Number::integer(sign))),
                        });
                    }
                }
                _ => done.push(term),
            }
        }
        Ok(Polynomial::collect(done))
    }
}

/// p, if `d` is a power of an odd prime p that is small.
pub(super) fn odd_prime_of(d: i64) -> Option<i64> {
    const LARGEST: i64 = 31;
    let prime = (3..=LARGEST.min(d)).step_by(2).find(|p| d % p == 0)?;
    let mut rest = d;
    while rest % prime == 0 {
        rest /= prime;
    }
    (rest == 1).then_some(prime)
}
