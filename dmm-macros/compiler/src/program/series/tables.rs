//! The sums over coefficients of lower order, which are known before anything of an order is: they run
//! together, each in a lane of a table of coefficients.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::packs::LANES;
use super::recurrence::{Place, Sum};
use super::{Coefficient, SeriesResult, Sums};

/// Where the coefficients of slots are: in arrays, or in lanes of tables, which take the place of as
/// many arrays as they have lanes.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tables {
    /// The sums Σ uⱼ vₖ₋ⱼ, by their lanes.
    pub inner: Vec<[Place; 2]>,
    /// The sums Σ uⱼ uₖ₋ⱼ, by their lanes.
    pub half: Vec<Place>,
    /// By pack, the first lanes of its sums.
    pub packs: Vec<Vec<usize>>,
    /// The first lanes of both kinds that belong to no pack.
    pub first_single: [usize; 2],
    /// The numbers of the arrays of slots that have one.
    arrays: BTreeMap<Place, usize>,
    /// The first lanes of the other slots.
    lanes: BTreeMap<Place, Lane>,
    /// The first array behind these.
    first: usize,
}

/// A lane of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lane {
    /// The arrays whose place the table takes.
    pub table: Range<usize>,
    /// The number of the lane.
    pub number: usize,
}

impl Tables {
    /// Those of sums that run together: first those of packs, each in as many lanes as a vector has, then the
    /// others, those of nodes as deep side by side.
    pub(super) fn new(
        (coefficients, packs): (&[Coefficient], &[Range<usize>]),
        results: &[SeriesResult],
        slots: Range<usize>,
        sums: Sums,
    ) -> Self {
        let mut tables = Self::default();
        for pack in packs {
            let sums: Vec<Vec<Sum>> = (coefficients[pack.clone()].iter())
                .map(|one| one.recurrence.sums())
                .collect();
            let count = sums.first().map_or(0, Vec::len);
            let lanes = (0..count).map(|number| tables.add_pack(sums.iter().map(|of| of[number])));
            let lanes = lanes.collect();
            tables.packs.push(lanes);
        }
        let in_packs: BTreeSet<usize> = packs.iter().cloned().flatten().collect();
        let single = coefficients.iter().enumerate();
        let single = single.filter(|(index, _)| !in_packs.contains(index));
        let of_nodes = single.flat_map(|(_, one)| one.recurrence.sums());
        let all = of_nodes.chain(results.iter().flat_map(SeriesResult::sums));
        tables.first_single = [tables.inner.len(), tables.half.len()];
        if sums != Sums::Straight {
            let mut seen = BTreeSet::new();
            for sum in all.filter(|sum| seen.insert(*sum)) {
                tables.add(sum);
            }
        }
        let recurrences = coefficients.iter().map(|one| one.recurrence);
        let mut whole: BTreeSet<Place> = recurrences.flat_map(|one| one.whole_series()).collect();
        if sums == Sums::Straight {
            // what is in no pack has sums over arrays
            let single = coefficients.iter().enumerate();
            let single = single.filter(|(index, _)| !in_packs.contains(index));
            let sums = single.flat_map(|(_, one)| one.recurrence.sums());
            whole.extend(
                sums.chain(results.iter().flat_map(SeriesResult::sums))
                    .flat_map(places),
            );
        }
        let in_lanes: BTreeSet<Place> = tables.columns().into_iter().flatten().collect();
        let first = slots.start;
        let arrays = slots.map(Place::Slot);
        let arrays = arrays.filter(|slot| whole.contains(slot) || !in_lanes.contains(slot));
        tables.arrays = arrays.zip(first..).collect();
        tables.first = first + tables.arrays.len();
        for (column, table) in tables.columns().into_iter().zip(tables.ranges()) {
            for (number, place) in column.into_iter().enumerate() {
                if matches!(place, Place::Slot(_)) && !tables.arrays.contains_key(&place) {
                    let table = table.clone();
                    tables.lanes.entry(place).or_insert(Lane { table, number });
                }
            }
        }
        tables
    }

    /// Gives a sum a lane.
    fn add(&mut self, sum: Sum) {
        match sum {
            Sum::Inner(of) => self.inner.push(of),
            Sum::Half(of) => self.half.push(of),
        }
    }

    /// Gives the sums of a pack the lanes of a vector, all of them: the first of these lanes.
    fn add_pack(&mut self, sums: impl Iterator<Item = Sum> + Clone) -> usize {
        let lane = match sums.clone().next() {
            Some(Sum::Half(_)) => self.half.len(),
            _ => self.inner.len(),
        };
        for sum in sums.cycle().take(LANES) {
            self.add(sum);
        }
        lane
    }

    /// The series of each table, by lane.
    pub fn columns(&self) -> [Vec<Place>; 3] {
        let [first, second] = [0, 1].map(|side| self.inner.iter().map(|of| of[side]).collect());
        [first, second, self.half.clone()]
    }

    /// The number of the array of a slot, if it has one.
    pub fn array(&self, slot: Place) -> Option<usize> {
        self.arrays.get(&slot).copied()
    }

    /// The first lane of a slot that has no array.
    pub fn lane(&self, slot: Place) -> Option<&Lane> {
        self.lanes.get(&slot)
    }

    /// The arrays whose place each table takes.
    pub fn ranges(&self) -> [Range<usize>; 3] {
        let mut end = self.first;
        self.columns().map(|column| {
            let start = end;
            end += column.len().next_multiple_of(LANES);
            start..end
        })
    }

    /// How many arrays there are, with those whose place tables take.
    pub fn arrays(&self) -> usize {
        let [.., last] = self.ranges();
        last.end
    }
}

/// The series that a sum is over.
fn places(sum: Sum) -> Vec<Place> {
    match sum {
        Sum::Inner(of) => of.into(),
        Sum::Half(of) => vec![of],
    }
}
