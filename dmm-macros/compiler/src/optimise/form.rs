//! The form of a program: its operations without the names of its variables. Regions that
//! differ in their parameters only have the same form, and are optimised once.

use std::collections::{BTreeSet, HashMap};

use egg::{Id, Language};

use super::Program;
use crate::algebra::{Dag, Math, Name};

/// Operations with anonymous leaves; children are numbers of nodes, and come first.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct Form {
    /// The operations.
    pub(super) nodes: Vec<Math>,
    /// The results of every function, as numbers of nodes.
    pub(super) functions: Vec<Vec<Id>>,
}

/// The names of leaves: what depends on parameters alone, and what does not.
const FIXED: &str = "fixed ";
const VARYING: &str = "varying ";

/// Whether a leaf of a form depends on parameters alone.
pub(super) fn is_fixed_leaf(name: &Name) -> bool {
    name.as_str().starts_with(FIXED)
}

impl Form {
    /// The form of some `functions` of `program`, and what its leaves stand for; what is
    /// already `made` is a leaf.
    pub(super) fn new(
        program: &Program<'_>,
        functions: &[Vec<Id>],
        made: &HashMap<Id, Id>,
    ) -> (Self, HashMap<Name, Id>) {
        let mut leaves = HashMap::new();
        let mut numbers: HashMap<Id, Id> = HashMap::new();
        let mut nodes = Vec::new();
        for id in reachable(program, functions, made) {
            let node = &program.dag[id];
            let leaf = matches!(node, Math::Variable(_)) || is_leaf(program, id, made);
            let node = if leaf {
                let kind = if (program.is_fixed)(id) {
                    FIXED
                } else {
                    VARYING
                };
                let name = Name::new(&format!("{kind}{}", nodes.len()));
                leaves.insert(name.clone(), id);
                Math::Variable(name)
            } else {
                node.clone().map_children(|child| numbers[&child])
            };
            numbers.insert(id, Id::from(nodes.len()));
            nodes.push(node);
        }
        let functions = functions
            .iter()
            .map(|roots| roots.iter().map(|root| numbers[root]).collect())
            .collect();
        (Self { nodes, functions }, leaves)
    }
}

/// The nodes of `functions`, children before parents, without what is below leaves.
pub(super) fn reachable(
    program: &Program<'_>,
    functions: &[Vec<Id>],
    made: &HashMap<Id, Id>,
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

fn is_leaf(program: &Program<'_>, id: Id, made: &HashMap<Id, Id>) -> bool {
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
