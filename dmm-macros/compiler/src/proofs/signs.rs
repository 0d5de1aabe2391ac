//! Powers u^k with an exponent that is a parameter: both signs of u.
//!
//! The normal form takes u^k for exp(k ln u), so that a proof holds where u > 0. Code has a value
//! also where u < 0 and every such exponent is an integer. There
//!
//! ```text
//! u^k = (−1)^k (−u)^k,      (−1)^k = 1 or −1,
//! ```
//!
//! and what is to be proved is proved once more for every combination of signs of bases and of
//! even and odd exponents, with −u in the place of u. Exponents that differ by an integer, or by
//! integer multiples of others, have parities that follow from these.

use std::collections::{BTreeSet, HashMap};

use egg::Language;

use super::conditions::domain;
use super::place::decide;
use super::{Place, Variables};
use crate::algebra::evaluate::Interval;
use crate::algebra::{Dag, Function, Id, Math, Name, Verdict, normalise};
use crate::model::positive;

/// Bases of which every combination of signs is tried.
const MOST_BASES: usize = 3;
/// Exponents of which every combination of parities is tried.
const MOST_EXPONENTS: usize = 3;

/// The bases of powers of `roots`, where `residual` is proved to be zero for positive ones, that
/// may be negative as well.
pub(super) fn on_both_sides(
    dag: &mut Dag,
    variables: &Variables,
    place: &Place<'_>,
    residual: Id,
    roots: &[Id],
) -> BTreeSet<Id> {
    let powers = powers(dag, variables, roots);
    let mut bases: Vec<Id> = powers.iter().map(|&(base, _)| base).collect();
    bases.sort_unstable();
    bases.dedup();
    let none = BTreeSet::new();
    let all: BTreeSet<Id> = bases.iter().copied().collect();
    if all.is_empty() || bases.len() > MOST_BASES || !widens(dag, place, roots, &none, &all) {
        return none;
    }
    let exponents: Vec<Id> = powers.iter().map(|&(_, exponent)| exponent).collect();
    let Some(parities) = Parities::of(dag, &exponents) else {
        return none;
    };
    let problem = Problem {
        variables,
        place,
        residual,
        roots,
        parities,
    };
    if problem.is_proved(dag, &bases) {
        return all;
    }
    let mut found = BTreeSet::new();
    for &base in &bases {
        let with: BTreeSet<Id> = found.iter().copied().chain([base]).collect();
        let together: Vec<Id> = with.iter().copied().collect();
        if widens(dag, place, roots, &found, &with) && problem.is_proved(dag, &together) {
            found = with;
        }
    }
    found
}

/// The powers in `roots` whose exponent is made of parameters, and whose base may be negative.
fn powers(dag: &Dag, variables: &Variables, roots: &[Id]) -> Vec<(Id, Id)> {
    let is_parameter = |name: &Name| variables.parameters.iter().any(|(other, _)| other == name);
    let mut powers = Vec::new();
    for id in dag.reachable(roots.iter().copied()) {
        if let Math::Pow([base, exponent]) = dag[id]
            && dag.as_constant(exponent).is_none()
            && dag.variables([exponent]).iter().all(is_parameter)
            && !Interval::of(dag, base).is_not_negative()
        {
            powers.push((base, exponent));
        }
    }
    powers
}

/// Whether `roots` are defined at more points if the bases `with` may be negative, and not only
/// those `without`.
fn widens(
    dag: &mut Dag,
    place: &Place<'_>,
    roots: &[Id],
    without: &BTreeSet<Id>,
    with: &BTreeSet<Id>,
) -> bool {
    let narrow = domain(dag, roots, &place.sides, without);
    let wide = domain(dag, roots, &place.sides, with);
    wide.contradiction.is_none() && narrow.conditions != wide.conditions
}

/// Whether `roots` have values nowhere where `sides` are positive.
fn is_empty(dag: &mut Dag, roots: &[Id], sides: &[Id]) -> bool {
    let logarithms = sides.iter().map(|&side| dag.call(Function::Ln, side));
    let logarithms: Vec<Id> = logarithms.collect();
    let roots: Vec<Id> = roots.iter().copied().chain(logarithms).collect();
    let domain = domain(dag, &roots, &[], &BTreeSet::new());
    domain.contradiction.is_some()
}

/// The parities of exponents: c + Σ mᵢ kᵢ with integers c and mᵢ, and exponents kᵢ whose parities
/// are tried.
struct Parities {
    independent: usize,
    /// By exponent: whether c is odd, and which mᵢ are.
    odd: HashMap<Id, (bool, Vec<bool>)>,
}

impl Parities {
    fn of(dag: &mut Dag, exponents: &[Id]) -> Option<Self> {
        let mut exponents = exponents.to_vec();
        exponents.sort_by_key(|&id| (dag.tree_size(id), id));
        exponents.dedup();
        let mut independent: Vec<Id> = Vec::new();
        let mut odd = HashMap::new();
        for exponent in exponents {
            let known = match combination(dag, exponent, &independent) {
                Some(known) => known,
                None => {
                    independent.push(exponent);
                    let own = (0..independent.len()).map(|index| index + 1 == independent.len());
                    (false, own.collect())
                }
            };
            odd.insert(exponent, known);
        }
        (independent.len() <= MOST_EXPONENTS).then_some(Self {
            independent: independent.len(),
            odd,
        })
    }

