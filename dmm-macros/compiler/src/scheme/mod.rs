//! The scheme: what the Discrete Multiplier Method derives from a proved [`Model`].
//!
//! [`derive()`] takes a proved model and gives its scheme. A one-step map x₁ = x₀ + τ f^τ conserves ψ
//! exactly if a discrete multiplier Λ^τ and ∂ₜ^τψ telescope and f^τ is orthogonal to them
//! (Wan, Bihlo & Nave 2017):
//!
//! ```text
//! Λ^τ (x₁ − x₀) + ∂ₜ^τψ (t₁ − t₀) = ψ(t₁, x₁) − ψ(t₀, x₀),      Λ^τ f^τ + ∂ₜ^τψ = 0.
//! ```
//!
//! Λ^τ and ∂ₜ^τψ are the symmetric divided differences of ψ; f^τ is made from them by the
//! first [`Strategy`] that fits, and what was derived is proved before it is handed on.

mod checked;
mod degree;
mod derivation;
mod proofs;
mod solvability;
mod strategy;
mod switching;

use crate::algebra::{Dag, Id};
use crate::model::{Model, Region};
use crate::proofs::{DomainCondition, ProvedRegion};
pub use derivation::derive;
pub use proofs::{Evidence, Proofs};
pub use solvability::Solvability;
pub use strategy::{Conditional, Explicit, Obstacle, Pairing, Refusal, Strategy};
pub use switching::SwitchingScheme;

/// The derived integrator of a whole system.
#[derive(Debug)]
pub struct Scheme {
    /// The declaration that it was derived from. All nodes below are those of its DAG.
    pub model: Model,
    /// ∂ₜg and ∇g of every interface.
    pub interfaces: Vec<SwitchingScheme>,
    /// One scheme a region, in the order of [`Model::regions`].
    pub regions: Vec<RegionScheme>,
}

/// The derived scheme of one region. Ends of a step are the variables `x₀`, `x₁`, `t₀`, `t₁`.
#[derive(Debug)]
pub struct RegionScheme {
    /// What was proved of the region, with Λ = ∇ψ and ∂ₜψ.
    pub proved: ProvedRegion,
    /// The interfaces that the flow of the region never crosses: see [`Proved::levels`](crate::proofs::Proved::levels).
    pub levels: Vec<usize>,
    /// Λ^τ, M×N, over the two ends.
    pub discrete_multiplier: Vec<Vec<Id>>,
    /// ∂ₜ^τψ, M, over the two ends.
    pub discrete_time_derivative: Vec<Id>,
    /// How f^τ is made.
    pub strategy: Strategy,
    /// The strategies that come before it and do not fit.
    pub refusals: Vec<Refusal>,
    /// How the implicit equation of a step is solved.
    pub solvability: Solvability,
    /// Whether neither f nor ψ depends on the time.
    pub autonomous: bool,
    /// ∂f/∂x, N×N, over `t` and the states.
    pub jacobian: Vec<Vec<Id>>,
    /// Which of the ψ are affine functions of t and x, with coefficients that depend on parameters
    /// alone.
    pub affine_quantities: Vec<bool>,
    /// Whether f = A x + b with A and b depending on parameters alone, so that the flow is exact.
    pub affine: bool,
    /// What was proved of the scheme.
    pub proofs: Proofs,
    /// The conditions of the proofs of ψ that a run has to check.
    pub checked: Vec<CheckedCondition>,
}

/// A condition under which quantities were proved to be conserved, and beyond which code has
/// values nevertheless.
#[derive(Debug)]
pub struct CheckedCondition {
    /// The region, as an index in [`Model::regions`].
    pub region: usize,
    /// The condition.
    pub condition: DomainCondition,
    /// The quantities, as indices in the region's
    /// [`conserved`](crate::model::Region::conserved).
    pub quantities: Vec<usize>,
    /// What is positive where the condition holds; of u ≠ 0 it is u, which keeps its sign.
    pub function: Id,
    /// Its derivatives.
    pub switching: SwitchingScheme,
    /// Whether the condition is one on parameters alone.
    pub is_fixed: bool,
}

impl CheckedCondition {
    /// The names of its quantities, which are those of `region`.
    pub fn names(&self, region: &Region) -> String {
        let quantities = self.quantities.iter();
        let names = quantities.filter_map(|&index| region.conserved.get(index));
        let names = names.map(|psi| psi.ident.to_string().trim_start_matches("r#").to_owned());
        names.collect::<Vec<String>>().join(", ")
    }

    /// Whether the function may have either sign, and has to keep it.
    pub fn keeps_sign(&self) -> bool {
        matches!(self.condition, DomainCondition::NonZero(_))
    }
}

impl Scheme {
    /// The checked conditions of all regions, in the order in which they are emitted.
    pub fn checked_conditions(&self) -> impl Iterator<Item = &CheckedCondition> {
        self.regions.iter().flat_map(|region| &region.checked)
    }

    /// The DAG of every node.
    pub fn dag(&self) -> &Dag {
        &self.model.dag
    }
}
