//! An e-graph between two iterations as plain tables, in which patterns are looked for.

use egg::{Id, Language};

use super::graph::{Graph, Known};
use super::operation::{Operation, Symbol};

/// The classes of an e-graph.
pub(super) struct Snapshot {
    /// The classes in rising order.
    pub(super) ids: Vec<Id>,
    operations: Vec<Operation>,
    /// By the number of a class: where its operations begin and end.
    ranges: Vec<(u32, u32)>,
    /// By the number of a class: a bit for every kind of symbol that is in it.
    kinds: Vec<u16>,
    known: Vec<Known>,
}

impl Snapshot {
    /// The classes of `graph`.
    pub(super) fn new(graph: &Graph) -> Self {
        let nothing = Known {
            constant: None,
            fixed: false,
            exact: false,
            not_negative: false,
        };
        let mut ids: Vec<Id> = graph.classes().map(|class| class.id).collect();
        ids.sort_unstable();
        let size = ids.last().map_or(0, |&last| usize::from(last) + 1);
        let mut snapshot = Self {
            ids: Vec::new(),
            operations: Vec::with_capacity(graph.total_size()),
            ranges: vec![(0, 0); size],
            kinds: vec![0; size],
            known: vec![nothing; size],
        };
        for &id in &ids {
            let (class, number) = (&graph[id], usize::from(id));
            let start = snapshot.operations.len() as u32;
            snapshot.operations.extend_from_slice(&class.nodes);
            snapshot.ranges[number] = (start, snapshot.operations.len() as u32);
            snapshot.known[number] = class.data;
            for node in &class.nodes {
                snapshot.kinds[number] |= 1 << node.discriminant();
            }
        }
        snapshot.ids = ids;
        snapshot
    }

    /// The operations of a class.
    pub(super) fn operations(&self, class: Id) -> &[Operation] {
        let (start, end) = self.ranges[usize::from(class)];
        &self.operations[start as usize..end as usize]
    }

    /// What is known of a class.
    pub(super) fn known(&self, class: Id) -> &Known {
        &self.known[usize::from(class)]
    }

    /// Whether a class has an operation of the kind of `symbol`.
    pub(super) fn has(&self, class: Id, symbol: Symbol) -> bool {
        self.kinds[usize::from(class)] & 1 << symbol.kind() != 0
    }
}
