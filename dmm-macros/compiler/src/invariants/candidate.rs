//! What may become an invariant: vectors of the null space, before their coefficients are known.

use std::collections::BTreeSet;

use super::ansatz::Parameters;
use super::elimination::Entry;

/// A vector of the null space: entries by monomial.
pub(super) struct Candidate {
    pub(super) vector: Vec<Entry>,
    pub(super) degree: u32,
    pub(super) parameters: Parameters,
}

/// The monomials of which vectors are made, in rising order.
pub(super) fn occurring(candidates: &[Candidate]) -> Vec<usize> {
    let vectors = candidates.iter().flat_map(|one| &one.vector);
    let columns: BTreeSet<usize> = vectors.map(|&(column, _)| column).collect();
    columns.into_iter().collect()
}
