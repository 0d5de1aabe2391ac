//! Sign patterns: on which sides of the interfaces a region is, and that each pattern is there
//! once.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use proc_macro2::Ident;

use super::Resolver;
use super::names::{Kind, is_meant_to_be_unused};
use crate::diagnostics::catalogue::check as codes;
use crate::model::{Interface, Side, Sign};
use crate::syntax::{Condition, Declaration, Item, RegionItem, Relation};

impl Resolver<'_> {
    /// The sign pattern, if every condition is in order.
    pub(super) fn sides(&mut self, region: &RegionItem) -> Option<Vec<Side>> {
        if region.conditions.is_empty() {
            let (code, message) = match self.regions.interfaces.first() {
                // what is wrong with the interface has been reported
                Some(None) => return None,
                Some(Some(Interface { ident: interface, .. })) => (
                    codes::REGION_WITHOUT_SIDE,
                    format!(
                        "on which side is the region `{}`? Write `region {} where {interface} > 0` (or `< 0`)",
                        region.ident, region.ident
                    ),
                ),
                None => (
                    codes::REGION_WITHOUT_INTERFACE,
                    "a region is bounded by an interface: declare `interface name = …;` and write `where name > 0`, or leave out the region and write its items at the top level".into(),
                ),
            };
            self.report(code, &region.ident, message);
            return None;
        }
        let sides: Vec<Option<Side>> = region
            .conditions
            .iter()
            .map(|condition| self.side(condition))
            .collect();
        let sides: Vec<Side> = sides.into_iter().collect::<Option<_>>()?;
        for (index, side) in sides.iter().enumerate() {
            if let Some(condition) = region.conditions.get(index)
                && sides
                    .iter()
                    .take(index)
                    .any(|earlier| earlier.interface == side.interface)
            {
                let message = format!("`{}` stands twice in this pattern", condition.interface);
                self.report(codes::SIDE_TWICE, &condition.interface, message);
                return None;
            }
        }
        Some(sides)
    }

    fn side(&mut self, condition: &Condition) -> Option<Side> {
        let use_of = format!("name {} 0", condition.relation.symbol());
        let interface = self.interface_named(&condition.interface, &use_of)?;
        let sign = match condition.relation {
            Relation::Less => Sign::Negative,
            Relation::Greater => Sign::Positive,
        };
        Some(Side { interface, sign })
    }

    /// The number of the interface `ident`; if it is none, that is reported with how the name of one
    /// is used there.
    pub(super) fn interface_named(&mut self, ident: &Ident, use_of: &str) -> Option<usize> {
        let text = ident.to_string();
        let message = match self.scope.names.get(&text).map(|symbol| symbol.kind) {
            Some(Kind::Interface) => {
                let mut known = self.regions.interfaces.iter();
                return known
                    .position(|known| known.as_ref().is_some_and(|known| known.ident == *ident));
            }
            // an interface was meant to be declared under this name
            Some(_) if self.scope.names.is_refused(&text) => return None,
            Some(kind) => {
                self.scope.names.mark_used(&text);
                format!(
                    "`{text}` is {}, not an interface: declare `interface name = {text};` and write `{use_of}`",
                    kind.article(),
                )
            }
            None => match self.scope.names.closest(&text, &[Kind::Interface]) {
                Some(candidate) => {
                    format!("there is no interface `{text}`; did you mean `{candidate}`?")
                }
                None => format!("there is no interface `{text}`: declare `interface {text} = …;`"),
            },
        };
        self.report(codes::NOT_AN_INTERFACE, ident, message);
        None
    }

    /// The sign patterns of the regions cover the space, and no two of them overlap.
    pub(super) fn patterns(&mut self, declaration: &Declaration, items: &[&RegionItem]) {
        let interfaces = declaration.items.iter().filter_map(|item| match item {
            Item::Interface(item) => Some(&item.definition.ident),
            _ => None,
        });
        let interfaces: Vec<&Ident> = interfaces.collect();
        let Some(&first) = interfaces.first() else {
            return;
        };
        let declared = declaration.items.iter();
        let events = declared
            .filter(|item| matches!(item, Item::Event(_)))
            .count();
        if items.is_empty() {
            // a wrong event was meant to be at an interface
            if self.regions.events.len() < events {
                return;
            }
            interfaces
                .iter()
                .for_each(|interface| self.no_region(interface));
            let mut known = self.regions.interfaces.iter().flatten();
            if self.regions.events.is_empty() && !known.any(|one| one.is_switch) {
                // nothing switches there: the system is that without the interfaces
                self.regions.interfaces.clear();
            }
            return;
        }
        let read = items.iter().map(|item| Pattern::new(item, &interfaces));
        // with a wrong pattern it is not known which side was meant
        let Some(patterns) = read.collect::<Option<Vec<Pattern>>>() else {
            return;
        };
        if self.overlap(items, &patterns, &interfaces) {
            return;
        }
        for (index, interface) in interfaces.iter().enumerate() {
            if patterns.iter().all(|pattern| pattern.get(index).is_none()) {
                self.no_region(interface);
            }
        }
        let all: Vec<&Pattern> = patterns.iter().collect();
        let mut missing = Vec::new();
        uncovered(&all, &mut Pattern::default(), &mut missing);
        self.regions.lacks_region |= !missing.is_empty();
        for pattern in missing {
            let text = pattern.text(&interfaces);
            let place = pattern
                .0
                .first()
                .and_then(|&(interface, _)| interfaces.get(interface));
            let message = format!(
                "there is no region where `{text}`: declare `region name where {text} {{ … }}`"
            );
            self.report(codes::REGION_MISSING, *place.unwrap_or(&first), message);
        }
    }

    /// Whether an event happens at an interface, or a formula switches there.
    fn has_event(&self, ident: &Ident) -> bool {
        let interfaces = self.regions.interfaces.iter().enumerate();
        let mut named = interfaces.filter(|(_, interface)| match interface {
            Some(interface) => interface.ident == *ident,
            None => false,
        });
        let events = &self.regions.events;
        named.any(|(index, interface)| {
            let is_switch = interface.as_ref().is_some_and(|one| one.is_switch);
            is_switch || events.iter().any(|event| event.interface == index)
        })
    }

    /// Warns of an interface that bounds no region.
    fn no_region(&mut self, interface: &Ident) {
        if is_meant_to_be_unused(interface) || self.has_event(interface) {
            return;
        }
        let message = format!(
            "the interface `{interface}` bounds no region and has no event, so that nothing changes there: write `region … where {interface} > 0 {{ … }}` and `region … where {interface} < 0 {{ … }}`, with the `der` items in them"
        );
        self.warn(codes::NO_REGION, interface, message);
    }

    /// Whether patterns of two regions overlap, which is reported.
    fn overlap(
        &mut self,
        items: &[&RegionItem],
        patterns: &[Pattern],
        interfaces: &[&Ident],
    ) -> bool {
        let mut overlaps = false;
        for (later, (item, pattern)) in items.iter().zip(patterns).enumerate() {
            let earlier = items.iter().zip(patterns).take(later);
            let mut both = earlier.filter_map(|(one, other)| Some((one, pattern.and(other)?)));
            let Some((one, both)) = both.next() else {
                continue;
            };
            overlaps = true;
            let text = both.text(interfaces);
            let message = format!(
                "the regions `{}` and `{}` overlap: both are where `{text}`",
                one.ident, item.ident,
            );
            self.report(codes::REGIONS_OVERLAP, &item.ident, message);
        }
        overlaps
    }
}

