//! What a run has to check of the conditions under which its quantities were proved.
//!
//! A proof of ∂ₜψ + ∇ψ·f = 0 holds where its conditions do. Most of them need no check: f or ψ
//! has no value beyond, as beyond x > 0 where one of them has ln x, and a run that comes there
//! ends. Two kinds are left.
//!
//! - Code has values beyond a sign condition: of x^k with an integer k, and of a component of
//!   f^τ that was made from another component of f. There ψ may change along f.
//! - ψ jumps where what it divides by is zero, as atan(y/x) does at x = 0. It is conserved on
//!   both sides, but not across.
//!
//! A condition is a function that is positive where the condition holds, or, of u ≠ 0, that keeps
//! its sign. It is emitted beside the interfaces of its region, and a run that crosses it ends.

mod jumps;

use std::collections::BTreeSet;

use super::strategy::Strategy;
use super::{CheckedCondition, SwitchingScheme, proofs};
use crate::algebra::{Dag, Id, Math, Name};
use crate::model::{Model, Parameter, Region, Sign};
use crate::proofs::conditions::{conditions_of, domain, follows};
use crate::proofs::{Conservation, Derivatives, DomainCondition};
use jumps::jumps;

/// The conditions of a region that a run has to check, if ψ is conserved on `sides` on the grounds
/// of `evidence`, and by f^τ as `strategy` makes it.
pub(super) fn checked(
    dag: &mut Dag,
    (states, parameters): (&[Name], &[Parameter]),
    (index, region, sides): (usize, &Region, &[(Id, Sign)]),
    evidence: &[Conservation],
    strategy: &Strategy,
) -> Vec<CheckedCondition> {
    // the ends of a sliding motion are long, and say little of ψ
    let sides = if region.slide.is_some() { &[] } else { sides };
    // the scheme of a region without such conditions is as if nothing had been asked
    let scratch = &mut dag.clone();
    let mut found: Vec<(DomainCondition, Vec<usize>)> = Vec::new();
    let mut note = |condition: DomainCondition, quantity: usize| match found
        .iter_mut()
        .find(|(known, _)| *known == condition)
    {
        Some((_, quantities)) if quantities.contains(&quantity) => {}
        Some((_, quantities)) => quantities.push(quantity),
        None => found.push((condition, vec![quantity])),
    };
    for (quantity, (psi, evidence)) in region.conserved.iter().zip(evidence).enumerate() {
        if let Conservation::Proved(conditions) = evidence {
            for &condition in conditions {
                let is_sign = !matches!(condition, DomainCondition::NonZero(_));
                if is_sign && !ends_code(scratch, condition, states, region, sides, strategy) {
                    note(condition, quantity);
                }
            }
        }
        for zero in zeros(scratch, psi.psi, sides) {
            if jumps(scratch, (states, parameters), psi.psi, zero) {
                note(DomainCondition::NonZero(zero), quantity);
            }
        }
    }
    if found.is_empty() {
        return Vec::new();
    }
    dag.clone_from(scratch);
    let arguments = [states, &[Model::time()]].concat();
    found
        .into_iter()
        .map(|(condition, quantities)| {
            let function = function(dag, condition);
            let derivatives = Derivatives::of(dag, function, states);
            let depends_on = dag.variables([function]);
            CheckedCondition {
                region: index,
                condition,
                quantities,
                function,
                switching: SwitchingScheme::of(dag, function, derivatives, states),
                is_fixed: !depends_on.iter().any(|name| arguments.contains(name)),
            }
        })
        .collect()
}

/// The function that is positive where a condition holds, or not zero.
fn function(dag: &mut Dag, condition: DomainCondition) -> Id {
    match condition {
        DomainCondition::Positive(u)
        | DomainCondition::NotNegative(u)
        | DomainCondition::NonZero(u) => u,
        DomainCondition::WithinOne(u) => {
            let one = dag.integer(1);
            let square = dag.powi(u, 2);
            dag.sub(one, square)
        }
    }
}

/// Whether emitted code has no value where a condition does not hold: the levels of ψ have none,
/// or f and f^τ have none.
fn ends_code(
    dag: &mut Dag,
    condition: DomainCondition,
    states: &[Name],
    region: &Region,
    sides: &[(Id, Sign)],
    strategy: &Strategy,
) -> bool {
    let psi: Vec<Id> = region.conserved.iter().map(|one| one.psi).collect();
    if ends(dag, condition, &psi, sides) {
        return true;
    }
    let discrete = match strategy {
        Strategy::Midpoint { field }
        | Strategy::SkewPairing { field, .. }
        | Strategy::CrossProduct { field, .. } => &field.value,
        Strategy::MinimalNorm { mean, .. } => &mean.value,
    };
    let discrete: Vec<Id> = discrete
        .iter()
        .map(|&component| proofs::coincide(dag, component, states))
        .collect();
    ends(dag, condition, &region.field, sides) && ends(dag, condition, &discrete, sides)
}

