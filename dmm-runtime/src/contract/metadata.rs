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
    /// The interfaces that solutions may slide on.
    pub sliding: &'static [usize],
    /// The ends of sliding motions: what the indices of [`Guards::sides`](crate::Guards::sides)
    /// behind the interfaces stand for.
    pub ends: &'static [SlideEnd],
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

/// Where a function of a sliding motion is zero.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SlideEnd {
    /// The index of the interface that it belongs to in [`Metadata::interfaces`].
    pub interface: usize,
    /// The side on which the solution leaves that interface; nothing where it crosses the interface
    /// while it slides on others.
    pub side: Option<Side>,
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
    /// The interfaces that it slides on: it is no part of the space then, but a motion on them.
    pub on: &'static [usize],
    /// The switches that it slides on or not.
    pub may_slide: &'static [usize],
}

impl RegionMetadata {
    /// That of no region.
    pub(crate) const UNKNOWN: Self = Self {
        name: "",
        conserved: &[],
        sides: &[],
        neighbours: &[],
        on: &[],
        may_slide: &[],
    };

    /// On which side of a guard it lies, by its index in
    /// [`Guards::sides`](crate::Guards::sides), if that bounds it whatever the mode.
    #[inline]
    pub fn side(&self, guard: usize) -> Option<Side> {
        self.sides.get(guard).copied().flatten()
    }

    /// Whether it is the region on these sides of the interfaces, of which nothing stands for those
    /// that it slides on.
    fn is_on(&self, sides: &[Option<Side>]) -> bool {
        let mut pairs = self.sides.iter().zip(sides);
        let is_within = pairs.all(|(own, side)| own.is_none() || own == side);
        let slides = |interface: &usize| sides.get(*interface) == Some(&None);
        let mut slid = (0..sides.len()).filter(slides);
        let others = slid.clone().filter(|one| !self.on.contains(one)).count();
        is_within
            && self.on.iter().all(slides)
            && slid.all(|one| self.on.contains(&one) || self.may_slide.contains(&one))
            && (others > 0) != self.may_slide.is_empty()
    }
}

impl Metadata {
    /// Whether a mode is more than a region.
    pub fn has_constants(&self) -> bool {
        !self.discrete.is_empty() || !self.free.is_empty()
    }

    /// The discrete states that are declared, with their indices in [`Metadata::discrete`]: all but
    /// those that count periodic events.
    pub fn declared_discrete(&self) -> impl Iterator<Item = (usize, &'static str)> {
        let is_clock = |index| self.events.iter().any(|event| event.clock == Some(index));
        let discrete = self.discrete.iter().copied().enumerate();
        discrete.filter(move |&(index, _)| !is_clock(index))
    }

    /// The values of the [declared](Metadata::declared_discrete) discrete states, of the values of all
    /// [`Metadata::discrete`] in a mode; NaN where there is none.
    pub fn declared_values(&self, values: &[f64]) -> Vec<f64> {
        let declared = self.declared_discrete();
        let values = declared.map(|(index, _)| values.get(index).copied());
        values.map(|value| value.unwrap_or(f64::NAN)).collect()
    }

    /// The index of the region on these sides of the interfaces; nothing stands for those that it
    /// slides on.
    pub fn region_on(&self, sides: &[Option<Side>]) -> Option<usize> {
        self.regions.iter().position(|region| region.is_on(sides))
    }

    /// The end of a sliding motion that a guard stands for.
    #[inline]
    pub fn end(&self, guard: usize) -> Option<&'static SlideEnd> {
        self.ends.get(guard.checked_sub(self.interfaces.len())?)
    }

    /// The index of the interface that is met with a guard: the guard itself, or what slides end on.
    #[inline]
    pub(crate) fn interface(&self, guard: usize) -> usize {
        self.end(guard).map_or(guard, |end| end.interface)
    }

    /// The index of the guard of the first condition.
    #[inline]
    pub fn first_condition(&self) -> usize {
        self.interfaces.len() + self.ends.len()
    }

    /// The condition that a guard stands for.
    #[inline]
    pub fn condition(&self, guard: usize) -> Option<&'static Condition> {
        self.conditions
            .get(guard.checked_sub(self.first_condition())?)
    }

    /// The name of a guard, an index of [`Guards::sides`](crate::Guards::sides): of an interface, or
    /// of that which the end of a sliding motion belongs to, or the text of a condition.
    pub fn guard_name(&self, index: usize) -> &'static str {
        let interface = self.end(index).map_or(index, |end| end.interface);
        match self.interfaces.get(interface) {
            Some(name) => name,
            None => self.condition(index).map_or("", |one| one.condition),
        }
    }
}
