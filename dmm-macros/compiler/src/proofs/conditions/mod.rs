//! Where a proof holds: on the domain of the formulas that it is about.
//!
//! Each step of the normal form holds wherever every node of the expression that it starts from
//! is defined, and where it splits a root or a logarithm it uses what these nodes imply. So a
//! proof of ∂ₜψ + ∇ψ·f = 0 holds where ψ, f and the derivatives of ψ are defined:
//!
//! | node | needs |
//! |---|---|
//! | u/v | v ≠ 0 |
//! | uⁿ, n < 0 | u ≠ 0 |
//! | u^(p/q) | u ≥ 0; u > 0 for a negative exponent |
//! | u^v | u > 0 |
//! | h(u) | the [`Domain`](algebra::Domain) of h: u > 0 for ln, cos u ≠ 0 for tan, … |
//!
//! Conditions are taken apart into their factors; those that hold anyway, and those that follow
//! from others, are left out (see the module `redundant`), as are those that hold in the region
//! of the formulas. Conditions that exclude one another leave no domain (see the module
//! `within`).
//!
//! Of u^v with an exponent v that is a parameter, code has a value also where u < 0 and v is an
//! integer. Where the proof holds there as well, u ≠ 0 is asked in place of u > 0 (see
//! [`signs`](super::signs)).

mod redundant;
mod within;

use std::collections::{BTreeMap, BTreeSet};

use num_traits::Signed;

use crate::algebra::evaluate::Interval;
use crate::algebra::{self, Dag, Function, Id, Math, Name};
use crate::model::{Sign, positive};
use crate::proofs::DomainCondition;
use redundant::{equal_condition, is_within_by, without_consequences, without_multiples};

/// Where formulas are defined.
pub(crate) struct Domain {
    /// What has to hold.
    pub(crate) conditions: Vec<DomainCondition>,
    /// The conditions that exclude one another, if there is no open set where they are defined.
    pub(crate) contradiction: Option<Vec<DomainCondition>>,
}

/// What has to hold for every node of `roots` to be defined on `sides`; powers of a base in `both` with an exponent that is no number have values on both
/// sides of its zeros.
pub(crate) fn domain(
    dag: &mut Dag,
    roots: &[Id],
    sides: &[(Id, Sign)],
    both: &BTreeSet<Id>,
) -> Domain {
    let mut found = Conditions {
        both: both.clone(),
        ..Conditions::default()
    };
    for id in dag.reachable(roots.iter().copied()) {
        found.node(dag, id);
    }
    found.finish(dag, sides)
}

/// What has to hold for the operations of `nodes` alone to have values, those of their arguments
/// apart.
pub(crate) fn conditions_of(
    dag: &mut Dag,
    nodes: &[Id],
    sides: &[(Id, Sign)],
) -> Vec<DomainCondition> {
    let mut found = Conditions::default();
    for &node in nodes {
        found.node(dag, node);
    }
    found.finish(dag, sides).conditions
}

/// Whether a condition holds, but for its border, where others do.
pub(crate) fn follows(dag: &mut Dag, condition: DomainCondition, from: &[DomainCondition]) -> bool {
    let need = |condition: DomainCondition| match condition {
        DomainCondition::Positive(u) | DomainCondition::NotNegative(u) => Some((u, Need::Positive)),
        DomainCondition::NonZero(_) | DomainCondition::WithinOne(_) => None,
    };
    let known: Vec<(Id, Need)> = from.iter().filter_map(|&one| need(one)).collect();
    from.contains(&condition)
        || need(condition).is_some_and(|condition| within::is_implied_by(dag, condition, &known))
}

/// The variables that are nowhere positive where `roots` are defined.
pub(super) fn negative_variables(dag: &mut Dag, roots: &[Id]) -> Vec<Name> {
    let mut found = Conditions::default();
    for id in dag.reachable(roots.iter().copied()) {
        found.node(dag, id);
    }
    let needs: Vec<(Id, Need)> = found.needs.into_iter().collect();
    let ranges = within::ranges(dag, &needs);
    let negative = ranges
        .into_iter()
        .filter(|(_, range)| range.is_not_positive());
    negative.map(|(name, _)| name).collect()
}

/// What is asked of a node.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Need {
    NotNegative,
    NonZero,
    Positive,
}

impl Need {
    /// The condition that it is of `u`.
    fn of(self, u: Id) -> DomainCondition {
        match self {
            Self::NotNegative => DomainCondition::NotNegative(u),
            Self::NonZero => DomainCondition::NonZero(u),
            Self::Positive => DomainCondition::Positive(u),
        }
    }

    /// The numbers that satisfy it.
    fn range(self) -> Interval {
        match self {
            Self::NotNegative => Interval::NOT_NEGATIVE,
            Self::NonZero => Interval::WHOLE.excluding_zero(),
            Self::Positive => Interval::NOT_NEGATIVE.excluding_zero(),
        }
    }

    /// Whether every number of `range` satisfies it.
    fn holds(self, range: Interval) -> bool {
        match self {
            Self::NonZero => range.nonzero,
            Self::NotNegative => range.is_not_negative(),
            Self::Positive => range.is_positive(),
        }
    }
}

#[derive(Default)]
struct Conditions {
    /// By argument; both u ≥ 0 and u ≠ 0 are u > 0.
    needs: BTreeMap<Id, Need>,
    within_one: Vec<Id>,
    /// Bases of powers that may be negative.
    both: BTreeSet<Id>,
}

