//! Symmetric divided differences: (expression ψ, variables v) → coefficients c over the two
//! ends of a step with
//!
//! ψ(v₁) − ψ(v₀) = Σ c_v (v₁ − v₀)   exactly, for all ends.
//!
//! They are the rows of the discrete multiplier Λ^τ (Wan, Bihlo & Nave 2017). Every node u of
//! the expression has a *local* rule Δu = Σ wᵢ Δuᵢ over its children uᵢ, with ū the mean and
//! Δu the difference of the values u₀, u₁ at the two ends:
//!
//! | node | Δ |
//! |---|---|
//! | u·v | ū Δv + v̄ Δu |
//! | u/v | (v̄ Δu − ū Δv)/(v₀v₁) |
//! | uⁿ | (Σ u₁ʲ u₀ⁿ⁻¹⁻ʲ) Δu |
//! | u^(p/q) | through w = u^(1/q), Δw = Δu/Σ w₁ʲ w₀^(q−1−j) |
//! | u^v | as exp(v ln u) |
//! | h(u) | h\[u₀, u₁\] Δu, as the file of the function says |
//!
//! Each rule is exact, symmetric under an exchange of the ends, and free of cancellation:
//! there is no quotient by Δ. They stand in `rules`, with their sums in `powers`; which of them a function
//! has is said in the folder `functions`. `chain` chains them backwards from the root.

mod chain;
mod ends;
mod expand;
mod powers;
mod rules;

use super::{Dag, Id, Name};
use chain::Step;
pub use ends::{at_end, at_midpoint, at_start};
use expand::expand_divided_differences;

/// The coefficient of each of `variables` in ψ(end) − ψ(start), ψ = `root`; other variables
/// are constants.
pub fn divided_difference(dag: &mut Dag, root: Id, variables: &[Name]) -> Vec<Id> {
    let root = expand_divided_differences(dag, root);
    let mut coefficients = Step::new(dag, root, variables).accumulate(root);
    variables
        .iter()
        .map(|name| {
            let terms = coefficients.remove(name).unwrap_or_default();
            dag.sum(terms.into_iter().rev())
        })
        .collect()
}
