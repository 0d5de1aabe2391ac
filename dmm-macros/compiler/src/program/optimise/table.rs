//! A saturated e-graph as plain tables: classes, their nodes, and the children of these.

use std::ops::Range;

use egg::{Id, Language};
use rustc_hash::FxHashMap;

use super::cost::{STORED, UNIT, weight};
use super::graph::Graph;
use super::operation::{Operation, Symbol};

/// A class, by its number in the table.
pub(super) type Class = usize;

/// A node, by its number in the table.
pub(super) type Node = usize;

/// Classes of equal expressions and the nodes to choose from.
pub(super) struct Table {
    /// The nodes.
    pub(super) nodes: Vec<Operation>,
    /// By node: the classes of its operands, each once.
    pub(super) operands: Vec<Operands>,
    /// By node: the cost of the operation alone.
    pub(super) costs: Vec<u32>,
    /// By class: its nodes.
    pub(super) classes: Vec<Range<Node>>,
    /// By class: the nodes that have it as an operand, each with its own class.
    pub(super) parents: Vec<Vec<(Node, Class)>>,
    /// The numbers of the e-graph's classes.
    numbers: FxHashMap<Id, Class>,
}

/// At most two classes.
#[derive(Clone, Copy)]
pub(super) struct Operands {
    classes: [Class; 2],
    count: usize,
}

impl Operands {
    /// The classes.
    pub(super) fn all(&self) -> &[Class] {
        &self.classes[..self.count]
    }
}

impl Table {
    /// The table of `graph`.
    pub(super) fn new(graph: &Graph) -> Self {
        let mut ids: Vec<Id> = graph.classes().map(|class| class.id).collect();
        ids.sort_unstable();
        let numbers: FxHashMap<Id, Class> = ids.iter().copied().zip(0..).collect();
        let mut table = Self {
            nodes: Vec::new(),
            operands: Vec::new(),
            costs: Vec::new(),
            classes: Vec::with_capacity(ids.len()),
            parents: vec![Vec::new(); ids.len()],
            numbers,
        };
        for (class, &id) in ids.iter().enumerate() {
            let first = table.nodes.len();
            for node in &graph[id].nodes {
                table.push(class, node, graph[id].data.fixed);
            }
            table.classes.push(first..table.nodes.len());
        }
        table
    }

    fn push(&mut self, class: Class, node: &Operation, fixed: bool) {
        let mut operands = Operands {
            classes: [0; 2],
            count: 0,
        };
        for child in node.children() {
            let child = self.numbers[child];
            if child == class {
                return;
            }
            if !operands.all().contains(&child) {
                operands.classes[operands.count] = child;
                operands.count += 1;
            }
        }
        let number = self.nodes.len();
        for &child in operands.all() {
            self.parents[child].push((number, class));
        }
        // the cost of what is stored is a small part of what it would be
        let divisor = if fixed && node.symbol != Symbol::Neg {
            UNIT / STORED
        } else {
            1
        };
        self.costs.push(weight(node.symbol) / divisor);
        self.operands.push(operands);
        self.nodes.push(*node);
    }

    /// The number of the class of `id`.
    pub(super) fn class(&self, graph: &Graph, id: Id) -> Class {
        self.numbers[&graph.find(id)]
    }

    /// By operand of a node: its class, those that are there twice included.
    pub(super) fn children(&self, node: Node) -> impl Iterator<Item = Class> {
        let children = self.nodes[node].children().iter();
        children.map(|child| self.numbers[child])
    }

    /// The number of `node` in its class, where it is there.
    pub(super) fn find(&self, graph: &Graph, class: Class, node: &Operation) -> Option<Node> {
        let canonical = node.map_children(|child| graph.find(child));
        self.classes[class]
            .clone()
            .find(|&node| self.nodes[node] == canonical)
    }
}
