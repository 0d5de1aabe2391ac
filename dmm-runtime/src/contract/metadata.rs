//! What is known of a system besides its functions: names, and the sides of its regions.

use super::{Condition, Side};

/// The names in a system, and where its regions lie.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Metadata {
    /// The system's name.
    pub name: &'static str,
    /// The names of the states.
    pub states: &'static [&'static str],
    /// The names of the parameters.
    pub parameters: &'static [&'static str],
    /// The names of the interfaces.
    pub interfaces: &'static [&'static str],
    /// The names of the discrete states.
    pub discrete: &'static [&'static str],
    /// The interfaces whose side is part of a mode whether they bound its region or not: those that
    /// formulas switch at, and those of events.
    pub free: &'static [usize],
    /// Those of them that formulas switch at.
    pub switches: &'static [usize],
    /// What happens in an instant.
    pub events: &'static [Event],
    /// The conditions under which quantities were proved to be conserved, as far as a run has to
    /// check them; see [`Condition`].
    pub conditions: &'static [Condition],
    /// The regions, in the order of declaration.
    pub regions: &'static [RegionMetadata],
}

/// When an event happens.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Event {
    /// The index of its interface in [`Metadata::interfaces`].
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

/// The name of a region, where it lies, and the names of what is conserved in it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct RegionMetadata {
    /// Its name.
    pub name: &'static str,
    /// The names of the quantities that are conserved in it.
    pub conserved: &'static [&'static str],
    /// On which side of each interface it lies: the sign of g; nothing where the interface does not
    /// bound it.
    pub sides: &'static [Option<Side>],
    /// The index of the region on the other side of each interface that bounds it, where it is
    /// the only one.
    pub neighbours: &'static [Option<usize>],
}

impl RegionMetadata {
    /// That of no region.
    pub(crate) const UNKNOWN: Self = Self {
        name: "",
        conserved: &[],
        sides: &[],
        neighbours: &[],
    };
}

impl Metadata {
    /// Whether a mode is more than a region.
    pub fn has_constants(&self) -> bool {
        !self.discrete.is_empty() || !self.free.is_empty()
    }

    /// The index of the region on these sides of the interfaces.
    pub fn region_on(&self, sides: &[Side]) -> Option<usize> {
        self.regions.iter().position(|region| {
            let mut pairs = region.sides.iter().zip(sides);
            pairs.all(|(own, side)| own.is_none_or(|own| own == *side))
        })
    }

    /// The name of an interface or, behind them, the condition of a guard: what an index of
    /// [`Guards::sides`](crate::Guards::sides) stands for.
    pub fn guard_name(&self, index: usize) -> &'static str {
        let condition = || {
            let number = index.checked_sub(self.interfaces.len())?;
            Some(self.conditions.get(number)?.condition)
        };
        let name = self.interfaces.get(index).copied();
        name.or_else(condition).unwrap_or_default()
    }
}
