//! Large functions in clusters: chains and bodies have many results, each of which shares
//! expressions with a few others only. Saturating all of them together would spend the limit
//! of nodes before anything is found.
//!
//! A cluster is a run of results with what they need and no earlier cluster has. What later
//! clusters use of it is a result of its own, computed once: sharing is never lost, and a
//! cluster is never more expensive than it was. Clusters of the same form, as the inner masses
//! of a chain give, are optimised once.

use std::collections::{BTreeMap, BTreeSet};

use egg::{Id, Language};

use super::Source;
use super::form::is_atom;

/// Functions with more nodes are taken apart.
pub(super) const LARGEST_WHOLE: usize = 260;

/// A cluster is complete when it has as many nodes.
const COMPLETE: usize = 45;

/// The clusters of a function with results `roots`, in an order in which each uses earlier
/// ones only: their results, those for later clusters included.
pub(super) fn clusters(source: &Source<'_>, roots: &[Id]) -> Vec<BTreeSet<Id>> {
    let mut owner: BTreeMap<Id, usize> = BTreeMap::new();
    let mut clusters: Vec<BTreeSet<Id>> = vec![BTreeSet::new()];
    let mut size = 0;
    for &root in roots {
        let mut missing = BTreeSet::new();
        let mut stack = vec![root];
        while let Some(id) = stack.pop() {
            if !owner.contains_key(&id) && missing.insert(id) && !is_atom(source, id) {
                source.dag[id].for_each(|child| stack.push(child));
            }
        }
        for id in missing {
            if size >= COMPLETE {
                clusters.push(BTreeSet::new());
                size = 0;
            }
            let current = clusters.len() - 1;
            owner.insert(id, current);
            size += 1;
            if !is_atom(source, id) {
                source.dag[id].for_each(|child| {
                    let other = owner[&child];
                    if other < current {
                        clusters[other].insert(child);
                    }
                });
            }
        }
        clusters[owner[&root]].insert(root);
    }
    clusters
}
