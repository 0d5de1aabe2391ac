//! Extraction: the choice of one node a class, so that the operations under some roots, each
//! counted once, cost as little as a hill-climb can make them.
//!
//! The cost of a DAG is not the sum of the costs of its parts, so that choosing the cheapest
//! node of each class by itself (egg's own extractor) destroys sharing. The climb starts from
//! the expressions as they came and changes the node of one class at a time if that makes the
//! whole cheaper; it ends never worse than it starts. What a change needs that is not computed
//! so far is chosen as trees are, with everything that is computed anyway for nothing.

use std::collections::VecDeque;

use super::table::{Class, Node, Table};
use crate::algebra::Math;

/// Rounds over all classes.
const MOST_ROUNDS: usize = 24;
/// Rounds without a gain before the climb ends. They go sideways, to forms of the same cost.
const MOST_IDLE: usize = 3;

/// Nodes of a class that are tried in one round.
const MOST_TRIALS: usize = 24;

/// Marks what was not chosen.
pub(super) const NOTHING: Node = Node::MAX;

/// The cheaper of two climbs: from the form as it came, `first`, and from the cheapest trees.
pub(super) fn cheapest<'a>(table: &'a Table, roots: &[Class], first: &[Node]) -> Selection<'a> {
    let mut given = Selection::new(table, roots, first);
    given.climb();
    let mut trees = Selection::new(table, roots, &vec![NOTHING; first.len()]);
    trees.climb();
    // trees have no cycle by construction, what came has none unless a rule removed its node
    let sound = roots.iter().all(|&root| given.is_acyclic_from(root));
    if trees.cost < given.cost || !sound {
        trees
    } else {
        given
    }
}

/// A choice of nodes with the number of uses of every class.
#[derive(Clone)]
pub(super) struct Selection<'a> {
    table: &'a Table,
    /// By class: its node, `NOTHING` where it was never chosen.
    chosen: Vec<Node>,
    /// By class: how often a chosen node or a root uses it.
    uses: Vec<u32>,
    cost: u64,
    /// By class: the node that completes a change.
    completion: Vec<Node>,
    /// By class: what that costs at least.
    bound: Vec<u64>,
    /// By class: whether computing it was tried, and did not pay.
    refused: Vec<bool>,
}

impl<'a> Selection<'a> {
    /// The expressions as they came: `first` are the nodes that they were made of.
    pub(super) fn new(table: &'a Table, roots: &[Class], first: &[Node]) -> Self {
        let count = table.classes.len();
        let mut selection = Self {
            table,
            chosen: first.to_vec(),
            uses: vec![0; count],
            cost: 0,
            completion: vec![NOTHING; count],
            bound: vec![u64::MAX; count],
            refused: vec![false; count],
        };
        selection.complete();
        for (completion, &first) in selection.completion.iter_mut().zip(first) {
            if first != NOTHING {
                *completion = first;
            }
        }
        for &root in roots {
            selection.acquire(root);
        }
        selection
    }

    /// The operation chosen for a class, and the classes of its operands.
    pub(super) fn operation(&self, class: Class) -> (&'a Math, &'a [Class]) {
        let node = self.chosen[class];
        (&self.table.nodes[node], &self.table.children[node])
    }

    /// Changes one class at a time as long as that makes the whole cheaper.
    pub(super) fn climb(&mut self) {
        let mut idle = 0;
        for round in 0..MOST_ROUNDS {
            let before = self.cost;
            self.complete();
            for class in 0..self.table.classes.len() {
                if self.uses[class] > 0 {
                    self.improve(class, round, idle > 0);
                }
            }
            self.introduce(round);
            idle = if self.cost == before { idle + 1 } else { 0 };
            if idle > MOST_IDLE {
                break;
            }
        }
    }

    /// The cheapest change of one class, if there is one; `sideways`, one that costs the same.
    /// Of many nodes only some are tried, others the next `round`.
    fn improve(&mut self, class: Class, round: usize, sideways: bool) {
        let old = self.chosen[class];
        let before = self.cost;
        self.release_node(old);
        let without = self.cost;
        let mut best = (before + u64::from(sideways), old);
        let nodes = self.table.classes[class].clone();
        let first = nodes.start + (round * MOST_TRIALS) % nodes.len();
        let mut trials = 0;
        for node in (first..nodes.end).chain(nodes.start..first) {
            if node == old || without + self.least(node) >= best.0 {
                continue;
            }
            trials += 1;
            if trials > MOST_TRIALS {
                break;
            }
            self.chosen[class] = node;
            let log = self.acquire_logged(node);
            if self.cost < best.0 && self.is_acyclic_from(class) {
                best = (self.cost, node);
            }
            self.undo(node, &log);
        }
        self.chosen[class] = best.1;
        self.completion[class] = best.1;
        self.acquire_logged(best.1);
    }