    /// Whether an exponent is odd if the independent ones are those in `choice`, bit by bit.
    fn is_odd(&self, exponent: Id, choice: usize) -> Option<bool> {
        let (constant, multiples) = self.odd.get(&exponent)?;
        let odd = multiples.iter().enumerate();
        let odd = odd.filter(|&(index, &odd)| odd && choice >> index & 1 == 1);
        Some(*constant != (odd.count() % 2 == 1))
    }
}

/// The exponent as c + Σ mᵢ kᵢ: whether c is odd, and which mᵢ are.
fn combination(dag: &mut Dag, exponent: Id, independent: &[Id]) -> Option<(bool, Vec<bool>)> {
    const MULTIPLES: [i64; 5] = [0, 1, -1, 2, -2];
    let count = MULTIPLES
        .len()
        .checked_pow(u32::try_from(independent.len()).ok()?)?;
    if independent.len() > MOST_EXPONENTS {
        return None;
    }
    for mut number in 0..count {
        let mut rest = exponent;
        let mut odd = Vec::new();
        for &other in independent {
            let multiple = MULTIPLES.get(number % MULTIPLES.len()).copied()?;
            number /= MULTIPLES.len();
            let factor = dag.integer(multiple);
            let product = dag.mul(factor, other);
            rest = dag.sub(rest, product);
            odd.push(multiple % 2 != 0);
        }
        let constant = normalise(dag, rest).and_then(|rest| dag.as_integer(rest));
        if let Some(constant) = constant {
            return Some((constant % 2 != 0, odd));
        }
    }
    None
}

/// What is to be proved for bases of both signs.
struct Problem<'a> {
    variables: &'a Variables,
    place: &'a Place<'a>,
    residual: Id,
    roots: &'a [Id],
    parities: Parities,
}

impl Problem<'_> {
    /// Whether the residual is zero for every combination of signs of `bases`, at least one of
    /// which is negative, and of parities.
    fn is_proved(&self, dag: &mut Dag, bases: &[Id]) -> bool {
        let signs = 1_usize << bases.len();
        let parities = 1_usize << self.parities.independent;
        (1..signs).all(|signs| {
            let negative: Vec<Id> = (bases.iter().enumerate())
                .filter(|(index, _)| signs >> index & 1 == 1)
                .map(|(_, &base)| base)
                .collect();
            (0..parities).all(|choice| self.is_proved_for(dag, &negative, choice))
        })
    }

    /// Whether it is zero where the bases `negative` are, for one choice of parities.
    fn is_proved_for(&self, dag: &mut Dag, negative: &[Id], choice: usize) -> bool {
        let turn = |dag: &mut Dag, root: Id| self.turned(dag, root, negative, choice);
        let Some(residual) = turn(dag, self.residual) else {
            return false;
        };
        let mut roots = Vec::new();
        let mut sides = Vec::new();
        let given = positive(dag, &self.place.sides);
        for (&root, target) in
            (self.roots.iter().map(|root| (root, 0))).chain(given.iter().map(|side| (side, 1)))
        {
            let Some(turned) = turn(dag, root) else {
                return false;
            };
            match target {
                0 => roots.push(turned),
                _ => sides.push(turned),
            }
        }
        // the bases are negative, whether or not a power that says so is left
        for &base in negative {
            let Some(base) = turn(dag, base) else {
                return false;
            };
            sides.push(dag.neg(base));
        }
        is_empty(dag, &roots, &sides)
            || decide(dag, self.variables, residual, &roots, &sides) == Verdict::Proved
    }

    /// `root` with (−1)^k (−u)^k for u^k of the bases `negative`.
    fn turned(&self, dag: &mut Dag, root: Id, negative: &[Id], choice: usize) -> Option<Id> {
        let mut image: HashMap<Id, Id> = HashMap::new();
        for id in dag.reachable([root]) {
            let node = dag[id].clone();
            let new = match node {
                Math::Pow([base, exponent])
                    if negative.contains(&base) && dag.as_constant(exponent).is_none() =>
                {
                    let is_odd = self.parities.is_odd(exponent, choice)?;
                    let base = image.get(&base).copied()?;
                    let opposite = dag.neg(base);
                    let power = dag.pow(opposite, exponent);
                    if is_odd { dag.neg(power) } else { power }
                }
                _ => {
                    let mut complete = true;
                    let node = node.map_children(|child| {
                        let known = image.get(&child).copied();
                        complete &= known.is_some();
                        known.unwrap_or(child)
                    });
                    if !complete {
                        return None;
                    }
                    dag.rebuild(&node)
                }
            };
            image.insert(id, new);
        }
        image.get(&root).copied()
    }
}
