//! Extraction: the choice of one node a class, so that the operations under some roots, each
//! counted once, cost as little as a hill-climb can make them.
//!
//! The cost of a DAG is not the sum of the costs of its parts, so that choosing the cheapest
//! node of each class by itself (egg's own extractor) destroys sharing. The climb starts from
//! the expressions as they came and changes the node of one class at a time if that makes the
//! whole cheaper; it ends never worse than it starts. What a change needs that is not computed
//! so far is chosen as trees are, with everything that is computed anyway for nothing.
//!
//! A change is tried by computing what it needs, as long as that costs less than the best so
//! far, and taken back from a log: this is the innermost loop of the optimiser.

use std::collections::VecDeque;

use super::selection::{Change, NOTHING, Selection};
use super::table::{Class, Node, Table};

/// Rounds over all classes.
const MOST_ROUNDS: usize = 16;

/// Rounds without a gain before the climb ends. They go sideways, to forms of the same cost.
const MOST_IDLE: usize = 2;

/// Nodes of a class that are tried in one round.
const MOST_TRIALS: usize = 24;

/// A cheap choice for the results of every function. The climb starts from the form as it came,
/// `first`, from the cheapest trees, and for results that are among those of another function,
/// as f^τ is among what is computed with its Jacobian, from what was found for that.
pub(super) fn cheapest<'a>(
    table: &'a Table,
    functions: &[Vec<Class>],
    first: &[Node],
) -> Vec<Selection<'a>> {
    let of_nothing = vec![NOTHING; first.len()];
    let mut found: Vec<Selection<'a>> = Vec::new();
    for roots in functions {
        let given = Selection::climbed(table, roots, first);
        let trees = Selection::climbed(table, roots, &of_nothing);
        found.push(given.or(trees, roots));
    }
    for (index, roots) in functions.iter().enumerate() {
        let larger = functions.iter().zip(&found).find(|(others, _)| {
            others.len() > roots.len() && roots.iter().all(|root| others.contains(root))
        });
        if let Some((_, larger)) = larger {
            let start = larger.nodes_or(first);
            let seeded = Selection::climbed(table, roots, &start);
            let own = found.remove(index);
            found.insert(index, own.or(seeded, roots));
        }
    }
    found
}

impl<'a> Selection<'a> {
    /// The result of a climb from the nodes `first`.
    fn climbed(table: &'a Table, roots: &[Class], first: &[Node]) -> Self {
        let mut selection = Self::new(table, roots, first);
        selection.climb();
        selection
    }

    /// Changes one class at a time as long as that makes the whole cheaper.
    pub(super) fn climb(&mut self) {
        let mut idle = 0;
        for round in 0..MOST_ROUNDS {
            let before = self.cost;
            self.complete();
            let count = self.table.classes.len();
            for index in 0..count {
                // results first, and from both ends in turns: what is gained at one end is
                // often made possible at the other
                let class = if round % 2 == 0 {
                    count - 1 - index
                } else {
                    index
                };
                if self.uses[class] > 0 {
                    self.log.clear();
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
        let nodes = self.table.classes[class].clone();
        if nodes.len() < 2 {
            return;
        }
        let old = self.chosen[class];
        let start = self.mark();
        self.release_node(old);
        let without = self.mark();
        let mut best = (start.cost + u64::from(sideways), old);
        let mut node = nodes.start + (round * MOST_TRIALS) % nodes.len();
        let mut trials = 0;
        for _ in 0..nodes.len() {
            if node != old && without.cost + self.least(node) < best.0 {
                trials += 1;
                if trials > MOST_TRIALS {
                    break;
                }
                self.choose(class, node);
                if self.acquire_node(node, best.0) && self.is_acyclic_from(class) {
                    best = (self.cost, node);
                }
                self.undo(without);
            }
            node += 1;
            if node == nodes.end {
                node = nodes.start;
            }
        }
        if best.1 == old {
            self.undo(start);
        } else {
            self.choose(class, best.1);
            self.log
                .push(Change::Completed(class, self.completion[class]));
            self.completion[class] = best.1;
            self.acquire_node(best.1, u64::MAX);
        }
    }

    /// Looks for classes that are not computed and lower the cost if they are, because several
    /// others become cheaper by them: the reciprocal of a divisor that several quotients have.
    fn introduce(&mut self, round: usize) {
        for class in 0..self.table.classes.len() {
            if self.uses[class] > 0 || self.bound[class] == u64::MAX || self.refused[class] {
                continue;
            }
            let users = self.gaining(class);
            if users.is_empty() {
                continue;
            }
            self.log.clear();
            let before = self.mark();
            self.acquire(class, u64::MAX);
            for user in users {
                // an earlier change may have made it superfluous
                if self.uses[user] > 0 {
                    self.improve(user, round, false);
                }
            }
            self.release(class);
            if self.cost >= before.cost {
                self.undo(before);
                self.refused[class] = true;
            }
        }
    }

    /// The classes that become cheaper if `class` is computed, provided that this lowers the cost.
    fn gaining(&self, class: Class) -> Vec<Class> {
        let (mut saving, mut users) = (0, Vec::new());
        for &(node, user) in &self.table.parents[class] {
            if self.uses[user] == 0 {
                continue;
            }
            let mut new = u64::from(self.table.costs[node]);
            for &other in self.table.operands[node].all() {
                if other != class && self.uses[other] == 0 {
                    new = new.saturating_add(self.bound[other]);
                }
            }
            let now = self.replaceable(user);
            if new < now {
                saving += now - new;
                users.push(user);
            }
        }
        if users.len() < 2 || saving <= self.bound[class] {
            users.clear();
        }
        users
    }

    /// The cost of the node of a class, and of those of its operands that nothing else uses.
    fn replaceable(&self, class: Class) -> u64 {
        let node = self.chosen[class];
        let mut cost = u64::from(self.table.costs[node]);
        for &operand in self.table.operands[node].all() {
            if self.uses[operand] == 1 {
                cost += u64::from(self.table.costs[self.chosen[operand]]);
            }
        }
        cost
    }

    /// What a node costs at least, with what is computed anyway.
    fn least(&self, node: Node) -> u64 {
        let mut dearest = 0;
        for &operand in self.table.operands[node].all() {
            if self.uses[operand] == 0 && self.bound[operand] > dearest {
                dearest = self.bound[operand];
            }
        }
        u64::from(self.table.costs[node]).saturating_add(dearest)
    }

    /// The cheapest tree of every class, with what is computed anyway for nothing.
    pub(super) fn complete(&mut self) {
        let table = self.table;
        let mut queue = VecDeque::new();
        for class in 0..table.classes.len() {
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
        for (class, nodes) in table.classes.iter().enumerate() {
            for node in nodes.clone() {
                if table.operands[node].all().is_empty() {
                    self.lower_bound(class, node, &mut queue);
                }
            }
        }
        while let Some(class) = queue.pop_front() {
            for &(node, parent) in &table.parents[class] {
                if self.bound[parent] > 0 {
                    self.lower_bound(parent, node, &mut queue);
                }
            }
        }
    }

    fn lower_bound(&mut self, class: Class, node: Node, queue: &mut VecDeque<Class>) {
        let mut bound = u64::from(self.table.costs[node]);
        for &operand in self.table.operands[node].all() {
            bound = bound.saturating_add(self.bound[operand]);
        }
        if bound < self.bound[class] {
            self.bound[class] = bound;
            self.completion[class] = node;
            queue.push_back(class);
        }
    }
}
