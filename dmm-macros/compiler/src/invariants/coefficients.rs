//! Coefficients that are functions of the parameters, by elimination with the parameters as
//! symbols, and their common denominator.
//!
//! The search modulo a prime says which monomials an invariant is made of, and that the
//! coefficients are unique once one of them is 1. What is found here is proved afterwards.

use std::collections::BTreeMap;

use num_traits::Zero;

use crate::algebra::linear::dot;
use crate::algebra::normal_form::terms::{Atom, Exponent, Term, Terms, terms};
use crate::algebra::{Dag, Id, Name, Rational, divide_exactly, gradient, normalise};

use super::field::to_coprime_integers;
use super::generators;

/// Quotients and sums that an elimination with symbols may take.
const MOST_OPERATIONS: usize = 6_000;

/// The coefficients of these monomials, those that are known among them.
pub(super) fn functions(
    dag: &mut Dag,
    states: &[Name],
    fields: &[&[Id]],
    monomials: &[Id],
    known: &[Option<Id>],
) -> Option<Vec<Id>> {
    if let Some(all) = known.iter().copied().collect() {
        return Some(all);
    }
    let unknowns: Vec<Name> = (0..monomials.len()).map(unknown).collect();
    let mut psi = dag.integer(0);
    for ((&monomial, value), name) in monomials.iter().zip(known).zip(&unknowns) {
        let coefficient = value.unwrap_or_else(|| dag.variable(name));
        let term = dag.mul(coefficient, monomial);
        psi = dag.add(psi, term);
    }
    let gradient = gradient(dag, psi, states);
    let mut residuals = Vec::new();
    for field in fields {
        residuals.push(dot(dag, &gradient, field));
    }
    let terms = terms(dag, &residuals)?;
    let equations = equations(dag, states, &unknowns, &terms)?;
    let mut elimination = Elimination {
        dag,
        equations,
        expressed: Vec::new(),
        operations: 0,
    };
    let solution = elimination.solve()?;
    let values = known.iter().enumerate();
    values
        .map(|(place, value)| value.or_else(|| solution.get(&place).copied()))
        .collect()
}

/// The variable of a coefficient; no declaration can have a name with such a digit.
fn unknown(place: usize) -> Name {
    Name::new(&format!("coefficient₀{place}"))
}

/// Σ coefficient·unknown + constant = 0, by the unknown's place, the constant's `None`.
type Equation = BTreeMap<Option<usize>, Id>;

/// A product of powers of atoms, and whether it stands for the imaginary parts.
type Key = (Vec<(usize, Exponent)>, bool);

/// Each product of atoms that depend on the states has the coefficient 0.
fn equations(
    dag: &mut Dag,
    states: &[Name],
    unknowns: &[Name],
    terms: &Terms,
) -> Option<Vec<Equation>> {
    let place = |index: usize| match terms.atoms.get(index) {
        Some(Atom::Variable(name)) => unknowns.iter().position(|other| other == name),
        _ => None,
    };
    let of_states: Vec<bool> = (0..terms.atoms.len())
        .map(|index| generators::depends(dag, states, terms, index))
        .collect();
    let mut equations = Vec::new();
    for form in &terms.forms {
        let mut collected: BTreeMap<Key, BTreeMap<Option<usize>, Vec<Term>>> = BTreeMap::new();
        for term in &form.numerator {
            let (of_state, rest): (Vec<_>, Vec<_>) = term
                .powers
                .iter()
                .partition(|&&(index, _)| of_states.get(index) == Some(&true));
            let unknown = rest.iter().find_map(|&(index, _)| place(index));
            let rest: Vec<_> = rest
                .into_iter()
                .filter(|&(index, _)| place(index).is_none())
                .collect();
            for (is_imaginary, part) in [(false, &term.real), (true, &term.imaginary)] {
                if part.is_zero() {
                    continue;
                }
                let equation = collected
                    .entry((of_state.clone(), is_imaginary))
                    .or_default();
                equation.entry(unknown).or_default().push(Term {
                    powers: rest.clone(),
                    real: part.clone(),
                    imaginary: Rational::zero(),
                });
            }
        }
        for by_unknown in collected.into_values() {
            let mut equation = Equation::new();
            for (unknown, sum) in by_unknown {
                equation.insert(unknown, generators::sum(dag, terms, &sum)?);
            }
            equations.push(equation);
        }
    }
    Some(equations)
}

/// Gaussian elimination with functions of the parameters, the shortest equation first.
struct Elimination<'d> {
    dag: &'d mut Dag,
    equations: Vec<Equation>,
    /// Unknowns with the equation that gives them from those expressed later.
    expressed: Vec<(usize, Equation)>,
    operations: usize,
}

