//! From the normal form back to expressions.
//!
//! A real polynomial with phases is its own conjugate, so that its terms pair up:
//! c·m·exp(iφ) + c̄·m·exp(−iφ) = m·(2 Re c·cos φ − 2 Im c·sin φ). The same pairing of real
//! exponentials gives cosh and sinh. Where the terms do not pair, there is no way back.

use std::collections::HashMap;

use super::super::{Dag, Function, Id};
use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::monomial::{self, Atom, Exponent, Power};
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};

/// Writes fractions of one algebra into a DAG; `None` where that is not possible.
pub(super) struct Writer<'a> {
    dag: &'a mut Dag,
    algebra: &'a mut Algebra,
    atoms: HashMap<Atom, Id>,
}

/// A monomial taken apart by what its atoms become.
struct Parts {
    /// Powers that are written one by one.
    plain: Vec<Power>,
    /// The exponents of exp atoms.
    exponential: Vec<Power>,
    /// The exponents of phases.
    phase: Vec<Power>,
}

/// number · expression
type Piece = (Number, Id);

/// The factor that the numbers have in common, with the sign of the first.
fn content(pieces: &[Piece]) -> Number {
    let mut numbers = pieces.iter().map(|(number, _)| number);
    let Some(first) = numbers.next() else {
        return Number::ONE;
    };
    let size = if first.is_negative() {
        first.neg()
    } else {
        first.clone()
    };
    let content = numbers.fold(size, |content, number| content.gcd(number));
    if first.is_negative() {
        content.neg()
    } else {
        content
    }
}

impl<'a> Writer<'a> {
    pub(super) fn new(dag: &'a mut Dag, algebra: &'a mut Algebra) -> Self {
        Self {
            dag,
            algebra,
            atoms: HashMap::new(),
        }
    }

    pub(super) fn fraction(&mut self, fraction: &Fraction) -> Option<Id> {
        let mut fraction = self.algebra.lowest_terms(fraction.clone()).ok()?;
        if self.algebra.is_complex(&fraction) {
            fraction = self.real_form(fraction)?;
        }
        let mut above = self.polynomial(&fraction.numerator)?;
        for (index, multiplicity) in fraction.denominator {
            let factor = self.factor(index)?;
            let power = self.dag.powi(factor, multiplicity.into());
            above = self.dag.div(above, power);
        }
        Some(above)
    }

    /// A factor of denominators.
    pub(super) fn factor(&mut self, index: usize) -> Option<Id> {
        let factor = self.algebra.factor(index)?.clone();
        self.polynomial(&factor)
    }

    /// The factors of the denominator of a cancelled fraction but for constants and
    /// exponentials, which have no zeros.
    pub(super) fn denominator(&mut self, fraction: &Fraction) -> Option<Vec<Id>> {
        let mut factors = Vec::new();
        for (atom, least, _) in fraction.numerator.exponent_ranges() {
            let has_zeros = !matches!(
                self.algebra.kind(atom),
                Some(Kind::Exp(_) | Kind::Phase(_) | Kind::Pi)
            );
            if least.is_negative() && has_zeros {
                factors.push(self.atom(atom)?);
            }
        }
        for &(index, _) in &fraction.denominator {
            factors.push(self.factor(index)?);
        }
        Some(factors)
    }

    fn is_real(&self, polynomial: &Polynomial) -> Option<bool> {
        let conjugate = polynomial
            .conjugate(|atom| self.algebra.is_phase(atom))
            .ok()?;
        Some(conjugate == *polynomial)
    }

    /// The fraction with a real numerator over a real denominator.
    fn real_form(&mut self, fraction: Fraction) -> Option<Fraction> {
        let mut real = self.is_real(&fraction.numerator)?;
        for &(index, _) in &fraction.denominator {
            real = real && self.is_real(&self.algebra.factor(index)?.clone())?;
        }
        if real {
            return Some(fraction);
        }
        let below = self.algebra.expand(&fraction.denominator).ok()?;
        if !below.denominator.is_empty() {
            return None;
        }
        let (unit, primitive) = self.algebra.primitive_part(&below.numerator).ok()?;
        let above = fraction.numerator.times_term(&unit.inverse().ok()?).ok()?;
        if !self.is_real(&above)? || !self.is_real(&primitive)? {
            return None;
        }
        if primitive.is_one() {
            return Some(above.into());
        }
        let index = self.algebra.known_factor(primitive);
        Some(Fraction {
            numerator: above,
            denominator: vec![(index, 1)],
        })
    }

