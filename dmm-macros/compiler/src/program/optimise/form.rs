//! The form of some functions: their operations without the names of its variables. Regions that
//! differ in their parameters only have the same form, and are optimised once.

use std::collections::BTreeSet;

use egg::{Id, Language};
use rustc_hash::FxHashMap;

use super::Source;
use super::constants::Constants;
use super::operation::{Operation, Symbol};
use crate::algebra::{Dag, Math};

/// Operations with anonymous leaves; children are numbers of nodes, and come first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Form {
    /// The operations.
    pub(super) nodes: Vec<Operation>,
    /// The constants in them.
    pub(super) constants: Constants,
}

/// The results of every function, as numbers of nodes.
pub(super) type Results = Vec<Vec<Id>>;

impl Form {
    /// The form of some `functions` of `source`, their results, and what its leaves stand
    /// for; what is already `made` is a leaf.
    pub(super) fn new(
        source: &Source<'_>,
        functions: &[Vec<Id>],
        made: &FxHashMap<Id, Id>,
    ) -> (Self, Results, Vec<Id>) {
        let mut leaves = Vec::new();
        let mut numbers: FxHashMap<Id, Id> = FxHashMap::default();
        let mut nodes = Vec::new();
        let mut constants = Constants::new();
        for id in reachable(source, functions, made) {
            let node = &source.dag[id];
            let symbol = match node {
                _ if is_leaf(source, id, made) => None,
                Math::Constant(value) => Some(Symbol::Constant(constants.number(value))),
                node => Symbol::of(node),
            };
            let operation = match symbol {
                Some(symbol) => {
                    let operands: Vec<Id> =
                        node.children().iter().map(|child| numbers[child]).collect();
                    Operation::new(symbol, &operands)
                }
                None => {
                    let number = leaves.len() as u32;
                    leaves.push(id);
                    let fixed = (source.is_fixed)(id);
                    let kind = if fixed {
                        Symbol::Fixed
                    } else {
                        Symbol::Varying
                    };
                    Operation::new(kind(number), &[])
                }
            };
            numbers.insert(id, Id::from(nodes.len()));
            nodes.push(operation);
        }
        let results = functions
            .iter()
            .map(|roots| roots.iter().map(|root| numbers[root]).collect())
            .collect();
        (Self { nodes, constants }, results, leaves)
    }
}

/// The nodes of `functions`, children before parents, without what is below leaves.
pub(super) fn reachable(
    source: &Source<'_>,
    functions: &[Vec<Id>],
    made: &FxHashMap<Id, Id>,
) -> BTreeSet<Id> {
    let mut reached = BTreeSet::new();
    let mut stack = functions.concat();
    while let Some(id) = stack.pop() {
        if reached.insert(id) && !is_leaf(source, id, made) {
            source.dag[id].for_each(|child| stack.push(child));
        }
    }
    reached
}

fn is_leaf(source: &Source<'_>, id: Id, made: &FxHashMap<Id, Id>) -> bool {
    is_atom(source, id) || (made.contains_key(&id) && !source.dag[id].is_leaf())
}

/// Whether a node is not looked into: on demand, or because it is stored. Signs and constant
/// factors of what is stored combine with what is around them.
pub(super) fn is_atom(source: &Source<'_>, id: Id) -> bool {
    let of_leaf = |dag: &Dag, id: Id| dag[id].is_leaf();
    let transparent = match &source.dag[id] {
        Math::Constant(_) | Math::Neg(_) => true,
        Math::Mul([a, b]) => source.dag.as_constant(*a).is_some() && of_leaf(source.dag, *b),
        _ => false,
    };
    (source.is_atom)(id) || ((source.is_fixed)(id) && !transparent)
}
