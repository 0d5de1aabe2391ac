//! The mode that a solution goes on in at a point of interfaces.
//!
//! Away from the interfaces the signs of the switching functions tell the region. On some of them
//! every choice of sides is a region that meets the point, and so is every sliding motion on some of
//! them. The solution goes on in the mode whose own field fits to its choice at each of these
//! interfaces: dg/dt > 0 where it lies on the side g > 0, dg/dt < 0 where it lies on the side g < 0,
//! and where it slides the fields of both sides lead to the interface, which the ends of the motion
//! tell. These are the solutions of the complementarity problem (17) of Nurkanović, Sperl, Albrecht &
//! Diehl (2024) of each independent group of interfaces. None is a motion that is not declared,
//! several are several solutions, and where one of them neither enters nor leaves (dg/dt = 0) it is
//! not determined. Nothing depends on the order in which interfaces and regions are declared.

use super::around::{Around, Choice};
use super::fit::Fit;
use crate::contract::{Side, System};
use crate::error::{Error, ErrorKind};
use crate::method::Active;

/// On so many interfaces all choices are looked at; on more of them one group of those that depend on
/// one another after the other.
const MOST_AT_ONCE: usize = 5;
/// A group of interfaces that depend on one another at a point has so many at most.
const MOST: usize = 8;

impl<Sys: System<N>, const N: usize> Around<'_, Sys, N> {
    /// The mode that the solution goes on in, and the interfaces that bound it at the point.
    ///
    /// # Errors
    /// None, or several.
    pub(super) fn entered(&self) -> Result<(Sys::Region, Active), Error> {
        let mut sides = self.sides.clone();
        let groups = match self.on.len() {
            // away from all interfaces there is nothing to choose
            0 => Vec::new(),
            1..=MOST_AT_ONCE => vec![self.on.clone()],
            _ => self.groups(),
        };
        for group in &groups {
            self.choose(group, &mut sides)?;
        }
        let mode = self.settled(sides.clone());
        let mode = mode.ok_or_else(|| self.error(ErrorKind::NoRegion))?;
        let fits = self.on.iter().map(|&one| self.fit(mode, one, &sides));
        if groups.len() > 1 && fits.fold(Fit::Fits, Fit::and) != Fit::Fits {
            return Err(self.intersection());
        }
        Ok((mode, self.active(mode)))
    }

    /// Chooses for the interfaces of a group, whose choices depend on one another.
    fn choose(&self, group: &[usize], sides: &mut [Choice]) -> Result<(), Error> {
        if group.len() > MOST {
            return Err(self.intersection());
        }
        let mut around = Vec::new();
        let mut open = false;
        let mut entered: Vec<(Sys::Region, Vec<Choice>)> = Vec::new();
        for choices in self.choices(group) {
            let mut sides = sides.to_vec();
            for (&interface, &choice) in group.iter().zip(&choices) {
                sides[interface] = choice;
            }
            let Some(mode) = self.settled(sides.clone()) else {
                continue;
            };
            // where an interface does not bound a region, both choices are the same
            if around.contains(&mode) {
                continue;
            }
            around.push(mode);
            let fits = group.iter().map(|&one| self.fit(mode, one, &sides));
            match fits.fold(Fit::Fits, Fit::and) {
                Fit::Fits => entered.push((mode, choices)),
                Fit::Open => open = true,
                Fit::Fails => {}
            }
        }
        // a field that is tangential to an interface may lead into its region as well
        match (&entered[..], &around[..]) {
            ([(_, choices)], _) if !open => {
                for (&interface, &choice) in group.iter().zip(choices) {
                    sides[interface] = choice;
                }
                Ok(())
            }
            ([], []) => Err(self.error(ErrorKind::NoRegion)),
            ([], around) => Err(self.none(around)),
            (_, around) if open => Err(self.none(around)),
            (several, _) => Err(self.several(several.iter().map(|&(mode, _)| mode))),
        }
    }

    /// All choices for a group of interfaces.
    fn choices(&self, group: &[usize]) -> Vec<Vec<Choice>> {
        let mut all = vec![Vec::new()];
        for interface in group {
            let mut of_interface = vec![Some(Side::Positive), Some(Side::Negative)];
            let is_left = self.left.is_some_and(|(left, _)| left == *interface);
            if !is_left && self.system.metadata().sliding.contains(interface) {
                of_interface.push(None);
            }
            let longer = all.iter().flat_map(|begun| {
                of_interface.iter().map(move |&choice| {
                    let mut choices: Vec<Choice> = begun.clone();
                    choices.push(choice);
                    choices
                })
            });
            all = longer.collect();
        }
        all
    }

    /// The interfaces that the point is on, by groups of those whose choices change how the fields fit
    /// at one another.
    fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for &one in &self.on {
            let mut group = vec![one];
            for known in std::mem::take(&mut groups) {
                if known.iter().any(|&other| self.are_coupled(one, other)) {
                    group.extend(known);
                } else {
                    groups.push(known);
                }
            }
            groups.push(group);
        }
        groups
    }

    /// Whether the choice at one of two interfaces changes how fast the field moves away from the
    /// other one.
    fn are_coupled(&self, one: usize, other: usize) -> bool {
        let changes = |interface: usize, of: usize| {
            [Side::Positive, Side::Negative].iter().any(|&own| {
                let mut rates = [Side::Positive, Side::Negative].iter().map(|&choice| {
                    let mut sides = self.sides.clone();
                    (sides[interface], sides[of]) = (Some(own), Some(choice));
                    let mode = self.settled(sides)?;
                    Some(self.rate(mode, interface))
                });
                let first = rates.next();
                rates.any(|rate| Some(rate) != first)
            })
        };
        changes(one, other) || changes(other, one)
    }

    /// The guards of a mode that stand for the interfaces of the point.
    fn active(&self, mode: Sys::Region) -> Active {
        let bounds = |&&interface: &&usize| self.system.side(mode, interface).is_some();
        let mut active = Active::default();
        for &interface in self.on.iter().filter(bounds) {
            let region = self.system.of_region(mode);
            if !region.may_slide.contains(&interface) {
                active.insert(interface);
                continue;
            }
            // a motion that may slide on a switch has a guard of its own for it
            let metadata = self.system.metadata();
            let guards = metadata.interfaces.len()..;
            let ends = guards.zip(metadata.ends);
            let own = ends.filter(|(_, end)| end.interface == interface && end.side.is_none());
            own.for_each(|(guard, _)| active.insert(guard));
        }
        active
    }
}