    /// content · common monomial · sum of terms
    pub(super) fn polynomial(&mut self, polynomial: &Polynomial) -> Option<Id> {
        if polynomial.is_zero() {
            return Some(self.dag.integer(0));
        }
        let mut common = Vec::new();
        for (atom, least, greatest) in polynomial.exponent_ranges() {
            let all_equal = least == greatest;
            let takes_out = match self.algebra.kind(atom)? {
                Kind::Phase(_) => false,
                Kind::Exp(_) => all_equal,
                _ => true,
            };
            if takes_out && !least.is_zero() {
                common.push(Power {
                    atom,
                    exponent: least,
                });
            }
        }
        let unit = Term {
            monomial: common,
            coefficient: Coefficient::ONE,
        };
        let rest = polynomial.times_term(&unit.inverse().ok()?).ok()?;
        let mut pieces = Vec::new();
        let mut terms = rest.into_terms();
        while !terms.is_empty() {
            let term = terms.remove(0);
            self.with_partner(term, &mut terms, &mut pieces)?;
        }
        let content = content(&pieces);
        let scale = content.recip()?;
        let mut written = Vec::new();
        for (number, piece) in pieces {
            let factor = self.dag.constant(number.mul(&scale).to_rational());
            written.push(self.dag.mul(factor, piece));
        }
        let sum = self.dag.sum(written);
        let outer = self.parts(&unit.monomial)?;
        let product = self.product(&outer, &[sum])?;
        let factor = self.dag.constant(content.to_rational());
        Some(self.dag.mul(factor, product))
    }

    /// A term together with the later one of opposite phase or opposite exponential, as pieces
    /// number · expression.
    fn with_partner(
        &mut self,
        term: Term,
        later: &mut Vec<Term>,
        pieces: &mut Vec<Piece>,
    ) -> Option<()> {
        let mut parts = self.parts(&term.monomial)?;
        if !parts.phase.is_empty() || !parts.exponential.is_empty() {
            self.algebra.spend(later.len()).ok()?;
        }
        let two = Number::integer(2);
        if !parts.phase.is_empty() {
            let partner = self.take_partner(&term, &parts.phase, later)?;
            if partner.coefficient != term.coefficient.conjugate() {
                return None;
            }
            let argument = self.argument(&parts.phase)?;
            for (function, number) in [
                (Function::Cos, term.coefficient.re.clone()),
                (Function::Sin, term.coefficient.im.neg()),
            ] {
                if !number.is_zero() {
                    let value = self.odd_or_even(function, argument);
                    pieces.push((two.mul(&number), self.product(&parts, &[value])?));
                }
            }
            return Some(());
        }
        if !term.coefficient.is_real() {
            return None;
        }
        if let Some(same) = self.take_exponential(&term, &parts.exponential, later) {
            let function = if same { Function::Cosh } else { Function::Sinh };
            let argument = self.argument(&parts.exponential)?;
            let value = self.odd_or_even(function, argument);
            parts.exponential.clear();
            let piece = self.product(&parts, &[value])?;
            pieces.push((two.mul(&term.coefficient.re), piece));
            return Some(());
        }
        pieces.push((term.coefficient.re, self.product(&parts, &[])?));
        Some(())
    }

    /// Takes the term of the inverse exponential if it has the same coefficient (`true`) or
    /// the opposite one.
    fn take_exponential(
        &self,
        term: &Term,
        powers: &[Power],
        later: &mut Vec<Term>,
    ) -> Option<bool> {
        if powers.is_empty() {
            return None;
        }
        let mut rest = later.clone();
        let partner = self.take_partner(term, powers, &mut rest)?;
        let same = partner.coefficient == term.coefficient;
        if !same && partner.coefficient != term.coefficient.neg() {
            return None;
        }
        *later = rest;
        Some(same)
    }

