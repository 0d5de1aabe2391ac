//! The form of a program: its operations without the names of its variables. Regions that
//! differ in their parameters only have the same form, and are optimised once.

use std::collections::{BTreeSet, HashMap};

use egg::{Id, Language};

use super::Program;
use super::constants::Constants;
use super::operation::{Operation, Symbol};
use crate::algebra::{BuildQuick, Dag, Math};

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
    /// The form of some `functions` of `program`, their results, and what its leaves stand
    /// for; what is already `made` is a leaf.
    pub(super) fn new(
        program: &Program<'_>,
        functions: &[Vec<Id>],
        made: &HashMap<Id, Id, BuildQuick>,
    ) -> (Self, Results, Vec<Id>) {
        let mut leaves = Vec::new();
        let mut numbers: HashMap<Id, Id, BuildQuick> = HashMap::default();
        let mut nodes = Vec::new();
        let mut constants = Constants::new();
        for id in reachable(program, functions, made) {
            let node = &program.dag[id];
            let symbol = match node {
                _ if is_leaf(program, id, made) => None,
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
                    let fixed = (program.is_fixed)(id);
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
    program: &Program<'_>,
    functions: &[Vec<Id>],
    made: &HashMap<Id, Id, BuildQuick>,
) -> BTreeSet<Id> {
    let mut reached = BTreeSet::new();
    let mut stack = functions.concat();
    while let Some(id) = stack.pop() {
        if reached.insert(id) && !is_leaf(program, id, made) {
            program.dag[id].for_each(|child| stack.push(child));
        }
    }
    reached
}

fn is_leaf(program: &Program<'_>, id: Id, made: &HashMap<Id, Id, BuildQuick>) -> bool {
    is_atom(program, id) || (made.contains_key(&id) && !program.dag[id].is_leaf())
}

/// Whether a node is not looked into: on demand, or because it is computed once a flow. Signs
/// and constant factors of what is computed once combine with what is around them.
pub(super) fn is_atom(program: &Program<'_>, id: Id) -> bool {
    let of_leaf = |dag: &Dag, id: Id| dag[id].is_leaf();
    let transparent = match &program.dag[id] {
        Math::Constant(_) | Math::Neg(_) => true,
        Math::Mul([a, b]) => program.dag.as_constant(*a).is_some() && of_leaf(program.dag, *b),
        _ => false,
    };
    (program.is_atom)(id) || ((program.is_fixed)(id) && !transparent)
}
