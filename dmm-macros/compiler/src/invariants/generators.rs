//! The quantities of which invariants are sought as polynomials.
//!
//! They are the states and what f is made of besides, as the declaration writes it:
//! exponentials, the sine and cosine of each angle, roots and reciprocals. With them come the
//! quantities of which they are derivatives, which is what occurs in energies: ln(cosh u) for
//! tanh u, ln d for a denominator d, and so on. Where a state divides its own rate, as a
//! population does, its logarithm is there as well, for invariants such as x − ln x.

use std::collections::BTreeSet;

use num_traits::{Signed, ToPrimitive};

use crate::algebra::normal_form::terms::{Atom, Exponent, Term, Terms};
use crate::algebra::{Dag, Function, Id, Math, Name, Rational};

pub(super) use super::field::exponent_of;

/// A quantity, and how high a power of it is of use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Generator {
    pub(super) expression: Id,
    pub(super) highest: u32,
}

/// Powers that are all of use.
const ANY: u32 = u32::MAX;

/// The generators of the fields with these components, whose normal forms are in `terms`.
pub(super) fn generators(
    dag: &mut Dag,
    states: &[Name],
    components: &[Id],
    terms: &Terms,
) -> Vec<Generator> {
    let mut collector = Collector {
        dag,
        found: Vec::new(),
        of_states: BTreeSet::new(),
    };
    for name in states {
        let state = collector.dag.variable(name);
        collector.add(state, ANY);
    }
    let nodes = collector.dag.reachable(components.iter().copied());
    for &id in &nodes {
        collector.mark(states, id);
    }
    for &id in &nodes {
        collector.node(id);
    }
    for (place, name) in states.iter().enumerate() {
        // The forms are those of all fields, one after the other.
        let rates = terms.forms.iter().skip(place).step_by(states.len());
        let numerators: Vec<&Term> = rates.flat_map(|rate| &rate.numerator).collect();
        if divides(terms, name, &numerators) {
            let state = collector.dag.variable(name);
            collector.function(Function::Ln, state, 1);
        }
    }
    collector.found
}

/// Whether there are terms, and each has a positive power of this variable.
fn divides(terms: &Terms, name: &Name, sum: &[&Term]) -> bool {
    let is_this = |atom: &Atom| matches!(atom, Atom::Variable(other) if other == name);
    let index = terms.atoms.iter().position(is_this);
    !sum.is_empty()
        && index.is_some_and(|index| sum.iter().all(|term| exponent_of(term, index).0 > 0))
}

struct Collector<'d> {
    dag: &'d mut Dag,
    found: Vec<Generator>,
    /// The nodes that depend on the states.
    of_states: BTreeSet<Id>,
}

impl Collector<'_> {
    fn add(&mut self, expression: Id, highest: u32) {
        if self
            .found
            .iter()
            .all(|known| known.expression != expression)
        {
            self.found.push(Generator {
                expression,
                highest,
            });
        }
    }

    fn function(&mut self, function: Function, argument: Id, highest: u32) {
        let value = self.dag.call(function, argument);
        self.add(value, highest);
    }

    /// Notes whether a node, whose children were noted, depends on the states.
    fn mark(&mut self, states: &[Name], id: Id) {
        let of_states = &self.of_states;
        let depends = match &self.dag[id] {
            Math::Variable(name) => states.contains(name),
            node => egg::Language::any(node, |child| of_states.contains(&child)),
        };
        if depends {
            self.of_states.insert(id);
        }
    }

    fn node(&mut self, id: Id) {
        if !self.of_states.contains(&id) {
            return;
        }
        match self.dag[id].clone() {
            Math::Call(function, argument) => self.call(function, argument),
            Math::Div([_, below]) => self.denominator(below),
            Math::Pow([base, exponent]) => match self.dag.as_constant(exponent).cloned() {
                Some(exponent) => {
                    if !exponent.is_integer() {
                        self.root(base, &exponent);
                    } else if exponent.is_negative() {
                        self.denominator(base);
                    }
                }
                None => self.add(id, ANY),
            },
            _ => {}
        }
    }

    fn call(&mut self, function: Function, argument: Id) {
        let argument = match function {
            Function::Sqrt | Function::Exp | Function::Ln => argument,
            _ => self.one_of_both_signs(argument),
        };
        match function {
            Function::Sin | Function::Cos => {
                self.function(Function::Cos, argument, ANY);
                self.function(Function::Sin, argument, 1);
            }
            Function::Sinh | Function::Cosh => {
                self.function(Function::Cosh, argument, ANY);
                self.function(Function::Sinh, argument, 1);
            }
            Function::Tan | Function::Tanh => {
                self.function(function, argument, ANY);
                let even = match function {
                    Function::Tan => Function::Cos,
                    _ => Function::Cosh,
                };
                let even = self.dag.call(even, argument);
                self.function(Function::Ln, even, 1);
            }
            Function::Asin | Function::Acos | Function::Atan => {
                self.function(function, argument, ANY);
                let one = self.dag.integer(1);
                let square = self.dag.powi(argument, 2);
                if function == Function::Atan {
                    let sum = self.dag.add(one, square);
                    self.function(Function::Ln, sum, 1);
                } else {
                    let difference = self.dag.sub(one, square);
                    self.function(Function::Sqrt, difference, 1);
                }
            }
            Function::Sqrt => self.root(argument, &Rational::new(1.into(), 2.into())),
            _ => self.function(function, argument, ANY),
        }
    }

    /// u or −u: one does for functions that are even or odd.
    fn one_of_both_signs(&mut self, argument: Id) -> Id {
        let opposite = self.dag.neg(argument);
        let is_known = self.found.iter().any(
            |known| matches!(self.dag[known.expression], Math::Call(_, angle) if angle == opposite),
        );
        match self.dag[argument] {
            Math::Neg(_) => opposite,
            _ if is_known => opposite,
            _ => argument,
        }
    }

    /// u^(1/d) and its reciprocal, for an exponent n/d.
    fn root(&mut self, base: Id, exponent: &Rational) {
        let exponent = Rational::new(1.into(), exponent.denom().clone());
        let highest = exponent.denom().to_u32().map_or(1, |degree| degree - 1);
        let exponent = self.dag.constant(exponent);
        let root = self.dag.pow(base, exponent);
        self.add(root, highest);
        self.reciprocal(root);
    }

    fn reciprocal(&mut self, id: Id) {
        let one = self.dag.integer(1);
        let reciprocal = self.dag.div(one, id);
        self.add(reciprocal, ANY);
    }

    /// The reciprocals and logarithms of the factors of a denominator.
    fn denominator(&mut self, id: Id) {
        if !self.of_states.contains(&id) {
            return;
        }
        match self.dag[id].clone() {
            Math::Mul([u, v]) => {
                self.denominator(u);
                self.denominator(v);
            }
            Math::Neg(u) | Math::Div([u, _]) => self.denominator(u),
            Math::Pow([base, exponent]) if self.dag.as_integer(exponent).is_some() => {
                self.denominator(base);
            }
            // Roots are there with their reciprocals.
            Math::Call(Function::Sqrt, _) => {}
            Math::Pow([_, exponent]) if self.dag.as_constant(exponent).is_some() => {}
            Math::Call(Function::Exp, argument) => {
                let opposite = self.dag.neg(argument);
                self.function(Function::Exp, opposite, ANY);
            }
            Math::Call(..) => self.reciprocal(id),
            _ => {
                self.reciprocal(id);
                self.function(Function::Ln, id, 1);
            }
        }
    }
}

