//! What a machine is told of a system besides its functions: names, and where the regions lie.

use crate::algebra::Id;
use crate::model::{self, Interface, Model, Region, Sign, SlideEnd, plain_text};
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
    /// The names of the discrete states.
    pub discrete: Vec<String>,
    /// The interfaces whose side is part of a mode whether they bound its region or not.
    pub free: Vec<usize>,
    /// Those of them that formulas switch at.
    pub switches: Vec<usize>,
    /// The interfaces that solutions may slide on.
    pub sliding: Vec<usize>,
    /// The ends of sliding motions, which guards behind the interfaces stand for.
    pub ends: Vec<SlideEnd>,
    /// What happens in an instant.
    pub events: Vec<Event>,
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

/// When an event happens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// The index of the interface.
    pub interface: usize,
    /// Whether it happens where g changes from − to +.
    pub rises: bool,
    /// Whether it happens where g changes from + to −.
    pub falls: bool,
    /// The index of the region that it happens in; nothing where it happens in all of them.
    pub region: Option<usize>,
    /// The index of the discrete state that counts it, if it is periodic.
    pub clock: Option<usize>,
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
    /// The interfaces that it slides on.
    pub on: Vec<usize>,
    /// The switches that it slides on or not.
    pub may_slide: Vec<usize>,
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
            interfaces: model.real_interfaces().map(Interface::name).collect(),
            discrete: (model.discrete.iter())
                .map(|one| plain_text(&one.ident))
                .collect(),
            free: model.free_interfaces(),
            switches: (model.free_interfaces().into_iter())
                .filter(|&index| model.interfaces[index].is_switch)
                .collect(),
            sliding: (model.interfaces.iter().enumerate())
                .filter(|(_, interface)| interface.slides)
                .map(|(index, _)| index)
                .collect(),
            ends: (model.interfaces.iter())
                .filter_map(|interface| interface.end)
                .collect(),
            events: model
                .events
                .iter()
                .map(|one| Event::new(model, one))
                .collect(),
            conditions: conditions.collect(),
            regions: (model.regions.iter())
                .map(|region| RegionMetadata::new(model, region))
                .collect(),
        }
    }
}

impl Event {
    fn new(model: &Model, event: &model::Event) -> Self {
        let region = event.region.as_ref().and_then(|ident| {
            let mut regions = model.regions.iter();
            regions.position(|region| region.ident == *ident)
        });
        let is_clock =
            |(index, _): &&(usize, Id)| model.discrete.get(*index).is_some_and(|one| one.is_clock);
        Self {
            interface: event.interface,
            rises: event.rises,
            falls: event.falls,
            region,
            clock: event
                .discrete
                .iter()
                .find(is_clock)
                .map(|&(index, _)| index),
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
            let others = others.filter(|(_, other)| other.slide.is_none());
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
            on: (region.slide.iter())
                .flat_map(|slide| slide.on.iter().copied())
                .collect(),
            may_slide: (region.slide.iter())
                .flat_map(|slide| slide.switches.iter().map(|&(interface, _)| interface))
                .collect(),
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
