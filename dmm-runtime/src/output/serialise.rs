//! Solutions, statistics, points and transitions for serde.

use std::fmt::Debug;

use serde::ser::{SerializeMap, SerializeSeq, SerializeStruct};
use serde::{Serialize, Serializer};

use super::discrete::discrete;
use super::{EndedBy, Point, Solution, Transition, TransitionKind};
use crate::contract::System;
use crate::method::Method;

impl Serialize for EndedBy {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        serializer.serialize_str(match self {
            Self::EndTime => "end time",
            Self::Observer => "observer",
            Self::Error => "error",
        })
    }
}

/// As its [name](TransitionKind::name).
impl Serialize for TransitionKind {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        serializer.serialize_str(self.name())
    }
}

/// As `t`, `region` and `x`. The region is named as its variant is: names as they are declared are
/// those of a [`Solution`].
impl<R: Debug, const N: usize> Serialize for Point<R, N> {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        let region = format!("{:?}", self.region);
        point(self, &region, (N, &[]), serializer)
    }
}

/// As `t`, `interface` (its index), `from`, `to`, `kind`, `x`, `after`, `rate_from` and `rate_to`.
/// Regions are named as their variants are: names as they are declared are those of a [`Solution`].
impl<R: Debug, const N: usize> Serialize for Transition<R, N> {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        let (from, to) = (format!("{:?}", self.from), format!("{:?}", self.to));
        let sides = [(&*from, &[][..]), (&*to, &[])];
        transition(self, &self.interface, sides, N, serializer)
    }
}

/// As `system` (its name), `states` and `discrete` (their names), `parameters` (values by name),
/// `points`, `transitions`, `statistics` and `ended_by`. A point is `t`, `region` and `x`, a transition
/// `t`, `interface`, `from`, `to`, `kind`, `x`, `after`, `rate_from` and `rate_to`; regions and interfaces
/// are named as they are declared. Where there are discrete states, a point has their values as
/// `discrete`, and a transition as `discrete` and `discrete_after`.
impl<Sys: System<N>, Met: Method, const N: usize> Serialize for Solution<Sys, Met, N> {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        let (system, names) = (self.system(), self.system().metadata());
        let states = names.states.len();
        let points = self.points().iter().map(|point| Named {
            system,
            states,
            value: point,
        });
        let transitions = self.transitions().iter().map(|transition| Named {
            system,
            states,
            value: transition,
        });
        let parameters = names.parameters.iter().zip(system.parameters());
        let discrete = names.declared_discrete().map(|(_, name)| name);
        let mut fields = serializer.serialize_struct("Solution", 8)?;
        fields.serialize_field("system", names.name)?;
        fields.serialize_field("states", names.states)?;
        fields.serialize_field("discrete", &discrete.collect::<Vec<_>>())?;
        fields.serialize_field("parameters", &Map(parameters))?;
        fields.serialize_field("points", &Sequence(points))?;
        fields.serialize_field("transitions", &Sequence(transitions))?;
        fields.serialize_field("statistics", self.statistics())?;
        fields.serialize_field("ended_by", &self.ended_by())?;
        fields.end()
    }
}

/// A point or a transition with the names of its system.
struct Named<'a, Sys, T> {
    system: &'a Sys,
    states: usize,
    value: &'a T,
}

impl<Sys: System<N>, const N: usize> Serialize for Named<'_, Sys, Point<Sys::Region, N>> {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        let region = self.system.of_region(self.value.region).name;
        let discrete = discrete(self.system, self.value.region);
        point(self.value, region, (self.states, &discrete), serializer)
    }
}

impl<Sys: System<N>, const N: usize> Serialize for Named<'_, Sys, Transition<Sys::Region, N>> {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        let interface = self.system.metadata().guard_name(self.value.interface);
        let modes = [self.value.from, self.value.to];
        let names = modes.map(|mode| self.system.of_region(mode).name);
        let values = modes.map(|mode| discrete(self.system, mode));
        let sides = [(names[0], &values[0][..]), (names[1], &values[1])];
        transition(self.value, &interface, sides, self.states, serializer)
    }
}

fn point<R, Ser: Serializer, const N: usize>(
    point: &Point<R, N>,
    region: &str,
    (states, discrete): (usize, &[f64]),
    serializer: Ser,
) -> Result<Ser::Ok, Ser::Error> {
    let count = 3 + usize::from(!discrete.is_empty());
    let mut fields = serializer.serialize_struct("Point", count)?;
    fields.serialize_field("t", &point.t)?;
    fields.serialize_field("region", region)?;
    fields.serialize_field("x", &point.x.as_slice()[..states.min(N)])?;
    if !discrete.is_empty() {
        fields.serialize_field("discrete", discrete)?;
    }
    fields.end()
}

fn transition<R, Ser: Serializer, const N: usize>(
    transition: &Transition<R, N>,
    interface: &impl Serialize,
    [(from, discrete), (to, discrete_after)]: [(&str, &[f64]); 2],
    states: usize,
    serializer: Ser,
) -> Result<Ser::Ok, Ser::Error> {
    let states = states.min(N);
    let count = 9 + 2 * usize::from(!discrete.is_empty());
    let mut fields = serializer.serialize_struct("Transition", count)?;
    fields.serialize_field("t", &transition.t)?;
    fields.serialize_field("interface", interface)?;
    fields.serialize_field("from", from)?;
    fields.serialize_field("to", to)?;
    fields.serialize_field("kind", &transition.kind)?;
    fields.serialize_field("x", &transition.x.as_slice()[..states])?;
    fields.serialize_field("after", &transition.after.as_slice()[..states])?;
    if !discrete.is_empty() {
        fields.serialize_field("discrete", discrete)?;
        fields.serialize_field("discrete_after", discrete_after)?;
    }
    fields.serialize_field("rate_from", &transition.rate_from)?;
    fields.serialize_field("rate_to", &transition.rate_to)?;
    fields.end()
}

/// The items of an iterator.
struct Sequence<I>(I);

impl<I: Iterator<Item: Serialize> + Clone> Serialize for Sequence<I> {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        let items = self.0.clone();
        let mut sequence = serializer.serialize_seq(items.size_hint().1)?;
        for item in items {
            sequence.serialize_element(&item)?;
        }
        sequence.end()
    }
}

/// The entries of an iterator.
struct Map<I>(I);

impl<K: Serialize, V: Serialize, I: Iterator<Item = (K, V)> + Clone> Serialize for Map<I> {
    fn serialize<Ser: Serializer>(&self, serializer: Ser) -> Result<Ser::Ok, Ser::Error> {
        let entries = self.0.clone();
        let mut map = serializer.serialize_map(entries.size_hint().1)?;
        for (key, value) in entries {
            map.serialize_entry(&key, &value)?;
        }
        map.end()
    }
}