/// Whether one of `roots` has no value where a condition does not hold, because a root, a
/// logarithm or an arc function has none.
fn ends(dag: &mut Dag, condition: DomainCondition, roots: &[Id], sides: &[(Id, Sign)]) -> bool {
    let nodes: Vec<Id> = (dag.reachable(roots.iter().copied()).into_iter())
        .filter(|&id| match dag[id] {
            Math::Call(function, _) => function.properties().domain.has_border(),
            Math::Pow([_, v]) => dag.as_constant(v).is_some_and(|v| !v.is_integer()),
            _ => false,
        })
        .collect();
    let known = conditions_of(dag, &nodes, sides);
    follows(dag, condition, &known)
}

/// What ψ divides by.
fn zeros(dag: &mut Dag, psi: Id, sides: &[(Id, Sign)]) -> Vec<Id> {
    let bases: BTreeSet<Id> = (dag.reachable([psi]).into_iter())
        .filter_map(|id| match dag[id] {
            Math::Pow([base, _]) => Some(base),
            _ => None,
        })
        .collect();
    let conditions = domain(dag, &[psi], sides, &bases).conditions;
    let zeros = conditions
        .into_iter()
        .filter_map(|condition| match condition {
            DomainCondition::NonZero(u) => Some(u),
            _ => None,
        });
    zeros.collect()
}

#[cfg(test)]
mod tests {
    use crate::read;

    /// The conditions that runs of a system check, with their quantities.
    #[track_caller]
    fn checked(items: &str) -> Vec<String> {
        let text = format!("system S {{ {items} }}");
        let scheme = read(text.parse().expect("tokens"));
        let scheme = scheme.unwrap_or_else(|wrong| panic!("{items}: {:?}", wrong.messages()));
        let text = |checked: &super::CheckedCondition| {
            let region = &scheme.model.regions[checked.region];
            let condition = checked.condition.statement(scheme.dag());
            format!("{}: {condition}", checked.names(region))
        };
        scheme.checked_conditions().map(text).collect()
    }

    #[test]
    fn conditions_at_which_code_ends_are_not_checked() {
        for items in [
            "state x, y; param a = 1, b = 1, c = 1, d = 1;
             der(x) = x*(a - b*y); der(y) = y*(d*x - c);
             conserved v = d*x - c*ln(x) + b*y - a*ln(y);",
            "state x, y; der(x) = y; der(y) = -sqrt(x); conserved e = y^2/2 + 2*x^(3/2)/3;",
            "state x, y; der(x) = 1; der(y) = sqrt(x); conserved e = y - 2*x*sqrt(x)/3;",
            "state x, v; der(x) = v; der(v) = -asin(x);
             conserved e = v^2/2 + x*asin(x) + sqrt(1 - x^2);",
            "state x, v; param k = 4; der(x) = v; der(v) = -k*x^(k - 1); conserved e = v^2/2 + x^k;",
            "state x, y, u, v; param m = 1; let r = sqrt(x^2 + y^2);
             der(x) = u; der(y) = v; der(u) = -m*x/r^3; der(v) = -m*y/r^3;
             conserved e = (u^2 + v^2)/2 - m/r; conserved l = v*(x*v - y*u) - m*x/r;",
            // poles, and zeros at which nothing jumps
            "state x, v; der(x) = v; der(v) = 1/x^3; conserved e = v^2/2 + 1/(2*x^2);",
            "state x, v; der(x) = v; der(v) = -x/sqrt(x^2); conserved e = v^2/2 + sqrt(x^2);",
            "state x, v; der(x) = v; der(v) = -1; conserved e = v^2/2 + x*sqrt(x^2)/sqrt(x^2);",
            "state x, y; der(x) = 1; der(y) = 0; conserved e = y*exp(-1/x)*exp(1/x);",
        ] {
            assert_eq!(checked(items), Vec::<String>::new(), "{items}");
        }
    }

    #[test]
    fn conditions_beyond_which_code_has_values_are_checked() {
        for (items, expected) in [
            (
                "state x, y; param k = 2; der(x) = y*x^k; der(y) = -sqrt(x^2)*x^k;
                 conserved e = (x^2 + y^2)/2;",
                "e: x > 0",
            ),
            // right, and each component of f^τ is made from the one that has a value everywhere
            (
                "state x, y; der(x) = y*sqrt(x^2); der(y) = -x*sqrt(x)^2;
                 conserved e = (x^2 + y^2)/2;",
                "e: x ≥ 0",
            ),
            (
                "state x, y; der(x) = -y; der(y) = x; conserved angle = atan(y/x) - t;",
                "angle: x ≠ 0",
            ),
            (
                "state q, p; hamiltonian H = p^2/2 + q + sqrt(q^2)/q in (q, p);",
                "H: q ≠ 0",
            ),
            (
                "state x, y; der(x) = 1; der(y) = 0; conserved e = y + tanh(1/(x - t - y));",
                "e: x - t - y ≠ 0",
            ),
        ] {
            assert_eq!(checked(items), [expected], "{items}");
        }
    }

    #[test]
    fn a_region_makes_checks_superfluous() {
        assert_eq!(
            checked(
                "state x, y; param k = 2; interface wall = x;
                 region right where wall > 0 { der(x) = y*x^k; der(y) = -sqrt(x^2)*x^k;
                                               conserved e = (x^2 + y^2)/2; }
                 region left where wall < 0 { der(x) = y; der(y) = -x; conserved e = (x^2 + y^2)/2; }"
            ),
            Vec::<String>::new()
        );
    }
}