    /// The term whose `powers` are inverse to those of `term`.
    fn take_partner(&self, term: &Term, powers: &[Power], later: &mut Vec<Term>) -> Option<Term> {
        let square = monomial::power(powers, Exponent::integer(-2)).ok()?;
        let monomial = monomial::product(&term.monomial, &square).ok()?;
        let position = later.iter().position(|other| other.monomial == monomial)?;
        Some(later.remove(position))
    }

    /// `function(argument)` with a minus sign of the argument taken out.
    fn odd_or_even(&mut self, function: Function, argument: Id) -> Id {
        let opposite = self.dag.neg(argument);
        if !matches!(self.dag[argument], super::super::Math::Neg(_)) {
            return self.dag.call(function, argument);
        }
        let value = self.dag.call(function, opposite);
        match function {
            Function::Sin | Function::Sinh => self.dag.neg(value),
            _ => value,
        }
    }

    fn parts(&self, monomial: &[Power]) -> Option<Parts> {
        let mut parts = Parts {
            plain: Vec::new(),
            exponential: Vec::new(),
            phase: Vec::new(),
        };
        for &power in monomial {
            match self.algebra.kind(power.atom)? {
                Kind::Exp(_) => parts.exponential.push(power),
                Kind::Phase(_) => parts.phase.push(power),
                _ => parts.plain.push(power),
            }
        }
        // variables by their names, then everything else in the order of the table
        parts
            .plain
            .sort_by_key(|power| match self.algebra.kind(power.atom) {
                Some(Kind::Variable(name)) => (false, Some(name.clone())),
                _ => (true, None),
            });
        Some(parts)
    }

    /// Σ exponent·argument of exp atoms or phases.
    fn argument(&mut self, powers: &[Power]) -> Option<Id> {
        let mut terms = Vec::new();
        for power in powers {
            let argument = self.atom(power.atom)?;
            let factor = self.dag.constant(power.exponent.to_number().to_rational());
            terms.push(self.dag.mul(factor, argument));
        }
        Some(self.dag.sum(terms))
    }

    /// Π powers · Π factors, negative powers as a denominator.
    fn product(&mut self, parts: &Parts, factors: &[Id]) -> Option<Id> {
        let mut above = Vec::new();
        let mut below = Vec::new();
        for power in &parts.plain {
            let base = self.atom(power.atom)?;
            let negative = power.exponent.is_negative();
            let size = if negative {
                power.exponent.neg().ok()?
            } else {
                power.exponent
            };
            let exponent = self.dag.constant(size.to_number().to_rational());
            let value = self.dag.pow(base, exponent);
            if negative {
                below.push(value)
            } else {
                above.push(value)
            }
        }
        if !parts.exponential.is_empty() {
            let argument = self.argument(&parts.exponential)?;
            above.push(self.dag.call(Function::Exp, argument));
        }
        above.extend_from_slice(factors);
        let above = self.multiply(&above);
        let below = self.multiply(&below);
        Some(self.dag.div(above, below))
    }

    fn multiply(&mut self, factors: &[Id]) -> Id {
        let one = self.dag.integer(1);
        factors
            .iter()
            .fold(one, |product, &factor| self.dag.mul(product, factor))
    }

    /// What an atom stands for; of an exponential or phase, its argument.
    fn atom(&mut self, atom: Atom) -> Option<Id> {
        if let Some(&id) = self.atoms.get(&atom) {
            return Some(id);
        }
        let id = match self.algebra.kind(atom)?.clone() {
            Kind::Variable(name) => self.dag.variable(&name),
            Kind::Pi => self.dag.pi(),
            Kind::Exp(argument) | Kind::Phase(argument) => self.fraction(&argument)?,
            Kind::Root(base) | Kind::Opaque(base) => self.fraction(&base)?,
            Kind::Call(function, argument) => {
                let argument = self.fraction(&argument)?;
                self.dag.call(function, argument)
            }
        };
        self.atoms.insert(atom, id);
        Some(id)
    }
}
