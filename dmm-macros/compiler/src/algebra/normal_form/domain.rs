//! What the domain of an expression says about signs.
//!
//! An identity is decided where every node of the expressions is defined. Where √x, ln x or
//! x^r with a fractional r occurs, x ≥ 0 on that domain, and there √(xy) = √x·√y and
//! ln(xy) = ln x + ln y: with w ≥ 0, (wv)^r = w^r v^r wherever the left side is real (for w = 0
//! both are 0), and w > 0 wherever ln(wv) is. Arguments that are variables or polynomials of
//! variables are used.

use super::super::{Dag, Id, Math};
use super::Obstacle;
use super::algebra::{Algebra, Kind};
use super::form::normal_form;
use super::fraction::Fraction;
use super::monomial::{Atom, Exponent, Power};
use super::number::{Coefficient, Number};
use super::polynomial::{Polynomial, Term};

/// Polynomials with more terms than this are not looked for as factors.
const MOST_TERMS: usize = 16;

impl Algebra {
    /// Learns what is not negative wherever `roots` are defined. It has to come before the
    /// first form.
    pub(super) fn assume_domain(&mut self, dag: &Dag, roots: impl IntoIterator<Item = Id>) {
        let nodes = dag.reachable(roots);
        let arguments: Vec<Id> = nodes
            .iter()
            .filter_map(|&id| not_negative_argument(dag, id))
            .collect();
        for &argument in &arguments {
            if let Math::Variable(name) = &dag[argument] {
                let atom = self.variable(name);
                self.positive.insert(atom);
            }
        }
        for argument in arguments {
            if matches!(dag[argument], Math::Variable(_)) || !is_polynomial(dag, argument) {
                continue;
            }
            let Ok(form) = normal_form(self, dag, argument) else {
                continue;
            };
            if let Ok(Some(polynomial)) = self.assumed_factor(&form)
                && !self.positive_factors.contains(&polynomial)
            {
                self.positive_factors.push(polynomial);
            }
        }
        // a product of another one says nothing new, and would hide its factors
        let all = std::mem::take(&mut self.positive_factors);
        let is_product = |p: &Polynomial| {
            all.iter().any(|q| {
                let quotient = if q == p {
                    None
                } else {
                    p.divide(q, &self.budget)
                };
                quotient.is_some_and(|rest| {
                    let ranges = rest.exponent_ranges();
                    ranges.iter().all(|(_, least, _)| !least.is_negative())
                })
            })
        };
        self.positive_factors = all.iter().filter(|p| !is_product(p)).cloned().collect();
    }

    /// The polynomial that is not negative because `form` is not.
    fn assumed_factor(&self, form: &Fraction) -> Result<Option<Polynomial>, Obstacle> {
        let numerator = &form.numerator;
        if !form.denominator.is_empty() || !(2..=MOST_TERMS).contains(&numerator.len()) {
            return Ok(None);
        }
        let monomial = self.common_monomial(numerator)?;
        let unit = Term {
            monomial,
            coefficient: Coefficient::real(numerator.content()),
        };
        let polynomial = numerator.times_term(&unit.inverse()?)?;
        let root = self.evident_polynomial_root(&polynomial)?;
        Ok(Some(root.unwrap_or(polynomial)))
    }

    /// Takes factors out of `u` that are not negative on the domain: with their exponents, and
    /// `u` what is left.
    pub(super) fn split_assumed(
        &self,
        u: &mut Fraction,
    ) -> Result<Vec<(Fraction, Exponent)>, Obstacle> {
        let mut taken: Vec<(Fraction, Exponent)> = Vec::new();
        for polynomial in &self.positive_factors {
            let mut exponent = 0_i32;
            let is_opposite = |factor: &Polynomial| {
                factor.len() == polynomial.len() && *factor == polynomial.neg()
            };
            for (index, multiplicity) in std::mem::take(&mut u.denominator) {
                let factor = self.factor(index).ok_or(Obstacle::Undefined)?;
                let opposite = is_opposite(factor);
                if factor != polynomial && !opposite {
                    u.denominator.push((index, multiplicity));
                    continue;
                }
                if opposite && multiplicity % 2 == 1 {
                    u.numerator = u.numerator.neg();
                }
                let multiplicity = i32::try_from(multiplicity).map_err(|_| Obstacle::TooLarge)?;
                exponent = exponent
                    .checked_sub(multiplicity)
                    .ok_or(Obstacle::TooLarge)?;
            }
            while u.numerator.len() > 1
                && let Some(quotient) = u.numerator.divide(polynomial, &self.budget)
            {
                u.numerator = quotient;
                exponent = exponent.checked_add(1).ok_or(Obstacle::TooLarge)?;
            }
            if exponent != 0 {
                taken.push((polynomial.clone().into(), Exponent::integer(exponent)));
            }
        }
        Ok(taken)
    }

