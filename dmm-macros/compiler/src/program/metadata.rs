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
    /// The sign of g of each interface that bounds it.
    pub sides: Vec<Option<Sign>>,
    /// The index of the region on the other side of each interface that bounds it, where it is the
    /// only one.
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
        let sides = |region| signs(region, model.interfaces.len());
        let own = sides(region);
        let neighbour = |interface: usize| {
            let mut across = own.clone();
            *across.get_mut(interface)? = Some(own.get(interface)?.as_ref()?.opposite());
            let others = model.regions.iter().enumerate();
            let mut others = others.filter(|(_, other)| overlap(&across, &sides(other)));
            let (only, _) = others.next()?;
            others.next().is_none().then_some(only)
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
fn signs(region: &Region, interfaces: usize) -> Vec<Option<Sign>> {
    let of = |interface| {
        let side = region.sides.iter().find(|side| side.interface == interface);
        side.map(|side| side.sign)
    };
    (0..interfaces).map(of).collect()
}

/// Whether there are points with both patterns of signs.
fn overlap(one: &[Option<Sign>], other: &[Option<Sign>]) -> bool {
    let mut pairs = one.iter().zip(other);
    pairs.all(|(one, other)| one.is_none() || other.is_none() || one == other)
}
