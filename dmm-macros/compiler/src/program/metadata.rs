//! What a machine is told of a system besides its functions: names, and where the regions lie.

use crate::model::{Model, Region, Sign, plain_text};
use crate::scheme::Scheme;

/// The names in a system, and where its regions lie.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Metadata {
    /// The system's name.
    pub name: String,
    /// The names of the states.
    pub states: Vec<String>,
    /// The names of the parameters.
    pub parameters: Vec<String>,
    /// The names of the interfaces.
    pub interfaces: Vec<String>,
    /// The conditions of proofs that a run has to check.
    pub conditions: Vec<Condition>,
    /// The regions.
    pub regions: Vec<RegionMetadata>,
}

/// A condition of proofs that a run has to check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Condition {
    /// The index of the region.
    pub region: usize,
    /// The condition, as text.
    pub condition: String,
    /// The names of the quantities.
    pub quantities: String,
    /// Whether the condition is u ≠ 0, so that the sign of u is kept.
    pub keeps_sign: bool,
}

/// The names in a region, and where it lies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RegionMetadata {
    /// Its name.
    pub name: String,
    /// The names of the quantities that are conserved in it.
    pub conserved: Vec<String>,
    /// The sign of g of each interface.
    pub sides: Vec<Sign>,
    /// The index of the region on the other side of each interface, if there is one.
    pub neighbours: Vec<Option<usize>>,
}

impl Metadata {
    /// That of a scheme.
    pub(super) fn new(scheme: &Scheme) -> Self {
        let model = &scheme.model;
        let text = |name: &crate::algebra::Name| name.as_str().to_owned();
        let conditions = scheme.checked_conditions().map(|checked| Condition {
            region: checked.region,
            condition: checked.condition.statement(scheme.dag()),
            quantities: checked.names(&model.regions[checked.region]),
            keeps_sign: checked.keeps_sign(),
        });
        Self {
            name: plain_text(&model.name),
            states: model.states.iter().map(|one| text(&one.name)).collect(),
            parameters: (model.parameters.iter())
                .map(|one| text(&one.name))
                .collect(),
            interfaces: (model.interfaces.iter())
                .map(|one| plain_text(&one.ident))
                .collect(),
            conditions: conditions.collect(),
            regions: (model.regions.iter())
                .map(|region| RegionMetadata::new(model, region))
                .collect(),
        }
    }
}

impl RegionMetadata {
    fn new(model: &Model, region: &Region) -> Self {
        let own = signs(region);
        let neighbour = |interface: usize| {
            model.regions.iter().position(|other| {
                let signs = signs(other);
                let mut pairs = own.iter().zip(&signs).enumerate();
                pairs.all(|(index, (a, b))| (a == b) == (index != interface))
            })
        };
        Self {
            name: plain_text(&region.ident),
            conserved: (region.conserved.iter())
                .map(|psi| plain_text(&psi.ident))
                .collect(),
            neighbours: (0..own.len()).map(neighbour).collect(),
            sides: own,
        }
    }
}

/// The signs of a region, in the order of the interfaces.
fn signs(region: &Region) -> Vec<Sign> {
    let mut sides = region.sides.clone();
    sides.sort_by_key(|side| side.interface);
    sides.into_iter().map(|side| side.sign).collect()
}