/// Whether an atom depends on one of these variables.
pub(super) fn depends(dag: &Dag, names: &[Name], terms: &Terms, index: usize) -> bool {
    match terms.atoms.get(index) {
        Some(Atom::Variable(name)) => names.contains(name),
        Some(Atom::Exp(u) | Atom::Phase(u) | Atom::Call(_, u)) => {
            dag.variables([*u]).iter().any(|name| names.contains(name))
        }
        Some(Atom::Root(base)) => {
            let factors = base.denominator.iter().map(|(factor, _)| factor);
            let mut powers = factors
                .chain([&base.numerator])
                .flatten()
                .flat_map(|term| &term.powers);
            // Atoms of a base come before its root.
            powers.any(|&(inner, _)| inner < index && depends(dag, names, terms, inner))
        }
        // What is not known may depend on anything.
        Some(Atom::Opaque) => true,
        Some(Atom::Pi) | None => false,
    }
}

/// A sum of real terms as an expression; `None` if phases or symbols occur in it.
pub(super) fn sum(dag: &mut Dag, terms: &Terms, sum: &[Term]) -> Option<Id> {
    let mut written = dag.integer(0);
    for term in sum {
        if !num_traits::Zero::is_zero(&term.imaginary) {
            return None;
        }
        let coefficient = dag.constant(term.real.clone());
        let mut product = coefficient;
        for &(index, exponent) in &term.powers {
            let factor = power(dag, terms, index, exponent)?;
            product = dag.mul(product, factor);
        }
        written = dag.add(written, product);
    }
    Some(written)
}

/// A power of an atom as an expression.
pub(super) fn power(
    dag: &mut Dag,
    terms: &Terms,
    index: usize,
    (numerator, denominator): Exponent,
) -> Option<Id> {
    let base = expression(dag, terms, index)?;
    let exponent = dag.constant(Rational::new(numerator.into(), denominator.into()));
    Some(dag.pow(base, exponent))
}

/// An atom as an expression; of a root, its base.
fn expression(dag: &mut Dag, terms: &Terms, index: usize) -> Option<Id> {
    match terms.atoms.get(index)? {
        Atom::Variable(name) => Some(dag.variable(name)),
        Atom::Pi => Some(dag.pi()),
        Atom::Exp(argument) => Some(dag.call(Function::Exp, *argument)),
        Atom::Call(function, argument) => Some(dag.call(*function, *argument)),
        Atom::Root(base) => {
            let mut value = sum(dag, terms, &base.numerator)?;
            for (factor, multiplicity) in &base.denominator {
                let factor = sum(dag, terms, factor)?;
                let below = dag.powi(factor, (*multiplicity).into());
                value = dag.div(value, below);
            }
            Some(value)
        }
        Atom::Phase(_) | Atom::Opaque => None,
    }
}
