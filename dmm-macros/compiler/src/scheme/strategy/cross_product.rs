//! The second strategy: M = N − 1 conserved quantities ψ(x). Their common level sets are
//! curves along the generalised cross product of the rows of Λ,
//!
//! ```text
//! (×Λ)ᵢ = (−1)ⁱ det(Λ without column i),      f = α · ×Λ,      f^τ = α(t̄, x̄) · ×Λ^τ,
//! ```
//!
//! and ×Λ^τ is orthogonal to every row of Λ^τ whatever α is. α has a pole wherever the
//! invariants become dependent and f does not vanish; then the strategy does not fit.

use super::regularity::{poles, regular_quotient};
use super::{Context, Explicit, Obstacle, Strategy, midpoint};
use crate::algebra::{Dag, Id, is_proved_zero};

/// Minors are expanded symbolically up to this many states: N = 5 would take 5·24 products
/// where the minimal-norm solve takes about 60.
const MOST_STATES: usize = 4;

/// The strategy, or why it does not fit.
pub(super) fn derive(dag: &mut Dag, context: &Context<'_>) -> Result<Strategy, Obstacle> {
    let (states, count) = (context.states.len(), context.multiplier.len());
    if states < 3 || count + 1 != states {
        return Err(format!(
            "it takes N ≥ 3 states with N − 1 conserved quantities, and here N = {states}, M = {count}"
        )
        .into());
    }
    if states > MOST_STATES {
        return Err(format!(
            "the minors of {count} conserved quantities cost more than the minimal-norm solve"
        )
        .into());
    }
    if context
        .time_derivative
        .iter()
        .any(|&by_time| !is_proved_zero(dag, by_time))
    {
        return Err("ψ depends on the time".into());
    }
    let product = cross_product(dag, context.multiplier);
    let alpha = alpha(dag, context, &product)?;
    let value = assemble(dag, context, alpha, context.discrete_multiplier);
    let field = Explicit::new(dag, value, context.states);
    Ok(Strategy::CrossProduct { alpha, field })
}

/// f^τ from the rows of Λ^τ, which may be opaque symbols.
pub(in crate::scheme) fn assemble(
    dag: &mut Dag,
    context: &Context<'_>,
    alpha: Id,
    multiplier: &[Vec<Id>],
) -> Vec<Id> {
    let alpha = midpoint(dag, alpha, context.states);
    cross_product(dag, multiplier)
        .into_iter()
        .map(|component| dag.mul(alpha, component))
        .collect()
}

/// The factor of f = α · ×Λ, proved for every component.
fn alpha(dag: &mut Dag, context: &Context<'_>, product: &[Id]) -> Result<Id, Obstacle> {
    let poles = poles(
        dag,
        context
            .field
            .iter()
            .chain(context.multiplier.iter().flatten())
            .copied(),
    );
    let mut refusal = Obstacle::from("the conserved quantities are dependent everywhere");
    for (&component, &minor) in context.field.iter().zip(product) {
        if is_proved_zero(dag, minor) {
            continue;
        }
        match regular_quotient(dag, component, minor, context.states, &poles) {
            Ok(alpha) if is_factor(dag, context.field, alpha, product) => return Ok(alpha),
            Ok(_) => refusal = "f is not proved to be parallel to the cross product of ∇ψ".into(),
            Err(obstacle) => refusal = obstacle,
        }
    }
    Err(refusal)
}

/// Whether f − α · ×Λ is proved to be zero.
fn is_factor(dag: &mut Dag, field: &[Id], alpha: Id, product: &[Id]) -> bool {
    field.iter().zip(product).all(|(&component, &minor)| {
        let multiple = dag.mul(alpha, minor);
        let difference = dag.sub(component, multiple);
        is_proved_zero(dag, difference)
    })
}

/// The generalised cross product of N − 1 rows of N entries.
fn cross_product(dag: &mut Dag, rows: &[Vec<Id>]) -> Vec<Id> {
    (0..=rows.len())
        .map(|component| {
            let columns: Vec<usize> = (0..=rows.len()).filter(|&c| c != component).collect();
            let minor = determinant(dag, rows, &columns);
            if component % 2 == 0 {
                minor
            } else {
                dag.neg(minor)
            }
        })
        .collect()
}

/// The determinant of the square matrix of `columns` of `rows`, by the first row.
fn determinant(dag: &mut Dag, rows: &[Vec<Id>], columns: &[usize]) -> Id {
    let Some((first, rest)) = rows.split_first() else {
        return dag.integer(1);
    };
    let mut sum = dag.integer(0);
    for (position, &column) in columns.iter().enumerate() {
        let mut others = columns.to_vec();
        others.remove(position);
        let minor = determinant(dag, rest, &others);
        let term = dag.mul(first[column], minor);
        sum = if position % 2 == 0 {
            dag.add(sum, term)
        } else {
            dag.sub(sum, term)
        };
    }
    sum
}
