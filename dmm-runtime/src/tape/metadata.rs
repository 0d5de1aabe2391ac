//! Names that are kept as long as the program runs, each set once.

use std::sync::{Mutex, PoisonError};

use dmm_compiler::model::{self, Sign};
use dmm_compiler::program;

use crate::contract::{Condition, Event, Metadata, RegionMetadata, Side, SlideEnd};

/// What is kept so far.
static KEPT: Mutex<Vec<&'static Metadata>> = Mutex::new(Vec::new());

/// The names of a program: those of a declaration that was compiled before are the same.
pub(super) fn kept(names: &program::Metadata) -> &'static Metadata {
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = kept.iter().find(|known| are_same(known, names)) {
        return known;
    }
    let metadata: &'static Metadata = Box::leak(Box::new(Metadata {
        name: text(&names.name),
        states: texts(&names.states),
        parameters: texts(&names.parameters),
        interfaces: texts(&names.interfaces),
        discrete: texts(&names.discrete),
        free: leaked(names.free.iter().copied()),
        switches: leaked(names.switches.iter().copied()),
        sliding: leaked(names.sliding.iter().copied()),
        ends: leaked(names.ends.iter().map(end)),
        events: leaked(names.events.iter().map(event)),
        conditions: leaked(names.conditions.iter().map(condition)),
        regions: leaked(names.regions.iter().map(region)),
    }));
    kept.push(metadata);
    metadata
}

fn are_same(known: &Metadata, names: &program::Metadata) -> bool {
    let mut conditions = known.conditions.iter().zip(&names.conditions);
    let mut regions = known.regions.iter().zip(&names.regions);
    known.name == names.name
        && known.states == names.states
        && known.parameters == names.parameters
        && known.interfaces == names.interfaces
        && known.discrete == names.discrete
        && known.free == names.free
        && known.switches == names.switches
        && known.sliding == names.sliding
        && known.ends.iter().copied().eq(names.ends.iter().map(end))
        && known
            .events
            .iter()
            .copied()
            .eq(names.events.iter().map(event))
        && known.conditions.len() == names.conditions.len()
        && known.regions.len() == names.regions.len()
        && conditions.all(|(known, names)| {
            known.region == names.region
                && known.condition == names.condition
                && known.quantities == names.quantities
                && known.keeps_sign == names.keeps_sign
        })
        && regions.all(|(known, names)| {
            known.name == names.name
                && known.conserved == names.conserved
                && known.neighbours == names.neighbours
                && known.on == names.on
                && known.may_slide == names.may_slide
                && known
                    .sides
                    .iter()
                    .copied()
                    .eq(names.sides.iter().map(|sign| sign.map(side)))
        })
}

/// The side of an interface on which g has a sign.
pub(super) fn side(sign: Sign) -> Side {
    match sign {
        Sign::Negative => Side::Negative,
        Sign::Positive => Side::Positive,
    }
}

fn end(one: &model::SlideEnd) -> SlideEnd {
    SlideEnd {
        interface: one.interface,
        side: one.side.map(side),
    }
}

fn event(one: &program::Event) -> Event {
    Event {
        interface: one.interface,
        rises: one.rises,
        falls: one.falls,
        region: one.region,
        clock: one.clock,
    }
}

fn condition(one: &program::Condition) -> Condition {
    Condition {
        region: one.region,
        condition: text(&one.condition),
        quantities: text(&one.quantities),
        keeps_sign: one.keeps_sign,
    }
}

fn region(one: &program::RegionMetadata) -> RegionMetadata {
    RegionMetadata {
        name: text(&one.name),
        conserved: texts(&one.conserved),
        sides: leaked(one.sides.iter().map(|sign| sign.map(side))),
        neighbours: leaked(one.neighbours.iter().copied()),
        on: leaked(one.on.iter().copied()),
        may_slide: leaked(one.may_slide.iter().copied()),
    }
}

fn text(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

fn texts(all: &[String]) -> &'static [&'static str] {
    leaked(all.iter().map(|one| text(one)))
}

fn leaked<T>(items: impl Iterator<Item = T>) -> &'static [T] {
    Box::leak(items.collect::<Vec<T>>().into_boxed_slice())
}