impl Elimination<'_> {
    fn solve(&mut self) -> Option<BTreeMap<usize, Id>> {
        while let Some(pivot) = self.shortest() {
            let equation = self.equations.swap_remove(pivot);
            let (unknown, coefficient) = self.simplest(&equation)?;
            // unknown + Σ … = 0
            let mut scaled = Equation::new();
            for (&place, &value) in &equation {
                if place != Some(unknown) {
                    scaled.insert(place, self.divide(value, coefficient)?);
                }
            }
            for index in 0..self.equations.len() {
                self.replace(index, unknown, &scaled)?;
            }
            self.equations.retain(|equation| !equation.is_empty());
            self.expressed.push((unknown, scaled));
        }
        // What is left has a constant alone, and no solution.
        if !self.equations.is_empty() {
            return None;
        }
        let mut solution: BTreeMap<usize, Id> = BTreeMap::new();
        while let Some((unknown, equation)) = self.expressed.pop() {
            let mut sum = self.dag.integer(0);
            for (place, factor) in equation {
                let term = match place {
                    None => factor,
                    Some(other) => {
                        let value = *solution.get(&other)?;
                        self.dag.mul(factor, value)
                    }
                };
                sum = self.dag.sub(sum, term);
            }
            let value = normalise(self.dag, sum)?;
            solution.insert(unknown, value);
        }
        Some(solution)
    }

    /// The equation with the fewest unknowns, at least one.
    fn shortest(&self) -> Option<usize> {
        let count = |equation: &Equation| equation.keys().filter(|place| place.is_some()).count();
        let counts = self.equations.iter().map(count).enumerate();
        counts
            .filter(|&(_, count)| count > 0)
            .min_by_key(|&(index, count)| (count, index))
            .map(|(index, _)| index)
    }

    /// The unknown with the shortest coefficient.
    fn simplest(&self, equation: &Equation) -> Option<(usize, Id)> {
        let unknowns = equation
            .iter()
            .filter_map(|(place, &value)| Some(((*place)?, value)));
        unknowns.min_by_key(|&(place, value)| (self.dag.tree_size(value), place))
    }

    /// Replaces an unknown by −`scaled`.
    fn replace(&mut self, index: usize, unknown: usize, scaled: &Equation) -> Option<()> {
        let Some(mut equation) = self.equations.get_mut(index).map(std::mem::take) else {
            return Some(());
        };
        if let Some(factor) = equation.remove(&Some(unknown)) {
            for (&place, &value) in scaled {
                let product = self.dag.mul(factor, value);
                let before = equation.get(&place).copied();
                let before = before.unwrap_or_else(|| self.dag.integer(0));
                let difference = self.dag.sub(before, product);
                self.count()?;
                let difference = normalise(self.dag, difference)?;
                if self.dag.is_zero(difference) {
                    equation.remove(&place);
                } else {
                    equation.insert(place, difference);
                }
            }
        }
        if let Some(slot) = self.equations.get_mut(index) {
            *slot = equation;
        }
        Some(())
    }

    fn divide(&mut self, numerator: Id, denominator: Id) -> Option<Id> {
        self.count()?;
        Some(divide_exactly(self.dag, numerator, denominator)?.value)
    }

    fn count(&mut self) -> Option<()> {
        self.operations += 1;
        (self.operations <= MOST_OPERATIONS).then_some(())
    }
}

/// The coefficients times what makes them polynomials in the parameters with coprime integers
/// and without a common power.
pub(super) fn without_denominators(dag: &mut Dag, coefficients: &[Id]) -> Option<Vec<Id>> {
    let terms = terms(dag, coefficients)?;
    let mut factors: Vec<(&[Term], u32)> = Vec::new();
    for (factor, multiplicity) in terms.forms.iter().flat_map(|form| &form.denominator) {
        match factors.iter_mut().find(|(known, _)| known == factor) {
            Some((_, most)) => *most = (*most).max(*multiplicity),
            None => factors.push((factor, *multiplicity)),
        }
    }
    let all_terms: Vec<&Term> = terms
        .forms
        .iter()
        .flat_map(|form| &form.numerator)
        .collect();
    let integers = to_coprime_integers(all_terms.iter().map(|term| &term.real));
    let mut scale = dag.constant(integers);
    for (factor, multiplicity) in factors {
        let factor = generators::sum(dag, &terms, factor)?;
        let power = dag.powi(factor, multiplicity.into());
        scale = dag.mul(scale, power);
    }
    for index in 0..terms.atoms.len() {
        let exponents = all_terms
            .iter()
            .map(|term| generators::exponent_of(term, index));
        let least = exponents.min_by_key(|&(n, d)| Rational::new(n.into(), d.into()));
        if let Some((numerator, denominator)) = least.filter(|&(numerator, _)| numerator != 0) {
            let power = generators::power(dag, &terms, index, (-numerator, denominator))?;
            scale = dag.mul(scale, power);
        }
    }
    let mut scaled = Vec::with_capacity(coefficients.len());
    for &coefficient in coefficients {
        let product = dag.mul(scale, coefficient);
        scaled.push(normalise(dag, product)?);
    }
    Some(scaled)
}
