//! A choice of nodes that knows its cost, and takes changes back.

use super::operation::Operation;
use super::table::{Class, Node, Table};

/// Marks what was not chosen.
pub(super) const NOTHING: Node = Node::MAX;

/// A choice of nodes with the number of uses of every class.
pub(super) struct Selection<'a> {
    pub(super) table: &'a Table,
    /// By class: its node, `NOTHING` where it was never chosen.
    pub(super) chosen: Vec<Node>,
    /// By class: how often a chosen node or a root uses it.
    pub(super) uses: Vec<u32>,
    pub(super) cost: u64,
    /// By class: the node that completes a change.
    pub(super) completion: Vec<Node>,
    /// By class: what that costs at least.
    pub(super) bound: Vec<u64>,
    /// By class: whether computing it was tried, and did not lower the cost.
    pub(super) refused: Vec<bool>,
    /// What was done since it began to matter, for taking it back.
    pub(super) log: Vec<Change>,
    /// By class: the search for a cycle that saw it last, twice its number, and 1 more when
    /// everything below it was seen.
    seen: Vec<u32>,
    searches: u32,
    stack: Vec<Class>,
}

/// A change of a selection.
#[derive(Clone, Copy)]
pub(super) enum Change {
    /// A class has one use more.
    Used(Class),
    /// A class has one use less.
    Released(Class),
    /// A class had another node.
    Chosen(Class, Node),
    /// A class had another completion.
    Completed(Class, Node),
}

/// A state of a selection to go back to.
#[derive(Clone, Copy)]
pub(super) struct Mark {
    changes: usize,
    pub(super) cost: u64,
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
            log: Vec::new(),
            seen: vec![0; count],
            searches: 0,
            stack: Vec::new(),
        };
        selection.complete();
        for (completion, &first) in selection.completion.iter_mut().zip(first) {
            if first != NOTHING {
                *completion = first;
            }
        }
        for &root in roots {
            selection.acquire(root, u64::MAX);
        }
        selection
    }

    /// The cheaper of two selections for `roots`, the second where the first is not sound:
    /// trees have no cycle by construction, what came has none unless a rule removed its node.
    pub(super) fn or(mut self, mut other: Self, roots: &[Class]) -> Self {
        let is_sound = |selection: &mut Self| {
            let mut roots = roots.iter();
            roots.all(|&root| selection.is_acyclic_from(root))
        };
        let other_is_better = other.cost < self.cost && is_sound(&mut other);
        if other_is_better || !is_sound(&mut self) {
            other
        } else {
            self
        }
    }

    /// By class: the node that is computed, that of `others` where none is.
    pub(super) fn nodes_or(&self, others: &[Node]) -> Vec<Node> {
        let chosen = self.chosen.iter().zip(&self.uses);
        let nodes = chosen
            .zip(others)
            .map(|((&own, &uses), &other)| match uses {
                0 => other,
                _ => own,
            });
        nodes.collect()
    }

    /// The operation chosen for a class, and the classes of its operands.
    pub(super) fn operation(&self, class: Class) -> (Operation, impl Iterator<Item = Class>) {
        let node = self.chosen[class];
        (self.table.nodes[node], self.table.children(node))
    }

    pub(super) fn mark(&self) -> Mark {
        Mark {
            changes: self.log.len(),
            cost: self.cost,
        }
    }

    /// Takes back everything since `mark`.
    pub(super) fn undo(&mut self, mark: Mark) {
        while self.log.len() > mark.changes {
            match self.log.pop() {
                Some(Change::Used(class)) => self.uses[class] -= 1,
                Some(Change::Released(class)) => self.uses[class] += 1,
                Some(Change::Chosen(class, node)) => self.chosen[class] = node,
                Some(Change::Completed(class, node)) => self.completion[class] = node,
                None => break,
            }
        }
        self.cost = mark.cost;
    }

    pub(super) fn choose(&mut self, class: Class, node: Node) {
        self.log.push(Change::Chosen(class, self.chosen[class]));
        self.chosen[class] = node;
    }

    /// Computes `node`, unless the whole then costs `most` or more; whether that is done.
    pub(super) fn acquire_node(&mut self, node: Node, most: u64) -> bool {
        self.cost += u64::from(self.table.costs[node]);
        let table = self.table;
        for &operand in table.operands[node].all() {
            if self.cost >= most || !self.acquire(operand, most) {
                return false;
            }
        }
        self.cost < most
    }

    /// Computes `class`, unless the whole then costs `most` or more; whether that is done.
    pub(super) fn acquire(&mut self, class: Class, most: u64) -> bool {
        let table = self.table;
        let mut stack = std::mem::take(&mut self.stack);
        stack.push(class);
        while let Some(class) = stack.pop() {
            self.uses[class] += 1;
            self.log.push(Change::Used(class));
            if self.uses[class] > 1 {
                continue;
            }
            let completion = self.completion[class];
            if completion != NOTHING && completion != self.chosen[class] {
                self.choose(class, completion);
            }
            let node = self.chosen[class];
            self.cost += u64::from(table.costs[node]);
            if self.cost >= most {
                break;
            }
            stack.extend_from_slice(table.operands[node].all());
        }
        stack.clear();
        self.stack = stack;
        self.cost < most
    }

    pub(super) fn release_node(&mut self, node: Node) {
        self.cost -= u64::from(self.table.costs[node]);
        let table = self.table;
        for &operand in table.operands[node].all() {
            self.release(operand);
        }
    }

    pub(super) fn release(&mut self, class: Class) {
        let table = self.table;
        let mut stack = std::mem::take(&mut self.stack);
        stack.push(class);
        while let Some(class) = stack.pop() {
            self.uses[class] -= 1;
            self.log.push(Change::Released(class));
            if self.uses[class] == 0 {
                let node = self.chosen[class];
                self.cost -= u64::from(table.costs[node]);
                stack.extend_from_slice(table.operands[node].all());
            }
        }
        self.stack = stack;
    }

    /// Whether no class under `start` is computed from itself.
    pub(super) fn is_acyclic_from(&mut self, start: Class) -> bool {
        self.searches += 1;
        let (open, done) = (2 * self.searches, 2 * self.searches + 1);
        let table = self.table;
        let mut stack = std::mem::take(&mut self.stack);
        stack.push(start);
        let mut acyclic = true;
        'search: while let Some(&class) = stack.last() {
            if self.seen[class] >= open {
                // either everything below it was just seen, or it was stacked twice
                self.seen[class] = done;
                stack.pop();
                continue;
            }
            self.seen[class] = open;
            for &operand in table.operands[self.chosen[class]].all() {
                if self.seen[operand] == open {
                    acyclic = false;
                    break 'search;
                }
                if self.seen[operand] != done {
                    stack.push(operand);
                }
            }
        }
        stack.clear();
        self.stack = stack;
        acyclic
    }
}