    /// Looks for classes that are not computed, and pay if they are because several others
    /// become cheaper by them: the reciprocal of a divisor that several quotients have.
    fn introduce(&mut self, round: usize) {
        for class in 0..self.table.classes.len() {
            if self.uses[class] > 0 || self.bound[class] == u64::MAX || self.refused[class] {
                continue;
            }
            let (mut saving, mut users) = (0, Vec::new());
            for &(node, user) in &self.table.parents[class] {
                if self.uses[user] > 0 {
                    let others = self.table.children[node].iter();
                    let others = others.filter(|&&other| other != class && self.uses[other] == 0);
                    let own = u64::from(self.table.costs[node]);
                    let new = others.fold(own, |sum, &other| sum.saturating_add(self.bound[other]));
                    let now = self.replaceable(user);
                    if new < now {
                        saving += now - new;
                        users.push(user);
                    }
                }
            }
            if users.len() > 1 && saving > self.bound[class] {
                let before = self.clone();
                self.acquire(class);
                for user in users {
                    // an earlier change may have made it superfluous
                    if self.uses[user] > 0 {
                        self.improve(user, round, false);
                    }
                }
                self.release(vec![class]);
                if self.cost >= before.cost {
                    *self = before;
                    self.refused[class] = true;
                }
            }
        }
    }

    /// The cost of the node of a class, and of those of its operands that nothing else uses.
    fn replaceable(&self, class: Class) -> u64 {
        let cost = |class: Class| u64::from(self.table.costs[self.chosen[class]]);
        let operands = self.table.children[self.chosen[class]].iter();
        let own = operands.filter(|&&operand| self.uses[operand] == 1);
        cost(class) + own.map(|&operand| cost(operand)).sum::<u64>()
    }

    /// What a node costs at least, with what is computed anyway.
    fn least(&self, node: Node) -> u64 {
        let children = &self.table.children[node];
        let dearest = children
            .iter()
            .map(|&child| match self.uses[child] {
                0 => self.bound[child],
                _ => 0,
            })
            .max();
        u64::from(self.table.costs[node]).saturating_add(dearest.unwrap_or(0))
    }

    fn acquire(&mut self, class: Class) {
        self.acquire_class(class, &mut Vec::new());
    }

    /// Acquires the operands of `node`; returns the classes whose choice was a completion, with
    /// the choice before.
    fn acquire_logged(&mut self, node: Node) -> Vec<(Class, Node)> {
        let mut log = Vec::new();
        self.cost += u64::from(self.table.costs[node]);
        for &child in &self.table.children[node] {
            self.acquire_class(child, &mut log);
        }
        log
    }

    fn acquire_class(&mut self, class: Class, log: &mut Vec<(Class, Node)>) {
        let mut stack = vec![class];
        while let Some(class) = stack.pop() {
            self.uses[class] += 1;
            if self.uses[class] > 1 {
                continue;
            }
            if self.completion[class] != NOTHING && self.completion[class] != self.chosen[class] {
                log.push((class, self.chosen[class]));
                self.chosen[class] = self.completion[class];
            }
            let node = self.chosen[class];
            self.cost += u64::from(self.table.costs[node]);
            stack.extend(&self.table.children[node]);
        }
    }

    fn release_node(&mut self, node: Node) {
        self.cost -= u64::from(self.table.costs[node]);
        self.release(self.table.children[node].clone());
    }

    fn release(&mut self, mut stack: Vec<Class>) {
        while let Some(class) = stack.pop() {
            self.uses[class] -= 1;
            if self.uses[class] == 0 {
                let node = self.chosen[class];
                self.cost -= u64::from(self.table.costs[node]);
                stack.extend(&self.table.children[node]);
            }
        }
    }

    fn undo(&mut self, node: Node, log: &[(Class, Node)]) {
        self.release_node(node);
        for &(class, before) in log.iter().rev() {
            self.chosen[class] = before;
        }
    }

    /// Whether no class under `start` is computed from itself.
    fn is_acyclic_from(&self, start: Class) -> bool {
        // 0: not seen, 1: being computed, 2: computed
        let mut state = vec![0_u8; self.table.classes.len()];
        let mut stack = vec![(start, false)];
        while let Some((class, done)) = stack.pop() {
            if done {
                state[class] = 2;
                continue;
            }
            match state[class] {
                1 => return false,
                2 => continue,
                _ => {}
            }
            state[class] = 1;
            stack.push((class, true));
            for &child in &self.table.children[self.chosen[class]] {
                match state[child] {
                    0 => stack.push((child, false)),
                    1 => return false,
                    _ => {}
                }
            }
        }
        true
    }

    /// The cheapest tree of every class, with what is computed anyway for nothing.
    fn complete(&mut self) {
        let mut queue = VecDeque::new();
        for class in 0..self.table.classes.len() {
            let computed = self.uses[class] > 0;
            self.bound[class] = if computed { 0 } else { u64::MAX };
            self.completion[class] = if computed {
                self.chosen[class]
            } else {
                NOTHING
            };
            if computed {
                queue.push_back(class);
            }
        }
        for (node, children) in self.table.children.iter().enumerate() {
            if children.is_empty() {
                let class = self.owner(node);
                self.lower_bound(class, node, &mut queue);
            }
        }
        while let Some(class) = queue.pop_front() {
            for index in 0..self.table.parents[class].len() {
                let (node, parent) = self.table.parents[class][index];
                self.lower_bound(parent, node, &mut queue);
            }
        }
    }

    fn owner(&self, node: Node) -> Class {
        self.table
            .classes
            .partition_point(|nodes| nodes.end <= node)
    }

    fn lower_bound(&mut self, class: Class, node: Node, queue: &mut VecDeque<Class>) {
        let own = u64::from(self.table.costs[node]);
        let bound = self.table.children[node]
            .iter()
            .fold(own, |sum, &child| sum.saturating_add(self.bound[child]));
        if bound < self.bound[class] {
            self.bound[class] = bound;
            self.completion[class] = node;
            queue.push_back(class);
        }
    }
}
