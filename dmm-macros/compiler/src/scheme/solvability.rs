//! How f^τ depends on the later end of a step, and so how the step's implicit equation
//! x₁ = x₀ + τ f^τ(t₀, x₀, t₁, x₁) is solved.

use super::{Explicit, Strategy};
use crate::algebra::{Dag, Id, Name, differentiate, is_proved_zero, jacobian};

/// How f^τ depends on x₁.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solvability {
    /// Newton's method.
    Nonlinear,
    /// f^τ = A x₁ + b with A and b depending on x₀, t₀, t₁: one linear solve, no iteration.
    Affine,
    /// f^τ = A₀ x₀ + A₁ x₁ + b with A₀, A₁, b depending on parameters alone: the propagator is computed
    /// once a step size.
    Linear,
}

/// The simplest kind of equation that f^τ is proved to give.
pub(super) fn classify(
    dag: &mut Dag,
    strategy: &Strategy,
    states: &[Name],
    autonomous: bool,
) -> Solvability {
    let field = match strategy {
        Strategy::Midpoint { field }
        | Strategy::SkewPairing { field, .. }
        | Strategy::CrossProduct { field, .. } => field,
        Strategy::MinimalNorm { .. } => return Solvability::Nonlinear,
    };
    let starts: Vec<Name> = states.iter().map(Name::at_start).collect();
    let ends: Vec<Name> = states.iter().map(Name::at_end).collect();
    if !is_independent(dag, &field.jacobian, &ends) {
        Solvability::Nonlinear
    } else if autonomous && is_linear(dag, field, &starts, &ends) {
        Solvability::Linear
    } else {
        Solvability::Affine
    }
}

/// Whether ∂f^τ/∂x₀ and ∂f^τ/∂x₁ depend on neither end; f^τ is autonomous and affine in x₁.
fn is_linear(dag: &mut Dag, field: &Explicit, starts: &[Name], ends: &[Name]) -> bool {
    let by_start = jacobian(dag, &field.value, starts);
    is_independent(dag, &field.jacobian, starts)
        && is_independent(dag, &by_start, starts)
        && is_independent(dag, &by_start, ends)
}

/// Whether no entry depends on any of `names`: by its form, or by a proof that its derivative
/// is zero.
fn is_independent(dag: &mut Dag, matrix: &[Vec<Id>], names: &[Name]) -> bool {
    matrix.iter().flatten().all(|&entry| {
        // most entries of a large Jacobian are zero
        if dag.as_constant(entry).is_some() {
            return true;
        }
        let depends = dag.variables([entry]);
        let mut suspects = names.iter().filter(|name| depends.contains(name));
        suspects.all(|name| {
            let derivative = differentiate(dag, entry, name);
            is_proved_zero(dag, derivative)
        })
    })
}