impl Conditions {
    /// What the operation of a node needs of its arguments.
    fn node(&mut self, dag: &mut Dag, id: Id) {
        match dag[id] {
            Math::Div([_, v]) => self.need(dag, v, Need::NonZero),
            Math::Pow([u, v]) => match (dag.as_integer(v), dag.as_constant(v)) {
                (Some(n), _) if n >= 0 => {}
                (Some(_), _) => self.need(dag, u, Need::NonZero),
                (None, Some(value)) if value.is_positive() => self.need(dag, u, Need::NotNegative),
                (None, None) if self.both.contains(&u) => self.need(dag, u, Need::NonZero),
                _ => self.need(dag, u, Need::Positive),
            },
            Math::Call(function, u) => self.call(dag, function, u),
            _ => {}
        }
    }

    fn call(&mut self, dag: &mut Dag, function: Function, u: Id) {
        match function.properties().domain {
            algebra::Domain::All => {}
            algebra::Domain::NotNegative => self.need(dag, u, Need::NotNegative),
            algebra::Domain::Positive => self.need(dag, u, Need::Positive),
            algebra::Domain::NonZero(of) => {
                let divisor = dag.call(of, u);
                self.need(dag, divisor, Need::NonZero);
            }
            algebra::Domain::WithinOne => {
                let range = Interval::of(dag, u);
                let inside = range.low >= -1.0 && range.high <= 1.0;
                if !inside && !self.within_one.contains(&u) {
                    self.within_one.push(u);
                }
            }
        }
    }

    /// Notes that `id` is needed, in its simplest form.
    fn need(&mut self, dag: &Dag, id: Id, need: Need) {
        let range = Interval::of(dag, id);
        if need.holds(range) {
            return;
        }
        // u ≥ 0 is known: only u ≠ 0 is asked
        let need = if need == Need::Positive && range.is_not_negative() {
            Need::NonZero
        } else {
            need
        };
        match (&dag[id], need) {
            (Math::Neg(u), Need::NonZero) => self.need(dag, *u, Need::NonZero),
            (Math::Mul([u, v]), Need::NonZero) => {
                self.need(dag, *u, Need::NonZero);
                self.need(dag, *v, Need::NonZero);
            }
            // the divisor is a condition of its own
            (Math::Div([u, _]), Need::NonZero) => self.need(dag, *u, Need::NonZero),
            (Math::Mul([u, v]) | Math::Div([u, v]), _) => {
                // a factor of known sign is not asked for
                for (known, other) in [(*u, *v), (*v, *u)] {
                    let sign = Interval::of(dag, known);
                    if sign.is_positive() {
                        return self.need(dag, other, need);
                    }
                    if sign.is_not_negative() && need == Need::Positive {
                        self.need(dag, known, Need::NonZero);
                        return self.need(dag, other, need);
                    }
                }
                self.note(id, need);
            }
            (Math::Call(Function::Sqrt, u), Need::NonZero) => self.need(dag, *u, Need::Positive),
            (Math::Pow([u, v]), Need::NonZero) => {
                let integer = dag.as_integer(*v).is_some();
                let need = if integer {
                    Need::NonZero
                } else {
                    Need::Positive
                };
                self.need(dag, *u, need);
            }
            (Math::Pow([u, v]), _) if dag.as_integer(*v).is_some_and(|n| n % 2 != 0) => {
                self.need(dag, *u, need);
            }
            _ => self.note(id, need),
        }
    }

    fn note(&mut self, id: Id, need: Need) {
        let known = self.needs.entry(id).or_insert(need);
        *known = match (*known, need) {
            (a, b) if a == b => a,
            _ => Need::Positive,
        };
    }

    /// In the order in which the arguments were written, without what follows from the rest or
    /// from the `sides`.
    fn finish(self, dag: &mut Dag, sides: &[(Id, Sign)]) -> Domain {
        let mut kept: Vec<(Id, Need)> = Vec::new();
        for (id, need) in self.needs {
            // u > 0 with u ≥ 0 known is u ≠ 0
            let need = if need == Need::Positive && Interval::of(dag, id).is_not_negative() {
                Need::NonZero
            } else {
                need
            };
            match equal_condition(dag, &kept, id, need) {
                Some(index) => {
                    if let Some(known) = kept.get_mut(index)
                        && known.1 != need
                    {
                        known.1 = Need::Positive;
                    }
                }
                None => kept.push((id, need)),
            }
        }
        // what is asked for once does not become part of the model
        let scratch = &mut dag.clone();
        let known = &positive(scratch, sides);
        let contradiction = within::contradiction(scratch, &kept, &self.within_one, known);
        if contradiction.is_some() {
            // they may be about the functions of the sides
            positive(dag, sides);
        }
        let within = self.within_one.into_iter();
        let within: Vec<Id> = within
            .filter(|&u| {
                !is_within_by(dag, &kept, u) && !within::holds_within_one(scratch, u, known)
            })
            .collect();
        let kept = without_consequences(dag, kept);
        let kept = without_multiples(dag, kept);
        let scratch = &mut dag.clone();
        let known = &positive(scratch, sides);
        let kept = within::not_implied(scratch, kept, known);
        let needs = kept.into_iter().map(|(id, need)| need.of(id));
        Domain {
            conditions: needs
                .chain(within.into_iter().map(DomainCondition::WithinOne))
                .collect(),
            contradiction,
        }
    }
}
