//! Where a factor α of a discrete vector field is finite.
//!
//! α is a quotient of f by ∇ψ, and may have a pole where f and ∇ψ have none; there a step
//! would still conserve ψ and move wrongly, or not at all. Such an α is not used.

use super::Obstacle;
use crate::algebra::{Dag, Domain, Id, Math, Name, divide_exactly};

/// A power high enough to tell that a factor vanishes only where a denominator does: √u and
/// u have the same zeros, and u divides (√u)⁴.
const RADICAL_POWER: i64 = 4;

/// The exact quotient of `numerator` by `denominator`, if it is finite wherever `poles` are
/// not zero; otherwise what it has against it.
pub(super) fn regular_quotient(
    dag: &mut Dag,
    numerator: Id,
    denominator: Id,
    states: &[Name],
    poles: &[Id],
) -> Result<Id, Obstacle> {
    let Some(quotient) = divide_exactly(dag, numerator, denominator) else {
        return Err(Obstacle::NoNormalForm {
            numerator,
            denominator,
        });
    };
    for factor in quotient.denominator {
        if depends_on_any(dag, factor, states) && !vanishes_within(dag, factor, states, poles) {
            return Err(Obstacle::Denominator(factor));
        }
    }
    Ok(quotient.value)
}

/// What f and ∇ψ already divide by: the denominators in `roots`.
pub(super) fn poles(dag: &mut Dag, roots: impl IntoIterator<Item = Id>) -> Vec<Id> {
    let mut poles = Vec::new();
    for id in dag.reachable(roots) {
        match dag[id] {
            Math::Div([_, denominator]) => poles.push(denominator),
            Math::Pow([base, exponent]) if !is_nonnegative_integer(dag, exponent) => {
                poles.push(base);
            }
            Math::Call(function, argument) => match function.properties().domain {
                Domain::NonZero(of) => poles.push(dag.call(of, argument)),
                Domain::Positive => poles.push(argument),
                _ => {}
            },
            _ => {}
        }
    }
    poles.sort_unstable();
    poles.dedup();
    poles
}

/// Whether `root` depends on one of `names`.
pub(super) fn depends_on_any(dag: &Dag, root: Id, names: &[Name]) -> bool {
    dag.variables([root])
        .iter()
        .any(|name| names.contains(name))
}

fn is_nonnegative_integer(dag: &Dag, exponent: Id) -> bool {
    dag.as_integer(exponent).is_some_and(|n| n >= 0)
}

/// Whether `factor` is zero only where one of `poles` is: it divides a power of it.
fn vanishes_within(dag: &mut Dag, factor: Id, states: &[Name], poles: &[Id]) -> bool {
    poles.iter().any(|&pole| {
        let power = dag.powi(pole, RADICAL_POWER);
        divide_exactly(dag, power, factor).is_some_and(|quotient| {
            quotient
                .denominator
                .iter()
                .all(|&rest| !depends_on_any(dag, rest, states))
        })
    })
}
