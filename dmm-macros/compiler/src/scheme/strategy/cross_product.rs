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
use crate::algebra::linear::determinant;
use crate::algebra::{Dag, Id, is_proved_zero};

/// Minors are expanded symbolically up to this many states: N = 5 would take 5·24 products
/// where the minimal-norm solve takes about 60.
const MOST_STATES: usize = 4;

/// The strategy, or why it does not fit.
pub(super) fn derive(dag: &mut Dag, context: &Context<'_>) -> Result<Strategy, Obstacle> {
    let (states, count) = (context.states.len(), context.multiplier.len());
    if states < 3 || count + 1 != states {
        return Err(context.wrong_count());
    }
    if states > MOST_STATES {
        return Err(Obstacle::Cost { conserved: count });
    }
    if context.depends_on_time(dag) {
        return Err(Obstacle::Time);
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
    let mut refusal = Obstacle::Dependent;
    for (&component, &minor) in context.field.iter().zip(product) {
        if is_proved_zero(dag, minor) {
            continue;
        }
        match regular_quotient(dag, component, minor, context.states, &poles) {
            Ok(alpha) if is_factor(dag, context.field, alpha, product) => return Ok(alpha),
            Ok(_) => refusal = Obstacle::NotParallel,
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
