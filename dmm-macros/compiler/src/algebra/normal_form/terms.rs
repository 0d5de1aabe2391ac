//! The normal forms of several expressions as plain data: sums of terms over common atoms, for
//! what wants to look at coefficients (linear algebra over them) and not only at "zero or not".

use super::super::{Dag, Function, Id, Name, Rational};
use super::algebra::{Algebra, Kind};
use super::form::normal_form;
use super::fraction::Fraction;
use super::monomial::Power;
use super::number::Number;
use super::polynomial::Polynomial;
use super::write_back::Writer;

/// The normal forms of expressions over common atoms. Atoms are algebraically independent but
/// for roots.
#[derive(Clone, Debug)]
pub struct Terms {
    /// The atoms; those that an atom is made of come before it.
    pub atoms: Vec<Atom>,
    /// The forms, in the order of the expressions.
    pub forms: Vec<Ratio>,
}

/// What a power in a term is a power of.
#[derive(Clone, Debug)]
pub enum Atom {
    /// A variable.
    Variable(Name),
    /// π
    Pi,
    /// exp(u)
    Exp(Id),
    /// exp(i·u)
    Phase(Id),
    /// A quantity of which fractional powers occur.
    Root(Ratio),
    /// `ln`, `asin` or `atan` of u.
    Call(Function, Id),
    /// A symbol for something else.
    Opaque,
}

/// A sum over a product of powers of sums.
#[derive(Clone, Debug, PartialEq)]
pub struct Ratio {
    /// The terms of the numerator.
    pub numerator: Vec<Term>,
    /// The factors of the denominator, each with its terms and its power.
    pub denominator: Vec<(Vec<Term>, u32)>,
}

/// (real + i·imaginary) Π atomᵉ
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The indices of atoms, rising, with their exponents.
    pub powers: Vec<(usize, Exponent)>,
    /// The real part of the coefficient.
    pub real: Rational,
    /// The imaginary part of the coefficient.
    pub imaginary: Rational,
}

/// A rational exponent: numerator, positive denominator, in lowest terms.
pub type Exponent = (i64, i64);

/// The normal forms of `roots`; `None` if one of them has none.
pub fn terms(dag: &mut Dag, roots: &[Id]) -> Option<Terms> {
    let mut algebra = Algebra::new(dag);
    let mut fractions = Vec::with_capacity(roots.len());
    for &root in roots {
        let form = normal_form(&mut algebra, dag, root).ok()?;
        fractions.push(algebra.lowest_terms(form).ok()?);
    }
    let forms = fractions.iter().map(|fraction| ratio(&algebra, fraction));
    let forms = forms.collect::<Option<_>>()?;
    let mut kinds = Vec::new();
    while let Some(kind) = algebra.kind(kinds.len() as u32) {
        kinds.push(kind.clone());
    }
    let atoms = kinds.iter().map(|kind| atom(dag, &mut algebra, kind));
    let atoms = atoms.collect::<Option<_>>()?;
    Some(Terms { atoms, forms })
}

fn atom(dag: &mut Dag, algebra: &mut Algebra, kind: &Kind) -> Option<Atom> {
    Some(match kind {
        Kind::Variable(name) => Atom::Variable(name.clone()),
        Kind::Pi => Atom::Pi,
        Kind::Exp(argument) => Atom::Exp(Writer::new(dag, algebra).fraction(argument)?),
        Kind::Phase(argument) => Atom::Phase(Writer::new(dag, algebra).fraction(argument)?),
        Kind::Root(base) => Atom::Root(ratio(algebra, base)?),
        Kind::Call(function, argument) => {
            Atom::Call(*function, Writer::new(dag, algebra).fraction(argument)?)
        }
        Kind::Opaque(_) => Atom::Opaque,
    })
}

fn ratio(algebra: &Algebra, fraction: &Fraction) -> Option<Ratio> {
    let mut denominator = Vec::new();
    for &(index, multiplicity) in &fraction.denominator {
        denominator.push((sum(algebra.factor(index)?)?, multiplicity));
    }
    Some(Ratio {
        numerator: sum(&fraction.numerator)?,
        denominator,
    })
}

fn sum(polynomial: &Polynomial) -> Option<Vec<Term>> {
    let terms = polynomial.terms().iter().map(|term| {
        let powers = term.monomial.iter().map(power);
        Some(Term {
            powers: powers.collect::<Option<_>>()?,
            real: term.coefficient.re.to_rational(),
            imaginary: term.coefficient.im.to_rational(),
        })
    });
    terms.collect()
}

fn power(power: &Power) -> Option<(usize, Exponent)> {
    match power.exponent.to_number() {
        Number::Small(numerator, denominator) => {
            Some((power.atom as usize, (numerator, denominator)))
        }
        Number::Big(_) => None,
    }
}
