//! Where several regions meet at interfaces.

use crate::model::{Model, Side, Sign};

/// A part of interfaces with the regions around it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place {
    /// The interfaces; none of a single region.
    pub(super) on: Vec<usize>,
    /// The regions around it: where bit k of the number is 1, on the side g > 0 of interface k.
    pub(super) regions: Vec<usize>,
    /// The sides of the other interfaces.
    pub(super) sides: Vec<Side>,
}

impl Place {
    /// A region on no interface.
    pub(super) fn of_region(model: &Model, region: usize) -> Self {
        Self {
            on: Vec::new(),
            regions: vec![region],
            sides: model.regions[region].sides.clone(),
        }
    }
}

/// The places on all of these interfaces at once where each of them bounds regions.
pub(super) fn places(model: &Model, on: &[usize]) -> Vec<Place> {
    let mut found = Vec::new();
    let begun = Place {
        on: on.to_vec(),
        regions: Vec::new(),
        sides: Vec::new(),
    };
    around(model, begun, &mut found);
    found.retain(|place: &Place| (0..on.len()).all(|bit| changes(place, bit)));
    found
}

/// All choices of the regions that are left.
fn around(model: &Model, place: Place, found: &mut Vec<Place>) {
    let corner = place.regions.len();
    if corner == 1 << place.on.len() {
        if !found.contains(&place) {
            found.push(place);
        }
        return;
    }
    for (number, region) in model.regions.iter().enumerate() {
        if region.slide.is_some() {
            continue;
        }
        let mut next = place.clone();
        let fits = region.sides.iter().all(|side| {
            if let Some(bit) = place.on.iter().position(|&one| one == side.interface) {
                return side.sign == sign(corner, bit);
            }
            let known = place.sides.iter();
            let mut known = known.filter(|known| known.interface == side.interface);
            known.next().is_none_or(|known| known.sign == side.sign)
        });
        if !fits {
            continue;
        }
        for side in &region.sides {
            if !place.on.contains(&side.interface) && !next.sides.contains(side) {
                next.sides.push(*side);
            }
        }
        next.regions.push(number);
        around(model, next, found);
    }
}

/// On which side of interface number `bit` a corner lies.
pub(super) fn sign(corner: usize, bit: usize) -> Sign {
    if corner >> bit & 1 == 1 {
        Sign::Positive
    } else {
        Sign::Negative
    }
}

/// Whether another region lies behind interface number `bit` somewhere.
fn changes(place: &Place, bit: usize) -> bool {
    let regions = &place.regions;
    (0..regions.len()).any(|corner| regions[corner] != regions[corner ^ (1 << bit)])
}
