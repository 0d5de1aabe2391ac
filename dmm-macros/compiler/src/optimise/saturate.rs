//! Form → equal expressions of it, by equality saturation.

use std::ops::RangeInclusive;
use std::time::Duration;

use egg::{Id, Language, Runner};

use super::extract::NOTHING;
use super::form::Form;
use super::graph::{Facts, Graph};
use super::rules::RULES;
use super::table::{Node, Table};
use crate::algebra::Math;

/// Iterations of saturation.
const MOST_ITERATIONS: usize = 9;

/// Saturation ends at this multiple of the form's nodes. Unoptimised, as users' macros run,
/// 1000 nodes take some 25 ms. Five times as many make the Kepler problem's f^τ and Jacobian
/// 5 % cheaper; going sideways in the hill-climb makes them 7 % cheaper.
const GROWTH: usize = 7;

/// As [`GROWTH`], for a cluster of a large program: many of them have to be optimised.
const CLUSTER_GROWTH: usize = 4;

/// The limits of nodes of a whole program, whatever its size.
const WHOLE: RangeInclusive<usize> = 800..=1_800;

/// A saturated e-graph with the nodes of the form that it was made from.
pub(super) struct Saturation {
    /// The e-graph.
    pub(super) graph: Graph,
    /// The e-graph's identifiers of the form's nodes.
    pub(super) image: Vec<Id>,
}

impl Saturation {
    /// Saturates `form`, which is a whole program or a cluster of one.
    pub(super) fn new(form: &Form, whole: bool) -> Self {
        let size = form.nodes.len();
        let most_nodes = match whole {
            true => (GROWTH * size).clamp(*WHOLE.start(), *WHOLE.end()),
            false => CLUSTER_GROWTH * size,
        };
        let mut graph = Graph::new(Facts);
        let mut image: Vec<Id> = Vec::with_capacity(form.nodes.len());
        for node in &form.nodes {
            let node = node.clone().map_children(|child| image[usize::from(child)]);
            image.push(graph.add(node));
        }
        graph.rebuild();
        let runner: Runner<Math, Facts> = Runner::new(Facts)
            .with_egraph(graph)
            .with_iter_limit(MOST_ITERATIONS)
            .with_node_limit(most_nodes)
            .with_time_limit(Duration::MAX)
            .run(RULES.iter());
        Self {
            graph: runner.egraph,
            image,
        }
    }

    /// By class: the first of the form's nodes in it. Its operands come before it, so that no
    /// class is made from itself.
    pub(super) fn first(&self, form: &Form, table: &Table) -> Vec<Node> {
        let mut first = vec![NOTHING; table.classes.len()];
        for (node, &image) in form.nodes.iter().zip(&self.image) {
            let class = table.class(&self.graph, image);
            if first[class] == NOTHING {
                let node = node
                    .clone()
                    .map_children(|child| self.image[usize::from(child)]);
                first[class] = table.find(&self.graph, class, &node).unwrap_or(NOTHING);
            }
        }
        first
    }
}
