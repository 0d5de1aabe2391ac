//! A saturated e-graph as plain tables: classes, their nodes, and the children of these.

use std::collections::HashMap;
use std::ops::Range;

use egg::{Id, Language};

use super::cost::{STORED, UNIT, weight};
use super::graph::Graph;
use crate::algebra::Math;

/// A class, by its number in the table.
pub(super) type Class = usize;

/// A node, by its number in the table.
pub(super) type Node = usize;

/// Classes of equal expressions and the nodes to choose from.
pub(super) struct Table {
    /// The nodes.
    pub(super) nodes: Vec<Math>,
    /// By node: the classes of its operands.
    pub(super) children: Vec<Vec<Class>>,
    /// By node: the cost of the operation alone.
    pub(super) costs: Vec<u32>,
    /// By class: its nodes.
    pub(super) classes: Vec<Range<Node>>,
    /// By class: the nodes that have it as an operand, each with its own class.
    pub(super) parents: Vec<Vec<(Node, Class)>>,
    /// The numbers of the e-graph's classes.
    numbers: HashMap<Id, Class>,
}

impl Table {
    /// The table of `graph`.
    pub(super) fn new(graph: &Graph) -> Self {
        let mut ids: Vec<Id> = graph.classes().map(|class| class.id).collect();
        ids.sort_unstable();
        let numbers: HashMap<Id, Class> = ids.iter().copied().zip(0..).collect();
        let mut table = Self {
            nodes: Vec::new(),
            children: Vec::new(),
            costs: Vec::new(),
            classes: Vec::with_capacity(ids.len()),
            parents: vec![Vec::new(); ids.len()],
            numbers,
        };
        for (class, &id) in ids.iter().enumerate() {
            let first = table.nodes.len();
            for node in graph[id].iter() {
                table.push(class, node, graph[id].data.fixed);
            }
            table.classes.push(first..table.nodes.len());
        }
        table
    }

    fn push(&mut self, class: Class, node: &Math, fixed: bool) {
        let children: Vec<Class> = node
            .children()
            .iter()
            .map(|child| self.numbers[child])
            .collect();
        if children.contains(&class) {
            return;
        }
        let number = self.nodes.len();
        let mut distinct = children.clone();
        distinct.dedup();
        for child in distinct {
            self.parents[child].push((number, class));
        }
        // the cost of computing something once a flow is a small part of what it would be
        let divisor = if fixed && !matches!(node, Math::Neg(_)) {
            UNIT / STORED
        } else {
            1
        };
        self.costs.push(weight(node) / divisor);
        self.children.push(children);
        self.nodes.push(node.clone());
    }

    /// The number of the class of `id`.
    pub(super) fn class(&self, graph: &Graph, id: Id) -> Class {
        self.numbers[&graph.find(id)]
    }

    /// The number of `node` in its class, where it is there.
    pub(super) fn find(&self, graph: &Graph, class: Class, node: &Math) -> Option<Node> {
        let canonical = node.clone().map_children(|child| graph.find(child));
        self.classes[class]
            .clone()
            .find(|&node| self.nodes[node] == canonical)
    }
}
