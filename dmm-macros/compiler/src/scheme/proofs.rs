//! The identities that a scheme rests on, proved for what was derived:
//!
//! ```text
//! Λ^τ Δx + ∂ₜ^τψ Δt = Δψ,      Λ^τ f^τ + ∂ₜ^τψ = 0,      f^τ(t, x, t, x) = f(t, x).
//! ```
//!
//! The second is proved with the entries of Λ^τ as opaque symbols, so that it holds in
//! floating point with whatever the entries evaluate to, up to the rounding of the sum.

use std::collections::HashMap;

use super::strategy::minimal_norm::symbols;
use super::strategy::{Context, Strategy, cross_product, skew_pairing};
use crate::algebra::linear::dot;
use crate::algebra::normal_form::decide_zero_on;
use crate::algebra::{
    Counterexample, Dag, Function, Id, Math, Name, PairFunction, Verdict, at_end, at_start,
};
use crate::model::{Model, Sign, positive};

/// What is known of an identity that a scheme rests on. One that is false is a diagnostic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// It was proved symbolically.
    Proved,
    /// It could neither be proved nor refuted.
    NotProved,
}

/// The identities of a scheme, and what is known of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proofs {
    /// Λ^τ Δx + ∂ₜ^τψ Δt = Δψ
    pub telescopes: Evidence,
    /// Λ^τ f^τ + ∂ₜ^τψ = 0, whatever the entries of Λ^τ are
    pub conserves: Evidence,
    /// f^τ(t, x, t, x) = f(t, x)
    pub consistent: Evidence,
}

/// An identity that a scheme rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Identity {
    /// Λ^τ Δx + ∂ₜ^τψ Δt = Δψ
    Telescopes,
    /// Λ^τ f^τ + ∂ₜ^τψ = 0
    Conserves,
    /// f^τ(t, x, t, x) = f(t, x)
    Consistent,
}

/// Identities that are false, each with a point.
pub(super) type Violations = Vec<(Identity, Counterexample)>;

/// Proves the identities of what was derived from `psi` in a region with these `sides`.
///
/// f^τ(t, x, t, x) = f(t, x) is asked where every component of f and Λ has a value: one
/// component of f^τ may be made from another one of f.
pub(super) fn prove(
    dag: &mut Dag,
    context: &Context<'_>,
    (psi, sides): (&[Id], &[(Id, Sign)]),
    strategy: &Strategy,
) -> (Proofs, Violations) {
    let mut violations = Violations::new();
    let telescopes = telescoping(dag, context, psi);
    let conserves = conservation(dag, context, strategy);
    let consistent = consistency(dag, context, strategy);
    let mut all_zero = |dag: &mut Dag, identity, roots: &[Id], domain: &[Id]| {
        let mut evidence = Evidence::Proved;
        for &root in roots {
            match decide_zero_on(dag, root, domain) {
                Verdict::Proved => continue,
                Verdict::Undecided | Verdict::Exhausted => {}
                Verdict::Refuted(found) => violations.push((identity, found)),
            }
            evidence = Evidence::NotProved;
        }
        evidence
    };
    let telescopes = all_zero(dag, Identity::Telescopes, &telescopes, &[]);
    let conserves = all_zero(dag, Identity::Conserves, &conserves, &[]);
    let scratch = &mut dag.clone();
    let mut domain: Vec<Id> = psi.iter().chain(context.field).copied().collect();
    domain.extend(context.multiplier.iter().flatten());
    for side in positive(scratch, sides) {
        domain.push(scratch.call(Function::Ln, side));
    }
    domain.retain(|&formula| scratch.as_constant(formula).is_none());
    let proofs = Proofs {
        telescopes,
        conserves,
        consistent: all_zero(scratch, Identity::Consistent, &consistent, &domain),
    };
    (proofs, violations)
}

/// Λ^τ Δx + ∂ₜ^τψ Δt − Δψ
fn telescoping(dag: &mut Dag, context: &Context<'_>, psi: &[Id]) -> Vec<Id> {
    let mut names = context.states.to_vec();
    names.push(Model::time());
    let differences: Vec<Id> = names.iter().map(|name| difference(dag, name)).collect();
    let rows = context
        .discrete_multiplier
        .iter()
        .zip(context.discrete_time_derivative);
    psi.iter()
        .zip(rows)
        .map(|(&psi, (row, &by_time))| {
            let coefficients: Vec<Id> = row.iter().copied().chain([by_time]).collect();
            let sum = dot(dag, &coefficients, &differences);
            let end = at_end(dag, psi, &names);
            let start = at_start(dag, psi, &names);
            let change = dag.sub(end, start);
            dag.sub(sum, change)
        })
        .collect()
}

fn difference(dag: &mut Dag, name: &Name) -> Id {
    let end = dag.variable(&name.at_end());
    let start = dag.variable(&name.at_start());
    dag.sub(end, start)
}

