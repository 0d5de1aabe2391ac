//! Form → equal expressions of it, by equality saturation.

use std::ops::RangeInclusive;

use egg::{Id, Language};

use super::form::Form;
use super::graph::{Facts, Graph};
use super::pattern::Match;
use super::rules::RULES;
use super::selection::NOTHING;
use super::snapshot::Snapshot;
use super::table::{Node, Table};

/// Iterations of saturation.
const MOST_ITERATIONS: usize = 9;

/// Saturation ends with the rule that gives it more than this multiple of the form's nodes.
/// Unoptimised, as users' macros run, 1000 nodes take some 15 ms, and as much again to choose
/// from. Twice as many make the problems' f^τ and Jacobians less than 1 % cheaper.
const GROWTH: usize = 5;

/// As [`GROWTH`], for a cluster of large functions: many of them have to be optimised.
const CLUSTER_GROWTH: usize = 3;

/// The limits of nodes of functions as a whole, whatever their size.
const WHOLE: RangeInclusive<usize> = 800..=1_100;

/// A saturated e-graph with the nodes of the form that it was made from.
pub(super) struct Saturation {
    /// The e-graph.
    pub(super) graph: Graph,
    /// The e-graph's identifiers of the form's nodes.
    pub(super) image: Vec<Id>,
}

impl Saturation {
    /// Saturates `form`, which is that of whole functions or of a cluster.
    pub(super) fn new(form: &Form, whole: bool) -> Self {
        let size = form.nodes.len();
        let most_nodes = if whole {
            (GROWTH * size).clamp(*WHOLE.start(), *WHOLE.end())
        } else {
            CLUSTER_GROWTH * size
        };
        let mut graph = Graph::new(Facts {
            constants: form.constants.clone(),
        });
        let mut image: Vec<Id> = Vec::with_capacity(form.nodes.len());
        for node in &form.nodes {
            let node = node.map_children(|child| image[usize::from(child)]);
            image.push(graph.add(node));
        }
        graph.rebuild();
        let mut matches: Vec<Vec<Match>> = RULES.iter().map(|_| Vec::new()).collect();
        for _ in 0..MOST_ITERATIONS {
            search(&Snapshot::new(&graph), &mut matches);
            let changed = apply(&mut graph, &mut matches, most_nodes);
            graph.rebuild();
            if !changed || graph.total_size() > most_nodes {
                break;
            }
        }
        Self { graph, image }
    }

    /// By class: the first of the form's nodes in it. Its operands come before it, so that no
    /// class is made from itself.
    pub(super) fn first(&self, form: &Form, table: &Table) -> Vec<Node> {
        let mut first = vec![NOTHING; table.classes.len()];
        for (node, &image) in form.nodes.iter().zip(&self.image) {
            let class = table.class(&self.graph, image);
            if first[class] == NOTHING {
                let node = node.map_children(|child| self.image[usize::from(child)]);
                first[class] = table.find(&self.graph, class, &node).unwrap_or(NOTHING);
            }
        }
        first
    }
}

/// What every rule matches.
fn search(classes: &Snapshot, matches: &mut [Vec<Match>]) {
    for &class in &classes.ids {
        for operation in classes.operations(class) {
            for (rule, found) in RULES.iter().zip(matches.iter_mut()) {
                if rule.search.symbol == operation.symbol {
                    rule.search.find(classes, class, operation, found);
                }
            }
        }
    }
    for (rule, found) in RULES.iter().zip(matches.iter_mut()) {
        found.retain(|found| rule.condition.holds(classes, found));
    }
}

/// Adds the other side of every match, rule by rule until there are too many nodes; whether
/// anything was new.
fn apply(graph: &mut Graph, matches: &mut [Vec<Match>], most_nodes: usize) -> bool {
    let before = graph.total_size();
    let mut changed = false;
    for (rule, found) in RULES.iter().zip(matches) {
        if graph.total_size() > most_nodes {
            found.clear();
        }
        for found in found.drain(..) {
            let equal = rule.steps.add(graph, &found.variables);
            changed |= graph.union(found.class, equal);
        }
    }
    changed || graph.total_size() > before
}
