//! The last strategy, for any number of conserved quantities ψ(t, x): the field nearest to a
//! symmetric mean f̄ of f that is compatible with Λ^τ (MN-DMM, Schulz & Wan),
//!
//! ```text
//! f^τ = f̄ − Λ^τᵀ λ,      (Λ^τ Λ^τᵀ) λ = Λ^τ f̄ + ∂ₜ^τψ.
//! ```
//!
//! λ is solved for at run time. With w = f^τ, Λ⁺ = Λ^τᵀ(Λ^τΛ^τᵀ)⁻¹ and P = I − Λ⁺Λ^τ the
//! derivative of f^τ by any argument is P(∂f̄ − B) − Λ⁺C, where B is the derivative of Λ^τᵀλ
//! at constant λ and C that of Λ^τw + ∂ₜ^τψ at constant w: it follows from differentiating
//! w = f̄ − Λ^τᵀλ and Λ^τw + ∂ₜ^τψ = 0 and eliminating ∂λ.

use super::{Context, Explicit, Strategy};
use crate::algebra::{Dag, Id, Name};

/// The strategy; it always fits.
pub(super) fn derive(dag: &mut Dag, context: &Context<'_>) -> Strategy {
    // `[` is not allowed in an identifier, so that no name of a declaration can clash
    let lambda = symbols("λ", context.multiplier.len());
    let field = symbols("w", context.states.len());
    let pulled_back = transposed_product(dag, context.discrete_multiplier, &lambda, context);
    let constraint = constraint(dag, context, &field);
    let mean = Explicit::new(dag, context.mean.to_vec(), context.states);
    let transposed = Explicit::new(dag, pulled_back, context.states);
    let constraint = Explicit::new(dag, constraint, context.states);
    Strategy::MinimalNorm {
        mean,
        lambda,
        field,
        transposed_jacobian: transposed.jacobian,
        transposed_time_derivative: transposed.time_derivative,
        constraint_jacobian: constraint.jacobian,
        constraint_time_derivative: constraint.time_derivative,
    }
}

/// The variables `letter⟨1⟩`, `letter⟨2⟩`, …: a declaration can have `w[1]`, but no `⟨`.
pub(in crate::scheme) fn symbols(letter: &str, count: usize) -> Vec<Name> {
    (1..=count)
        .map(|index| Name::new(&format!("{letter}⟨{index}⟩")))
        .collect()
}

/// Λᵀ λ
fn transposed_product(
    dag: &mut Dag,
    rows: &[Vec<Id>],
    lambda: &[Name],
    context: &Context<'_>,
) -> Vec<Id> {
    let lambda: Vec<Id> = lambda.iter().map(|name| dag.variable(name)).collect();
    (0..context.states.len())
        .map(|state| {
            let terms: Vec<Id> = rows
                .iter()
                .zip(&lambda)
                .map(|(row, &factor)| dag.mul(row[state], factor))
                .collect();
            dag.sum(terms)
        })
        .collect()
}

/// Λ^τ w + ∂ₜ^τψ
fn constraint(dag: &mut Dag, context: &Context<'_>, field: &[Name]) -> Vec<Id> {
    let field: Vec<Id> = field.iter().map(|name| dag.variable(name)).collect();
    context
        .discrete_multiplier
        .iter()
        .zip(context.discrete_time_derivative)
        .map(|(row, &by_time)| {
            let mut terms: Vec<Id> = row
                .iter()
                .zip(&field)
                .map(|(&entry, &component)| dag.mul(entry, component))
                .collect();
            terms.push(by_time);
            dag.sum(terms)
        })
        .collect()
}