/// Λ^τ f^τ + ∂ₜ^τψ, with Λ^τ's entries as symbols except where they are zero.
fn conservation(dag: &mut Dag, context: &Context<'_>, strategy: &Strategy) -> Vec<Id> {
    let mut opaque = opaque(dag, context.discrete_multiplier);
    let field = match strategy {
        Strategy::Midpoint { .. } => return Vec::new(),
        Strategy::SkewPairing { pairs, alone, .. } => {
            // either Λ^τ is proved to be zero there, or f is
            for &state in alone {
                opaque[0][state] = dag.integer(0);
            }
            skew_pairing::assemble(dag, context, pairs, alone, &opaque[0])
        }
        Strategy::CrossProduct { alpha, .. } => {
            cross_product::assemble(dag, context, *alpha, &opaque)
        }
        Strategy::MinimalNorm { .. } => return minimal_norm_residual(dag, context, &opaque),
    };
    opaque
        .iter()
        .zip(context.discrete_time_derivative)
        .map(|(row, &by_time)| {
            let product = dot(dag, row, &field);
            dag.add(product, by_time)
        })
        .collect()
}

fn opaque(dag: &mut Dag, matrix: &[Vec<Id>]) -> Vec<Vec<Id>> {
    matrix
        .iter()
        .enumerate()
        .map(|(row, entries)| {
            let names = symbols(&format!("Λ[{}]", row + 1), entries.len());
            entries
                .iter()
                .zip(names)
                .map(|(&entry, name)| {
                    if dag.is_zero(entry) {
                        entry
                    } else {
                        dag.variable(&name)
                    }
                })
                .collect()
        })
        .collect()
}

/// Λ(f̄ − Λᵀλ) + ψₜ − (r − Gλ) with r = Λf̄ + ψₜ and G = ΛΛᵀ: what the solve for λ leaves is
/// what conservation lacks.
fn minimal_norm_residual(dag: &mut Dag, context: &Context<'_>, rows: &[Vec<Id>]) -> Vec<Id> {
    let mean = variables(dag, "f", context.states.len());
    let lambda = variables(dag, "λ", rows.len());
    let by_time = variables(dag, "ψ", rows.len());
    let field: Vec<Id> = mean
        .iter()
        .enumerate()
        .map(|(state, &component)| {
            let column: Vec<Id> = rows.iter().map(|row| row[state]).collect();
            let correction = dot(dag, &column, &lambda);
            dag.sub(component, correction)
        })
        .collect();
    rows.iter()
        .zip(by_time)
        .map(|(row, by_time)| {
            let product = dot(dag, row, &field);
            let conserved = dag.add(product, by_time);
            let product = dot(dag, row, &mean);
            let right = dag.add(product, by_time);
            let gram: Vec<Id> = rows.iter().map(|other| dot(dag, row, other)).collect();
            let left = dot(dag, &gram, &lambda);
            let remainder = dag.sub(right, left);
            dag.sub(conserved, remainder)
        })
        .collect()
}

fn variables(dag: &mut Dag, letter: &str, count: usize) -> Vec<Id> {
    symbols(letter, count)
        .iter()
        .map(|name| dag.variable(name))
        .collect()
}

/// f^τ(t, x, t, x) − f(t, x). The minimal-norm correction vanishes at coinciding ends if Λ^τ
/// and ∂ₜ^τψ become Λ and ∂ₜψ there, because ψ is conserved by f.
fn consistency(dag: &mut Dag, context: &Context<'_>, strategy: &Strategy) -> Vec<Id> {
    let mut identities: Vec<(Id, Id)> = Vec::new();
    match strategy {
        Strategy::Midpoint { field }
        | Strategy::SkewPairing { field, .. }
        | Strategy::CrossProduct { field, .. } => {
            identities.extend(pairs(&field.value, context.field));
        }
        Strategy::MinimalNorm { mean, .. } => {
            identities.extend(pairs(&mean.value, context.field));
            for (discrete, exact) in context.discrete_multiplier.iter().zip(context.multiplier) {
                identities.extend(pairs(discrete, exact));
            }
            identities.extend(pairs(
                context.discrete_time_derivative,
                context.time_derivative,
            ));
        }
    }
    identities
        .into_iter()
        .map(|(discrete, exact)| {
            let limit = coincide(dag, discrete, context.states);
            dag.sub(limit, exact)
        })
        .collect()
}

fn pairs<'a>(a: &'a [Id], b: &'a [Id]) -> impl Iterator<Item = (Id, Id)> + 'a {
    a.iter().copied().zip(b.iter().copied())
}

/// `root` where the two ends of the step are the same point (t, x).
pub(super) fn coincide(dag: &mut Dag, root: Id, states: &[Name]) -> Id {
    let time = Model::time();
    let mut points: HashMap<Name, Id> = HashMap::new();
    for name in states.iter().chain([&time]) {
        let point = dag.variable(name);
        points.insert(name.at_start(), point);
        points.insert(name.at_end(), point);
    }
    let mut image: HashMap<Id, Id> = HashMap::new();
    for id in dag.reachable([root]) {
        let node = dag[id].clone();
        let limit = match &node {
            Math::Variable(name) => points.get(name).copied().unwrap_or(id),
            Math::Pair(function, [a, b]) if image[a] == image[b] => {
                confluent(dag, *function, image[a])
            }
            _ => {
                let node = egg::Language::map_children(node, |child| image[&child]);
                dag.rebuild(&node)
            }
        };
        image.insert(id, limit);
    }
    image[&root]
}

/// A divided difference at coinciding arguments: the derivative of its function.
fn confluent(dag: &mut Dag, function: PairFunction, u: Id) -> Id {
    match function.prime() {
        Some(_) => function.of().derivative(dag, u),
        // derivatives of divided differences are not part of f^τ
        None => dag.pair(function, u, u),
    }
}
