//! The choice among invariants that differ by others: an energy, and not its sum with the square
//! of a momentum.

use std::collections::BTreeMap;

use super::candidate::Candidate;
use super::elimination::Entry;
use super::field::NARROW;

/// How often an invariant is made simpler by adding another one.
const MOST_REDUCTIONS: usize = 16;

/// How many even powers of states, as energies have, may be written for any other term.
pub(super) const MIXED_COST: usize = 3;

/// The candidate plus multiples of others of no higher degree, as long as that makes it simpler
/// and `is_new` holds.
pub(super) fn simplest(
    candidate: &Candidate,
    all: &[Candidate],
    cost: impl Fn(usize) -> usize + Copy,
    is_new: impl Fn(&[Entry]) -> bool,
) -> Vec<Entry> {
    let others = all.iter().filter(|other| {
        other.parameters == candidate.parameters && other.degree <= candidate.degree
    });
    let mut best = candidate.vector.clone();
    for _ in 0..MOST_REDUCTIONS {
        let simpler = others
            .clone()
            .filter_map(|other| simplified(&best, &other.vector, cost))
            .filter(|vector| is_new(vector));
        match simpler.min_by_key(|vector| total(vector, cost)) {
            Some(vector) => best = vector,
            None => break,
        }
    }
    best
}

/// `vector` plus the multiple of `other` that takes most away, if that leaves something simpler.
fn simplified(
    vector: &[Entry],
    other: &[Entry],
    cost: impl Fn(usize) -> usize,
) -> Option<Vec<Entry>> {
    let mut sum: BTreeMap<usize, u64> = vector.iter().copied().collect();
    let mut ratios: BTreeMap<u64, usize> = BTreeMap::new();
    for &(column, value) in other {
        if let Some(&entry) = sum.get(&column) {
            let ratio = NARROW.mul(NARROW.neg(entry), NARROW.inverse(value)?);
            *ratios.entry(ratio).or_default() += cost(column);
        }
    }
    let (&factor, _) = ratios
        .iter()
        .max_by_key(|&(&ratio, &taken)| (taken, ratio))?;
    for &(column, value) in other {
        let entry = sum.entry(column).or_default();
        *entry = NARROW.add(*entry, NARROW.mul(factor, value));
    }
    let sum: Vec<Entry> = sum.into_iter().filter(|&(_, entry)| entry != 0).collect();
    (total(&sum, &cost) < total(vector, &cost)).then_some(sum)
}

/// What the terms of a vector cost together.
pub(super) fn total(vector: &[Entry], cost: impl Fn(usize) -> usize) -> usize {
    vector.iter().map(|&(column, _)| cost(column)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_are_added_that_take_most_away() {
        // x² + 2xy + y² taken from x² + y² + 4xy leaves 2xy, or 2·that leaves −x² − y²
        let (square, vector) = ([(0, 1), (1, 2), (2, 1)], [(0, 1), (1, 4), (2, 1)]);
        let simpler = simplified(&vector, &square, |_| 1);
        assert_eq!(simpler, Some(vec![(1, 2)]));
        let cost = |column| if column == 1 { 3 } else { 1 };
        let simpler = simplified(&vector, &square, cost);
        assert_eq!(simpler, Some(vec![(0, NARROW.p - 1), (2, NARROW.p - 1)]));
        assert_eq!(simplified(&[(0, 1)], &square, |_| 1), None);
    }
}
