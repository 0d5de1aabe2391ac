//! The field in which expressions have their normal form: the tables of its atoms and of its
//! denominators' factors.
//!
//! The relations between atoms are kept by construction (exponentials of dependent arguments
//! are powers of one atom) but for those of [`roots`](super::roots). A numerator without terms
//! is then zero; that is what [`decide_zero`](super::decide_zero) rests on. The converse does
//! not hold: the base of a root that is a square has relations that are not seen.

use std::collections::{BTreeSet, HashMap};

use super::super::work::Budget;
use super::super::{Dag, Function, Name};
use super::Obstacle;
use super::fraction::Fraction;
use super::monomial::Atom;
use super::polynomial::Polynomial;

/// Terms formed by sums and products of one algebra before it gives up.
const MOST_WORK: usize = 400_000;

/// What an atom stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A variable.
    Variable(Name),
    /// π
    Pi,
    /// exp(m), m a monomial over denominators; its powers are exp(c·m).
    Exp(Fraction),
    /// exp(i·m)
    Phase(Fraction),
    /// R, of which only powers Rᵉ with 0 < e < 1 occur.
    Root(Fraction),
    /// `ln`, `asin` or `atan` of an argument.
    Call(Function, Fraction),
    /// A real expression with phases in it, as one symbol.
    Opaque(Fraction),
}

/// The tables of atoms and of denominators' factors.
#[derive(Debug)]
pub(super) struct Algebra {
    kinds: Vec<Kind>,
    variables: HashMap<Name, Atom>,
    pub(super) factors: Vec<Polynomial>,
    /// Variables that are not negative on the [`domain`](super::domain).
    pub(super) positive: BTreeSet<Atom>,
    /// Polynomials that are not negative on the domain.
    pub(super) positive_factors: Vec<Polynomial>,
    /// Whether only zero or not matters: constants are then written by one another.
    pub(super) decides: bool,
    /// The atom exp(iπ), where it occurs.
    pub(super) half_turn: Option<Atom>,
    pub(super) has_roots: bool,
    has_phases: bool,
    /// How deep reductions of roots are nested just now.
    pub(super) depth: usize,
    /// The terms that may still be formed.
    pub(super) budget: Budget,
}

impl Algebra {
    /// An algebra for expressions of `dag`.
    pub(super) fn new(dag: &Dag) -> Self {
        Self::with_budget(dag, MOST_WORK)
    }

    /// An algebra that gives up after forming `budget` terms.
    pub(super) fn with_budget(dag: &Dag, budget: usize) -> Self {
        Self {
            kinds: Vec::new(),
            variables: HashMap::new(),
            factors: Vec::new(),
            positive: BTreeSet::new(),
            positive_factors: Vec::new(),
            decides: false,
            half_turn: None,
            has_roots: false,
            has_phases: false,
            depth: 0,
            budget: dag.work.budget(budget),
        }
    }

    pub(super) fn spend(&self, terms: usize) -> Result<(), Obstacle> {
        if self.budget.spend(terms) {
            Ok(())
        } else {
            Err(Obstacle::TooLarge)
        }
    }

    pub(super) fn kind(&self, atom: Atom) -> Option<&Kind> {
        self.kinds.get(atom as usize)
    }

    pub(super) fn factor(&self, index: usize) -> Option<&Polynomial> {
        self.factors.get(index)
    }

    pub(super) fn is_phase(&self, atom: Atom) -> bool {
        matches!(self.kind(atom), Some(Kind::Phase(_)))
    }

    /// Whether phases occur in `polynomial`.
    pub(super) fn has_phases(&self, polynomial: &Polynomial) -> bool {
        self.has_phases
            && polynomial
                .terms()
                .iter()
                .any(|term| term.monomial.iter().any(|power| self.is_phase(power.atom)))
    }

    /// Whether phases occur in `fraction`.
    pub(super) fn is_complex(&self, fraction: &Fraction) -> bool {
        self.has_phases(&fraction.numerator)
            || fraction
                .denominator
                .iter()
                .filter_map(|&(index, _)| self.factor(index))
                .any(|factor| self.has_phases(factor))
    }

    pub(super) fn variable(&mut self, name: &Name) -> Atom {
        if let Some(&atom) = self.variables.get(name) {
            return atom;
        }
        let atom = self.push(Kind::Variable(name.clone()));
        self.variables.insert(name.clone(), atom);
        atom
    }

    fn push(&mut self, kind: Kind) -> Atom {
        self.has_roots |= matches!(kind, Kind::Root(_));
        self.has_phases |= matches!(kind, Kind::Phase(_));
        self.kinds.push(kind);
        (self.kinds.len() - 1) as Atom
    }

    /// The atom of `kind`: one with an equal argument if there is one.
    pub(super) fn intern(&mut self, kind: Kind) -> Result<Atom, Obstacle> {
        for index in 0..self.kinds.len() {
            let Some(known) = self.kinds.get(index) else {
                break;
            };
            if *known == kind {
                return Ok(index as Atom);
            }
            // without denominators equal arguments have equal forms
            let pair = match (known, &kind) {
                (Kind::Exp(a), Kind::Exp(b))
                | (Kind::Phase(a), Kind::Phase(b))
                | (Kind::Root(a), Kind::Root(b))
                | (Kind::Opaque(a), Kind::Opaque(b)) => Some((a, b)),
                (Kind::Call(f, a), Kind::Call(g, b)) if f == g => Some((a, b)),
                _ => None,
            };
            let differ = |(a, b): &(&Fraction, &Fraction)| {
                !a.denominator.is_empty() || !b.denominator.is_empty()
            };
            if let Some((a, b)) = pair.filter(differ) {
                let (a, b) = (a.clone(), b.neg());
                if self.add(&a, &b)?.is_zero() {
                    return Ok(index as Atom);
                }
            }
        }
        Ok(self.push(kind))
    }
}
