//! The sums over coefficients of lower order, which are known before anything of an order is: they run
//! together, each in a lane of a table of coefficients.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::recurrence::{Place, Sum};
use super::{Coefficient, SeriesResult};

/// Tables have a multiple of so many lanes.
const LANES: usize = 4;

/// Where the coefficients of slots are: in arrays, or in lanes of tables, which take the place of as
/// many arrays as they have lanes.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tables {
    /// The sums Σ uⱼ vₖ₋ⱼ, by their lanes.
    pub inner: Vec<[Place; 2]>,
    /// The sums Σ uⱼ uₖ₋ⱼ, by their lanes.
    pub half: Vec<Place>,
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
    /// No tables: an array for each slot.
    pub(super) fn none(slots: Range<usize>) -> Self {
        Self {
            arrays: slots
                .clone()
                .map(|slot| (Place::Slot(slot), slot))
                .collect(),
            first: slots.end,
            ..Self::default()
        }
    }

    /// Those of sums that run together. Sums of equal operations, of nodes as deep, lie side by side.
    pub(super) fn new(
        coefficients: &[Coefficient],
        results: &[SeriesResult],
        slots: Range<usize>,
        depth: impl Fn(&Coefficient) -> usize,
    ) -> Self {
        let mut tables = Self::default();
        let mut of_nodes: Vec<&Coefficient> = coefficients.iter().collect();
        of_nodes.sort_by_cached_key(|one| depth(one));
        let of_nodes = of_nodes.iter().flat_map(|one| one.recurrence.sums());
        let all = of_nodes.chain(results.iter().flat_map(SeriesResult::sums));
        let mut seen = BTreeSet::new();
        for sum in all.filter(|sum| seen.insert(*sum)) {
            match sum {
                Sum::Inner(of) => tables.inner.push(of),
                Sum::Half(of) => tables.half.push(of),
            }
        }
        let recurrences = coefficients.iter().map(|one| one.recurrence);
        let whole: BTreeSet<Place> = recurrences.flat_map(|one| one.whole_series()).collect();
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
