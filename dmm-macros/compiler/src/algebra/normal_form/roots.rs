//! Roots: with R = p/d the *base* of a root atom, powers Rᵉ have 0 ≤ e < 1, and R¹ is replaced
//! by p/d.

use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::monomial::{self, Atom, Exponent, Power};
use super::polynomial::{Polynomial, Term};

/// Reductions of roots nested deeper than this are given up.
const DEEPEST_REDUCTION: usize = 24;

impl Algebra {
    /// Replaces the integer parts of roots' exponents by their bases.
    pub(super) fn reduce(&mut self, polynomial: Polynomial) -> Result<Fraction, Obstacle> {
        let polynomial = self.on_circle(polynomial)?;
        if let Some(simple) = self.simple_turns(&polynomial)? {
            return Ok(simple);
        }
        if !self.has_roots {
            return Ok(polynomial.into());
        }
        // the latest root first: bases contain earlier ones only
        let Some(atom) = self.reducible_root(&polynomial) else {
            return Ok(polynomial.into());
        };
        let Some(Kind::Root(base)) = self.kind(atom).cloned() else {
            return Err(Obstacle::Undefined);
        };
        if self.depth >= DEEPEST_REDUCTION {
            return Err(Obstacle::TooLarge);
        }
        self.depth += 1;
        let sum = self.replace_root(polynomial, atom, &base);
        self.depth -= 1;
        sum
    }

    fn reducible_root(&self, polynomial: &Polynomial) -> Option<Atom> {
        polynomial
            .terms()
            .iter()
            .flat_map(|term| &term.monomial)
            .filter(|power| {
                power.exponent.floor() != 0 && matches!(self.kind(power.atom), Some(Kind::Root(_)))
            })
            .map(|power| power.atom)
            .max()
    }

    fn replace_root(
        &mut self,
        polynomial: Polynomial,
        atom: Atom,
        base: &Fraction,
    ) -> Result<Fraction, Obstacle> {
        let mut groups: Vec<(i32, Vec<Term>)> = Vec::new();
        for mut term in polynomial.into_terms() {
            let whole = monomial::exponent_of(&term.monomial, atom).floor();
            if whole != 0 {
                let power = [Power {
                    atom,
                    exponent: Exponent::integer(whole),
                }];
                term.monomial = monomial::product(&term.monomial, &monomial::inverse(&power)?)?;
            }
            match groups.iter_mut().find(|(known, _)| *known == whole) {
                Some((_, terms)) => terms.push(term),
                None => groups.push((whole, vec![term])),
            }
        }
        let mut sum = Fraction::zero();
        for (whole, terms) in groups {
            let group = self.reduce(Polynomial::collect(terms))?;
            let power = self.integer_power(base, whole.into())?;
            let group = self.mul(&group, &power)?;
            sum = self.add(&sum, &group)?;
        }
        Ok(sum)
    }
}
