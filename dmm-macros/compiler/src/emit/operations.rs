//! The operations of a system: what its emitted functions evaluate, as written and optimised.

use super::boundary;
use super::lower::Lowered;
use super::nodes::Nodes;
use crate::algebra::{Dag, Id, Name};
use crate::optimise::{Count, Optimiser};
use crate::scheme::Scheme;

/// The lowered and optimised operations of every emitted function of a system.
pub struct Operations {
    pub(super) regions: Vec<Region>,
    pub(super) boundary: Option<(Vec<boundary::Nodes>, Lowered)>,
}

/// The operations of a region.
pub(super) struct Region {
    /// As they are written.
    pub(super) written: (Nodes, Lowered),
    /// By fewer operations.
    pub(super) optimised: (Nodes, Lowered),
}

/// What one function evaluates.
pub struct Evaluated<'a> {
    /// The method's name.
    pub name: &'static str,
    /// Its results.
    pub roots: Vec<Id>,
    lowered: &'a Lowered,
}

impl Operations {
    /// Lowers and optimises the expressions of `scheme`.
    pub fn new(scheme: &Scheme) -> Self {
        let mut dag = scheme.dag().clone();
        let mut optimiser = Optimiser::default();
        let parameters: Vec<Name> = scheme
            .model
            .parameters
            .iter()
            .map(|one| one.name.clone())
            .collect();
        let regions = (0..scheme.regions.len())
            .map(|region| {
                let mut lowered = Lowered::new(parameters.clone());
                let nodes = Nodes::lower(&mut dag, &mut lowered, scheme, region);
                let optimised = nodes.optimised(&lowered, &mut optimiser);
                Region {
                    written: (nodes, lowered),
                    optimised,
                }
            })
            .collect();
        let is_bounded = !scheme.interfaces.is_empty() || scheme.guards().next().is_some();
        let boundary = is_bounded
            .then(|| boundary::operations(&mut dag, scheme, parameters.clone(), &mut optimiser));
        Self { regions, boundary }
    }

    /// The number of regions.
    pub fn regions(&self) -> usize {
        self.regions.len()
    }

    /// The functions of a region's flow as they are written.
    pub fn written(&self, region: usize) -> Vec<Evaluated<'_>> {
        self.regions
            .get(region)
            .map_or_else(Vec::new, |region| evaluated(&region.written))
    }

    /// The functions of a region's flow, optimised; in the same order.
    pub fn optimised(&self, region: usize) -> Vec<Evaluated<'_>> {
        self.regions
            .get(region)
            .map_or_else(Vec::new, |region| evaluated(&region.optimised))
    }
}

fn evaluated((nodes, lowered): &(Nodes, Lowered)) -> Vec<Evaluated<'_>> {
    nodes
        .functions()
        .into_iter()
        .map(|(name, roots)| Evaluated {
            name,
            roots,
            lowered,
        })
        .collect()
}

impl<'a> Evaluated<'a> {
    /// The operations: products of a node with itself are squares, and constants are exact.
    pub fn dag(&self) -> &'a Dag {
        self.lowered.dag()
    }

    /// How many operations an evaluation takes.
    pub fn shared(&self) -> Count {
        Count::shared(self.dag(), &self.roots, |id| self.lowered.is_fixed(id))
    }

    /// How many it would take without sharing.
    pub fn tree(&self) -> Count {
        Count::tree(self.dag(), &self.roots, |id| self.lowered.is_fixed(id))
    }
}
