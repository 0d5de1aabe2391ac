//! The two ends of a step: what an expression is at its start, at its end and at its midpoint.

use std::collections::HashMap;

use egg::Language;

use super::super::{Dag, Id, Math, Name};

/// `root` at the start of a step: x₀ for every x of `variables`.
pub fn at_start(dag: &mut Dag, root: Id, variables: &[Name]) -> Id {
    let with = variables
        .iter()
        .map(|name| (name.clone(), dag.variable(&name.at_start())))
        .collect();
    dag.substitute(root, &with)
}

/// `root` at the end of a step: x₁ for every x of `variables`.
pub fn at_end(dag: &mut Dag, root: Id, variables: &[Name]) -> Id {
    let with = variables
        .iter()
        .map(|name| (name.clone(), dag.variable(&name.at_end())))
        .collect();
    dag.substitute(root, &with)
}

/// `root` at the midpoint of a step: (x₁ + x₀)/2 for every x of `variables`.
pub fn at_midpoint(dag: &mut Dag, root: Id, variables: &[Name]) -> Id {
    let with = variables
        .iter()
        .map(|name| (name.clone(), variable_mean(dag, name)))
        .collect();
    dag.substitute(root, &with)
}

fn variable_mean(dag: &mut Dag, name: &Name) -> Id {
    let end = dag.variable(&name.at_end());
    let start = dag.variable(&name.at_start());
    dag.mean(end, start)
}

/// The nodes below a root with their images at the two ends of a step.
pub(super) struct Ends {
    /// The nodes that depend on the variables, children before parents.
    pub(super) order: Vec<Id>,
    /// Their values at the start and at the end.
    images: HashMap<Id, [Id; 2]>,
}

impl Ends {
    pub(super) fn new(dag: &mut Dag, root: Id, variables: &[Name]) -> Self {
        let mut ends = Self {
            order: Vec::new(),
            images: HashMap::new(),
        };
        for id in dag.reachable([root]) {
            let node = dag[id].clone();
            let images = match &node {
                Math::Variable(name) if variables.contains(name) => {
                    [dag.variable(&name.at_start()), dag.variable(&name.at_end())]
                }
                _ if node.any(|child| ends.vary(child)) => [0, 1].map(|end| {
                    let at_end = |child| ends.images.get(&child).map_or(child, |ends| ends[end]);
                    dag.rebuild(&node.clone().map_children(at_end))
                }),
                _ => continue,
            };
            ends.order.push(id);
            ends.images.insert(id, images);
        }
        ends
    }

    pub(super) fn vary(&self, id: Id) -> bool {
        self.images.contains_key(&id)
    }

    /// \[u₀, u₁\]
    pub(super) fn of(&self, id: Id) -> [Id; 2] {
        self.images.get(&id).copied().unwrap_or([id, id])
    }
}