/// At most so many missing patterns are named.
const MOST_MISSING: usize = 4;

/// Interfaces, by their numbers in increasing order, and how their functions compare with zero.
#[derive(Clone, Debug, Default)]
struct Pattern(Vec<(usize, Relation)>);

impl Pattern {
    /// That of a region; nothing if something is wrong with it.
    fn new(item: &RegionItem, interfaces: &[&Ident]) -> Option<Self> {
        let sides = item.conditions.iter().map(|condition| {
            let of = |interface: &&Ident| **interface == condition.interface;
            Some((interfaces.iter().position(of)?, condition.relation))
        });
        let mut sides: Vec<(usize, Relation)> = sides.collect::<Option<_>>()?;
        sides.sort_by_key(|&(interface, _)| interface);
        let is_twice = sides.windows(2).any(|pair| pair[0].0 == pair[1].0);
        (!sides.is_empty() && !is_twice).then_some(Self(sides))
    }

    fn get(&self, interface: usize) -> Option<Relation> {
        let side = self.0.iter().find(|side| side.0 == interface);
        side.map(|&(_, relation)| relation)
    }

    /// The pattern of what lies in both, if there are signs that both have.
    fn and(&self, other: &Self) -> Option<Self> {
        let agree = |&(interface, relation): &(usize, Relation)| {
            other.get(interface).is_none_or(|other| other == relation)
        };
        if !self.0.iter().all(agree) {
            return None;
        }
        let more = other.0.iter().filter(|side| self.get(side.0).is_none());
        let mut both: Vec<(usize, Relation)> = self.0.iter().chain(more).copied().collect();
        both.sort_by_key(|&(interface, _)| interface);
        Some(Self(both))
    }

    /// `wall > 0 and floor < 0`
    fn text(&self, interfaces: &[&Ident]) -> String {
        let side = |&(interface, relation): &(usize, Relation)| {
            let name = interfaces.get(interface).map(ToString::to_string);
            format!("{} {} 0", name.unwrap_or_default(), relation.symbol())
        };
        let sides: Vec<String> = self.0.iter().map(side).collect();
        sides.join(" and ")
    }
}

/// The patterns within `at` that none of `patterns`, which all have signs in common with it,
/// covers: an interface is looked at only where one of them is bounded by it.
fn uncovered(patterns: &[&Pattern], at: &mut Pattern, missing: &mut Vec<Pattern>) {
    if missing.len() >= MOST_MISSING {
        return;
    }
    if patterns.is_empty() {
        let mut found = at.clone();
        found.0.sort_by_key(|&(interface, _)| interface);
        missing.push(found);
        return;
    }
    // by interface, how many patterns lie on either side of it
    let mut open: BTreeMap<usize, [usize; 2]> = BTreeMap::new();
    for &(interface, relation) in patterns.iter().flat_map(|pattern| &pattern.0) {
        if at.get(interface).is_none() {
            open.entry(interface).or_default()[usize::from(relation == Relation::Less)] += 1;
        }
    }
    // most patterns on one side leave most of what is missing together on the other one
    let most = |(interface, [greater, less]): (&usize, &[usize; 2])| {
        (greater + less, greater.abs_diff(*less), Reverse(*interface))
    };
    // without an interface, the first pattern covers all of it
    let Some((_, _, Reverse(interface))) = open.iter().map(most).max() else {
        return;
    };
    for relation in [Relation::Greater, Relation::Less] {
        let has = |pattern: &&&Pattern| pattern.get(interface).is_none_or(|own| own == relation);
        let within: Vec<&Pattern> = patterns.iter().filter(has).copied().collect();
        at.0.push((interface, relation));
        uncovered(&within, at, missing);
        at.0.pop();
    }
}