    /// s with s² = `u` that is positive term by term, if there is one.
    pub(super) fn evident_root(&mut self, u: &Fraction) -> Result<Option<Fraction>, Obstacle> {
        let Some(numerator) = self.evident_polynomial_root(&u.numerator)? else {
            return Ok(None);
        };
        let mut denominator = u.denominator.clone();
        for (index, multiplicity) in &mut denominator {
            let factor = self.factor(*index).ok_or(Obstacle::Undefined)?;
            if *multiplicity % 2 == 1 || !self.is_evidently_positive(factor) {
                return Ok(None);
            }
            *multiplicity /= 2;
        }
        Ok(Some(Fraction {
            numerator,
            denominator,
        }))
    }

    /// Whether `u` is positive or zero term by term, above and below.
    pub(super) fn is_evident_quotient(&self, u: &Fraction) -> bool {
        let mut factors = u.denominator.iter();
        self.is_evidently_positive(&u.numerator)
            && factors.all(|&(index, multiplicity)| {
                multiplicity % 2 == 0
                    || self
                        .factor(index)
                        .is_some_and(|factor| self.is_evidently_positive(factor))
            })
    }

    fn evident_polynomial_root(
        &self,
        polynomial: &Polynomial,
    ) -> Result<Option<Polynomial>, Obstacle> {
        if polynomial.len() == 1 || self.has_phases(polynomial) {
            return Ok(None);
        }
        let root = polynomial.square_root()?;
        Ok(root.filter(|root| self.is_evidently_positive(root)))
    }

    /// Whether no term is negative: positive coefficients of even powers or positive atoms. A
    /// fractional power alone says nothing here, because halving exponents may have made it.
    fn is_evidently_positive(&self, polynomial: &Polynomial) -> bool {
        polynomial.terms().iter().all(|term| {
            let Coefficient { re, im } = &term.coefficient;
            im.is_zero()
                && !re.is_negative()
                && term
                    .monomial
                    .iter()
                    .all(|power| power.exponent.is_even() || self.is_positive_atom(power.atom))
        })
    }

    /// Whether a power is positive wherever it is real and on the domain.
    pub(super) fn is_positive(&self, power: Power) -> bool {
        power.exponent.needs_positive_base() || self.is_positive_atom(power.atom)
    }

    fn is_positive_atom(&self, atom: Atom) -> bool {
        self.positive.contains(&atom)
            || matches!(
                self.kind(atom),
                Some(Kind::Exp(_) | Kind::Pi | Kind::Root(_))
            )
    }
}

/// u, where the node is √u, ln u, or u to a power that needs u ≥ 0.
fn not_negative_argument(dag: &Dag, id: Id) -> Option<Id> {
    match dag[id] {
        Math::Call(function, u) if function.properties().domain.is_half_line() => Some(u),
        Math::Pow([u, exponent]) if dag.as_integer(exponent).is_none() => Some(u),
        _ => None,
    }
}

/// Whether `root` is made of sums, products and natural powers of variables and constants.
fn is_polynomial(dag: &Dag, root: Id) -> bool {
    dag.reachable([root]).into_iter().all(|id| match dag[id] {
        Math::Constant(_)
        | Math::Variable(_)
        | Math::Neg(_)
        | Math::Add(_)
        | Math::Sub(_)
        | Math::Mul(_) => true,
        Math::Pow([_, exponent]) => dag
            .as_integer(exponent)
            .is_some_and(|n| (0..=16).contains(&n)),
        _ => false,
    })
}

impl Polynomial {
    /// s with s² = self and a positive leading coefficient, as a polynomial, if there is one
    /// that is found term by term from the leading one.
    fn square_root(&self) -> Result<Option<Self>, Obstacle> {
        const MOST_STEPS: usize = 24;
        let Some(first) = self.terms().first().and_then(halved) else {
            return Ok(None);
        };
        let two = Coefficient::real(Number::integer(2));
        let half_inverse = Term {
            coefficient: first.coefficient.mul(&two),
            ..first.clone()
        }
        .inverse()?;
        let mut root = Self::from(first.clone());
        let mut rest = self.add(&root.mul(&root)?.neg())?;
        for _ in 0..MOST_STEPS {
            let Some(leading) = rest.terms().first() else {
                return Ok(Some(root));
            };
            let term = Self::from(leading.mul(&half_inverse)?);
            // rest − t·(2s + t)
            let factor = root.scaled(&two).add(&term)?;
            rest = rest.add(&term.mul(&factor)?.neg())?;
            root = root.add(&term)?;
            if rest.len() > self.len() {
                return Ok(None);
            }
        }
        Ok(None)
    }
}

/// The square root of a term whose coefficient is a square.
fn halved(term: &Term) -> Option<Term> {
    let Number::Small(n, d) = term.coefficient.re else {
        return None;
    };
    let [n_root, d_root] = [n, d].map(|square| (square > 0).then(|| num_integer::sqrt(square)));
    let (n_root, d_root) = (n_root?, d_root?);
    let square = n_root.checked_mul(n_root) == Some(n) && d_root.checked_mul(d_root) == Some(d);
    if !term.coefficient.is_real() || !square {
        return None;
    }
    let half = Exponent::from_number(&Number::Small(1, 2)).ok()?;
    let mut monomial = term.monomial.clone();
    for power in &mut monomial {
        power.exponent = power.exponent.mul(half).ok()?;
    }
    Some(Term {
        monomial,
        coefficient: Coefficient::real(Number::Small(n_root, d_root)),
    })
}
