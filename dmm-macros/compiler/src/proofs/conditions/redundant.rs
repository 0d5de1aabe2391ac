//! Conditions that say nothing new beside others.

use std::collections::BTreeMap;

use super::Need;
use crate::algebra::evaluate::Interval;
use crate::algebra::normal_form::divide_exactly;
use crate::algebra::{Dag, Id, Math, Name, is_proved_zero};

/// Conditions that are compared with each other by the normal form, at most.
pub(super) const MOST_COMPARED: usize = 16;

/// The condition among `kept` on the same argument, or on its opposite if only its zeros
/// matter.
pub(super) fn equal_condition(
    dag: &mut Dag,
    kept: &[(Id, Need)],
    id: Id,
    need: Need,
) -> Option<usize> {
    if kept.len() > MOST_COMPARED {
        return None;
    }
    (0..kept.len()).find(|&index| {
        let Some(&(other, other_need)) = kept.get(index) else {
            return false;
        };
        let difference = dag.sub(id, other);
        if is_proved_zero(dag, difference) {
            return true;
        }
        let sum = dag.add(id, other);
        need == Need::NonZero && other_need == Need::NonZero && is_proved_zero(dag, sum)
    })
}

/// Whether 1 − u² > 0 is among the conditions.
pub(super) fn is_within_by(dag: &mut Dag, kept: &[(Id, Need)], u: Id) -> bool {
    let one = dag.integer(1);
    let square = dag.powi(u, 2);
    let difference = dag.sub(one, square);
    kept.iter()
        .any(|&(id, need)| id == difference && need != Need::NonZero)
}

/// The conditions but for those that hold because of what is asked of single variables.
pub(super) fn without_consequences(dag: &Dag, kept: Vec<(Id, Need)>) -> Vec<(Id, Need)> {
    let variables = ranges_of_variables(dag, &kept);
    let follows = |&(id, need): &(Id, Need)| {
        let range = Interval::of_within(dag, id, &variables);
        !matches!(dag[id], Math::Variable(_)) && need.holds(range)
    };
    let kept: Vec<(Id, Need)> = kept.into_iter().filter(|one| !follows(one)).collect();
    // no factor of what is positive is zero
    let positive: Vec<Vec<Id>> = kept
        .iter()
        .filter(|&&(_, need)| need == Need::Positive)
        .map(|&(id, _)| proper_factors(dag, id))
        .collect();
    let is_factor = |id: Id| positive.iter().any(|factors| factors.contains(&id));
    kept.into_iter()
        .filter(|&(id, need)| need != Need::NonZero || !is_factor(id))
        .collect()
}

/// The factors and divisors of a product or quotient, without itself.
fn proper_factors(dag: &Dag, id: Id) -> Vec<Id> {
    let mut factors = Vec::new();
    let mut open = vec![id];
    while let Some(next) = open.pop() {
        if next != id {
            factors.push(next);
        }
        match dag[next] {
            Math::Mul([u, v]) | Math::Div([u, v]) => open.extend([u, v]),
            Math::Neg(u) => open.push(u),
            _ => {}
        }
    }
    factors
}

/// What is asked of single variables.
fn ranges_of_variables(dag: &Dag, kept: &[(Id, Need)]) -> BTreeMap<Name, Interval> {
    let mut variables = BTreeMap::new();
    for &(id, need) in kept {
        if let Math::Variable(name) = &dag[id] {
            variables.insert(name.clone(), need.range());
        }
    }
    variables
}

/// The conditions but for those on u·v where one on v is there and u is a unit: not zero, or
/// positive where the sign matters, because of the conditions that stay. Of m² + p²/c² ≠ 0 and
/// m² c⁴ + p² c² ≠ 0 with c ≠ 0, the first one stays.
///
/// What is left out follows from what stays: each one from those that were there when it was
/// left out, and so, from the last one backwards, from those that are there at the end.
pub(super) fn without_multiples(dag: &mut Dag, mut kept: Vec<(Id, Need)>) -> Vec<(Id, Need)> {
    if kept.len() > MOST_COMPARED {
        return kept;
    }
    // the longest one goes first, of equally long ones the last one
    let mut order: Vec<(Id, Need)> = kept.iter().rev().copied().collect();
    order.sort_by_cached_key(|&(id, _)| std::cmp::Reverse(dag.tree_size(id)));
    for condition in order {
        let others: Vec<(Id, Need)> = kept
            .iter()
            .copied()
            .filter(|&one| one != condition)
            .collect();
        if is_multiple(dag, condition, &others) {
            kept = others;
        }
    }
    kept
}

/// Whether the condition is that on a multiple of one of the `others` by a unit.
pub(super) fn is_multiple(dag: &mut Dag, (id, need): (Id, Need), others: &[(Id, Need)]) -> bool {
    let has_factors = matches!(
        dag[id],
        Math::Add(_) | Math::Sub(_) | Math::Mul(_) | Math::Div(_) | Math::Neg(_)
    );
    if !has_factors {
        return false;
    }
    let depends_on = dag.variables([id]);
    others.iter().any(|&(other, other_need)| {
        let is_stronger = other_need == need || other_need == Need::Positive;
        is_stronger
            && (dag.variables([other]).iter()).all(|name| depends_on.contains(name))
            && divide_exactly(dag, id, other)
                .is_some_and(|quotient| is_unit(dag, quotient.value, need, others))
    })
}

/// Whether `u` is not zero, and positive unless `need` is that something is not zero, where the
/// `conditions` hold.
fn is_unit(dag: &Dag, u: Id, need: Need, conditions: &[(Id, Need)]) -> bool {
    let variables = ranges_of_variables(dag, conditions);
    let needed = match need {
        Need::NonZero => Need::NonZero,
        Need::NotNegative | Need::Positive => Need::Positive,
    };
    let mut open = vec![(u, needed)];
    while let Some((id, needed)) = open.pop() {
        let range = Interval::of_within(dag, id, &variables);
        let holds = range.defined && needed.holds(range);
        let is_asked = conditions
            .iter()
            .any(|&(other, known)| other == id && (known == needed || known == Need::Positive));
        if holds || is_asked {
            continue;
        }
        match dag[id] {
            Math::Neg(v) if needed == Need::NonZero => open.push((v, needed)),
            Math::Mul([v, w]) | Math::Div([v, w]) => open.extend([(v, needed), (w, needed)]),
            Math::Pow([v, n]) => match dag.as_integer(n) {
                Some(n) if n % 2 == 0 => open.push((v, Need::NonZero)),
                Some(_) => open.push((v, needed)),
                None => return false,
            },
            _ => return false,
        }
    }
    true
}
