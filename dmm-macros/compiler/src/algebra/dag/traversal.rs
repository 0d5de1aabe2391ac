//! What a root is made of: its nodes, variables and size, and substitution.

use std::collections::HashMap;

use egg::{Id, Language};

use super::super::language::{Math, Name};
use super::Dag;

impl Dag {
    /// The nodes that `roots` are made of, each once, children before parents.
    pub fn reachable(&self, roots: impl IntoIterator<Item = Id>) -> Vec<Id> {
        let mut seen = vec![false; self.nodes.len()];
        let mut stack: Vec<Id> = roots.into_iter().collect();
        let mut reached = Vec::new();
        while let Some(id) = stack.pop() {
            if !std::mem::replace(&mut seen[usize::from(id)], true) {
                reached.push(id);
                self[id].for_each(|child| stack.push(child));
            }
        }
        reached.sort_unstable();
        reached
    }

    /// The number of nodes of `root` written out as a tree, `usize::MAX` if it is larger.
    pub fn tree_size(&self, root: Id) -> usize {
        let mut sizes: HashMap<Id, usize> = HashMap::new();
        for id in self.reachable([root]) {
            let size = self[id].fold(1_usize, |size, child| {
                size.saturating_add(sizes.get(&child).copied().unwrap_or(1))
            });
            sizes.insert(id, size);
        }
        sizes.get(&root).copied().unwrap_or(1)
    }

    /// The variables that `roots` depend on, in the order of their names.
    pub fn variables(&self, roots: impl IntoIterator<Item = Id>) -> Vec<Name> {
        let mut names: Vec<Name> = self
            .reachable(roots)
            .into_iter()
            .filter_map(|id| match &self[id] {
                Math::Variable(name) => Some(name.clone()),
                _ => None,
            })
            .collect();
        names.sort();
        names
    }

    /// Whether `root` depends on the variable `name`.
    pub fn depends_on(&self, root: Id, name: &Name) -> bool {
        self.reachable([root])
            .into_iter()
            .any(|id| matches!(&self[id], Math::Variable(variable) if variable == name))
    }

    /// Rebuilds `root` with the variables in `with` replaced, through the constructors.
    pub fn substitute(&mut self, root: Id, with: &HashMap<Name, Id>) -> Id {
        let mut image: HashMap<Id, Id> = HashMap::new();
        for id in self.reachable([root]) {
            let node = self[id].clone();
            let new = match &node {
                Math::Variable(name) => with.get(name).copied().unwrap_or(id),
                _ => self.rebuild(&node.map_children(|child| image[&child])),
            };
            image.insert(id, new);
        }
        image[&root]
    }

    /// `root` with the part that `parts` names of some of its nodes replaced there by what `replace`
    /// makes of it.
    pub fn with_parts(
        &mut self,
        root: Id,
        parts: &HashMap<Id, Id>,
        mut replace: impl FnMut(&mut Self, Id) -> Id,
    ) -> Id {
        let mut image: HashMap<Id, Id> = HashMap::new();
        for id in self.reachable([root]) {
            let node = self[id].clone();
            let part = parts.get(&id).map(|part| (*part, image[part]));
            if let Some((part, known)) = part {
                image.insert(part, replace(self, known));
            }
            let new = self.rebuild(&node.map_children(|child| image[&child]));
            image.extend(part);
            image.insert(id, new);
        }
        image[&root]
    }

    /// Adds `node` through the constructor of its operation.
    pub fn rebuild(&mut self, node: &Math) -> Id {
        match *node {
            Math::Add([a, b]) => self.add(a, b),
            Math::Sub([a, b]) => self.sub(a, b),
            Math::Mul([a, b]) => self.mul(a, b),
            Math::Div([a, b]) => self.div(a, b),
            Math::Neg(a) => self.neg(a),
            Math::Pow([a, b]) => self.pow(a, b),
            Math::Call(function, a) => self.call(function, a),
            Math::Pair(function, [a, b]) => self.pair(function, a, b),
            Math::Pi | Math::Constant(_) | Math::Variable(_) => self.insert(node.clone()),
        }
    }
}
