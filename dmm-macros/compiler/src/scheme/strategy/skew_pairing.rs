//! The first strategy: one conserved quantity ψ(x), and a perfect matching of the states into
//! pairs (i, j) that conserve it by themselves, fᵢ ∂ᵢψ + fⱼ ∂ⱼψ ≡ 0. Then fᵢ = α ∂ⱼψ and
//! fⱼ = −α ∂ᵢψ with one exact factor α, and
//!
//! ```text
//! f^τᵢ = α(t̄, x̄) Λ^τⱼ,      f^τⱼ = −α(t̄, x̄) Λ^τᵢ
//! ```
//!
//! is orthogonal to Λ^τ whatever α is. A state that ψ does not depend on, or that does not
//! move, stands alone. The canonical pairs of a Hamiltonian are pairs with α = 1 by
//! construction: q̇ = ∂H/∂p and ṗ = −∂H/∂q.

use std::collections::BTreeMap;

use super::regularity::{poles, regular_quotient};
use super::{Context, Explicit, Obstacle, Pairing, Strategy, midpoint};
use crate::algebra::{Dag, Id, is_proved_zero};

/// The strategy, or why it does not fit.
pub(super) fn derive(dag: &mut Dag, context: &Context<'_>) -> Result<Strategy, Obstacle> {
    let [gradient] = context.multiplier else {
        return Err(context.wrong_count());
    };
    if context.depends_on_time(dag) {
        return Err(Obstacle::Time);
    }
    let canonical = canonical(dag, context, gradient);
    let is_paired = |state: usize| {
        let mut pairs = canonical.iter();
        pairs.any(|pair| pair.first == state || pair.second == state)
    };
    let unpaired: Vec<usize> = (0..context.states.len())
        .filter(|&state| !is_paired(state))
        .collect();
    let alone = alone(dag, context, gradient, &unpaired);
    let remaining: Vec<usize> = unpaired
        .into_iter()
        .filter(|state| !alone.contains(state))
        .collect();
    let divisors = if remaining.is_empty() {
        Vec::new()
    } else {
        poles(dag, context.field.iter().chain(gradient).copied())
    };
    let mut matching = Matching {
        poles: divisors,
        context,
        gradient,
        known: BTreeMap::new(),
        obstacle: None,
    };
    let Some(found) = matching.complete(dag, &remaining) else {
        return Err(matching.obstacle.unwrap_or(Obstacle::NoPairs));
    };
    let pairs: Vec<Pairing> = canonical.into_iter().chain(found).collect();
    let value = assemble(
        dag,
        context,
        &pairs,
        &alone,
        &context.discrete_multiplier[0],
    );
    let field = Explicit::new(dag, value, context.states);
    Ok(Strategy::SkewPairing {
        pairs,
        alone,
        field,
    })
}

/// f^τ from the row Λ^τ, which may be one of opaque symbols.
pub(in crate::scheme) fn assemble(
    dag: &mut Dag,
    context: &Context<'_>,
    pairs: &[Pairing],
    alone: &[usize],
    multiplier: &[Id],
) -> Vec<Id> {
    let mut value = context.mean.to_vec();
    for &state in alone {
        if is_proved_zero(dag, context.field[state]) {
            value[state] = dag.integer(0);
        }
    }
    for pair in pairs {
        let alpha = midpoint(dag, pair.alpha, context.states);
        value[pair.first] = dag.mul(alpha, multiplier[pair.second]);
        let opposite = dag.mul(alpha, multiplier[pair.first]);
        value[pair.second] = dag.neg(opposite);
    }
    value
}

/// The canonical pairs, of which the nodes of f are those of ∇ψ: ψ is the Hamiltonian that f
/// was made from.
fn canonical(dag: &mut Dag, context: &Context<'_>, gradient: &[Id]) -> Vec<Pairing> {
    let alpha = dag.integer(1);
    let mut pairs = Vec::with_capacity(context.canonical.len());
    for &(q, p) in context.canonical {
        let field = (context.field.get(q), context.field.get(p));
        let slopes = (gradient.get(q), gradient.get(p));
        let ((Some(&of_q), Some(&of_p)), (Some(&by_q), Some(&by_p))) = (field, slopes) else {
            return Vec::new();
        };
        if of_q != by_p || of_p != dag.neg(by_q) {
            return Vec::new();
        }
        pairs.push(Pairing {
            first: q,
            second: p,
            alpha,
        });
    }
    pairs
}

/// The states among `candidates` with fᵢ ∂ᵢψ ≡ 0, because one of the factors is.
fn alone(
    dag: &mut Dag,
    context: &Context<'_>,
    gradient: &[Id],
    candidates: &[usize],
) -> Vec<usize> {
    let is_alone = |&state: &usize| {
        let discrete = context.discrete_multiplier[0][state];
        is_proved_zero(dag, context.field[state])
            || (is_proved_zero(dag, gradient[state]) && is_proved_zero(dag, discrete))
    };
    candidates.iter().copied().filter(is_alone).collect()
}

/// The search for a perfect matching, in the order of declaration.
struct Matching<'a> {
    context: &'a Context<'a>,
    gradient: &'a [Id],
    /// What f and ∇ψ already divide by.
    poles: Vec<Id>,
    /// What is known of pairs: α, or that they do not fit.
    known: BTreeMap<(usize, usize), Option<Id>>,
    /// Why the first pair that conserves ψ could not be used.
    obstacle: Option<Obstacle>,
}

impl Matching<'_> {
    fn complete(&mut self, dag: &mut Dag, states: &[usize]) -> Option<Vec<Pairing>> {
        let Some((&first, rest)) = states.split_first() else {
            return Some(Vec::new());
        };
        for (position, &second) in rest.iter().enumerate() {
            let known = self.known.get(&(first, second)).copied();
            let alpha = known.unwrap_or_else(|| self.pair(dag, first, second));
            self.known.insert((first, second), alpha);
            let Some(alpha) = alpha else {
                continue;
            };
            let mut others = rest.to_vec();
            others.remove(position);
            if let Some(mut pairs) = self.complete(dag, &others) {
                pairs.insert(
                    0,
                    Pairing {
                        first,
                        second,
                        alpha,
                    },
                );
                return Some(pairs);
            }
        }
        None
    }

    /// α, if the states i and j conserve ψ by themselves and α is regular.
    fn pair(&mut self, dag: &mut Dag, i: usize, j: usize) -> Option<Id> {
        let field = self.context.field;
        let first = dag.mul(field[i], self.gradient[i]);
        let second = dag.mul(field[j], self.gradient[j]);
        let sum = dag.add(first, second);
        if !is_proved_zero(dag, sum) {
            return None;
        }
        let states = self.context.states;
        let forward = regular_quotient(dag, field[i], self.gradient[j], states, &self.poles);
        let opposite = dag.neg(field[j]);
        let backward = regular_quotient(dag, opposite, self.gradient[i], states, &self.poles);
        match (forward, backward) {
            (Ok(forward), Ok(backward)) => Some(simpler(dag, forward, backward)),
            (Ok(alpha), Err(_)) | (Err(_), Ok(alpha)) => Some(alpha),
            (Err(obstacle), Err(_)) => {
                self.obstacle.get_or_insert(obstacle);
                None
            }
        }
    }
}

/// The expression with fewer nodes; the first of equals.
fn simpler(dag: &Dag, a: Id, b: Id) -> Id {
    if dag.reachable([b]).len() < dag.reachable([a]).len() {
        b
    } else {
        a
    }
}
