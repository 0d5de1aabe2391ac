//! Denominators as products of powers of factors, and what two of them have together.

use super::Obstacle;

/// Π factorᵐ, the factors by their index in the table and rising.
pub(super) type Factors = Vec<(usize, u32)>;

/// Both lists of factors in one, equal factors with their multiplicities combined.
pub(super) fn merge_factors(
    a: &[(usize, u32)],
    b: &[(usize, u32)],
    combine: impl Fn(u32, u32) -> Option<u32>,
) -> Result<Factors, Obstacle> {
    let mut merged = a.to_vec();
    for &(index, multiplicity) in b {
        match merged.binary_search_by_key(&index, |factor| factor.0) {
            Ok(position) => {
                if let Some((_, known)) = merged.get_mut(position) {
                    *known = combine(*known, multiplicity).ok_or(Obstacle::TooLarge)?;
                }
            }
            Err(position) => merged.insert(position, (index, multiplicity)),
        }
    }
    Ok(merged)
}

/// What `common` has and `own` has not.
pub(super) fn missing_factors(common: &[(usize, u32)], own: &[(usize, u32)]) -> Factors {
    common
        .iter()
        .map(|&(index, multiplicity)| {
            let known = own.iter().find(|factor| factor.0 == index);
            (index, multiplicity - known.map_or(0, |factor| factor.1))
        })
        .filter(|&(_, multiplicity)| multiplicity > 0)
        .collect()
}
