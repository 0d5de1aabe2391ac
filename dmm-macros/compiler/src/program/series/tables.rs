//! The sums over coefficients of lower order, which are known before anything of an order is: they run
//! together, each in a lane of a table of coefficients.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::packs::{LANES, PAIR};
use super::recurrence::{Place, Recurrence, Sum};
use super::{Coefficient, SeriesResult, Sums};

/// Where the coefficients of slots are: in arrays, or in lanes of tables, which take the place of as
/// many arrays as they have lanes.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tables {
    /// The sums Σ uⱼ vₖ₋ⱼ, by their lanes.
    pub inner: Vec<[Place; 2]>,
    /// The sums Σ uⱼ uₖ₋ⱼ, by their lanes.
    pub half: Vec<Place>,
    /// By pack, the first lanes of its sums; a pair has tables of its own.
    pub packs: Vec<Vec<usize>>,
    /// The tables of two lanes.
    pairs: Vec<[Place; PAIR]>,
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
        let mut in_packs: BTreeSet<usize> = BTreeSet::new();
        let mut whole: BTreeSet<Place> = BTreeSet::new();
        for pack in packs {
            let recurrences = coefficients[pack.clone()].iter().map(|one| one.recurrence);
            let recurrences: Vec<Recurrence> = recurrences.collect();
            let mut lanes = Vec::new();
            if let &[first, second] = recurrences.as_slice() {
                for (a, b) in first.factors().into_iter().zip(second.factors()) {
                    if a == b {
                        whole.insert(a);
                    } else {
                        tables.add_pair([a, b]);
                    }
                }
            } else {
                let sums: Vec<Vec<Sum>> = recurrences.iter().map(Recurrence::sums).collect();
                let count = sums.first().map_or(0, Vec::len);
                let add = |number: usize| tables.add_pack(sums.iter().map(|of| of[number]));
                lanes.extend((0..count).map(add));
            }
            tables.packs.push(lanes);
            in_packs.extend(pack.clone());
        }
        let single = coefficients.iter().enumerate();
        let single = single.filter(|(index, _)| !in_packs.contains(index));
        let single: Vec<Recurrence> = single.map(|(_, one)| one.recurrence).collect();
        let of_results = || results.iter().flat_map(SeriesResult::sums);
        tables.first_single = [tables.inner.len(), tables.half.len()];
        if sums == Sums::Straight {
            for one in &single {
                whole.extend(tables.add_single(one));
            }
            whole.extend(of_results().flat_map(places));
        } else {
            let mut seen = BTreeSet::new();
            let all = single.iter().flat_map(Recurrence::sums).chain(of_results());
            for sum in all.filter(|sum| seen.insert(*sum)) {
                tables.add(sum);
            }
        }
        let recurrences = coefficients.iter().map(|one| one.recurrence);
        whole.extend(recurrences.flat_map(|one| one.whole_series()));
        let columns = tables.columns().into_iter().flatten();
        let in_lanes: BTreeSet<Place> = columns
            .chain(tables.pairs.iter().copied().flatten())
            .collect();
        let first = slots.start;
        let arrays = slots.map(Place::Slot);
        let arrays = arrays.filter(|slot| whole.contains(slot) || !in_lanes.contains(slot));
        tables.arrays = arrays.zip(first..).collect();
        tables.first = first + tables.arrays.len();
        let pairs = tables.pairs().map(|(pair, range)| (pair.to_vec(), range));
        let all: Vec<(Vec<Place>, Range<usize>)> = tables.shared().chain(pairs).collect();
        for (column, table) in all {
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

    /// What straight-line code of a recurrence in no pack takes: two sums with a factor in common by a table,
    /// others by arrays, the series of which are told.
    fn add_single(&mut self, recurrence: &Recurrence) -> Vec<Place> {
        match *recurrence {
            Recurrence::Power {
                base,
                own,
                derivative,
                ..
            } => {
                self.add_pair([own, derivative]);
                vec![base]
            }
            Recurrence::Pair {
                derivative, places, ..
            } => {
                self.add_pair(places);
                vec![derivative]
            }
            _ => recurrence.sums().into_iter().flat_map(places).collect(),
        }
    }

    /// Gives two series a table, if they have none.
    fn add_pair(&mut self, pair: [Place; PAIR]) {
        if !self.pairs.contains(&pair) {
            self.pairs.push(pair);
        }
    }

    /// The series of each table with shared sums, by lane.
    fn columns(&self) -> [Vec<Place>; 3] {
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

    /// The arrays whose place each of these tables takes.
    pub fn ranges(&self) -> [Range<usize>; 3] {
        let mut end = self.first;
        self.columns().map(|column| {
            let start = end;
            end += column.len().next_multiple_of(LANES);
            start..end
        })
    }

    /// The tables with shared sums: their series, by lane, and the arrays whose place they take.
    pub fn shared(&self) -> impl Iterator<Item = (Vec<Place>, Range<usize>)> {
        self.columns().into_iter().zip(self.ranges())
    }

    /// The tables of pairs, and the arrays whose place they take.
    pub fn pairs(&self) -> impl Iterator<Item = ([Place; PAIR], Range<usize>)> {
        let [.., last] = self.ranges();
        let starts = (last.end..).step_by(PAIR);
        let pairs = self.pairs.iter().zip(starts);
        pairs.map(|(&pair, start)| (pair, start..start + PAIR))
    }

    /// How many arrays there are, with those whose place tables take.
    pub fn arrays(&self) -> usize {
        let [.., last] = self.ranges();
        last.end + PAIR * self.pairs.len()
    }
}

/// The series that a sum is over.
fn places(sum: Sum) -> Vec<Place> {
    match sum {
        Sum::Inner(of) => of.into(),
        Sum::Half(of) => vec![of],
    }
}
