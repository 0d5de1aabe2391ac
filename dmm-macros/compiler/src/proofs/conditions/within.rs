//! What the region of a formula says about its conditions: some hold in it, some hold nowhere.
//!
//! A condition u > 0 holds where v > 0 if u − v is not negative, or if u is a multiple of v by
//! what is positive; two conditions exclude one another if the sum of their functions is not
//! positive. Conditions a·x + b > 0 on a single variable are taken together as the interval in
//! which it lies.

use std::collections::{BTreeMap, HashMap};

use num_traits::{Signed, ToPrimitive, Zero};

use super::Need;
use super::redundant::{MOST_COMPARED, is_multiple};
use crate::algebra::evaluate::Interval;
use crate::algebra::normal_form::divide_exactly;
use crate::algebra::{Dag, Id, Name, differentiate, is_proved_zero, normalise};
use crate::proofs::DomainCondition;

/// Intervals of variables.
type Ranges = BTreeMap<Name, Interval>;

/// The conditions but for those that hold wherever every one of `sides` is positive.
pub(super) fn not_implied(dag: &mut Dag, kept: Vec<(Id, Need)>, sides: &[Id]) -> Vec<(Id, Need)> {
    if sides.is_empty() {
        return kept;
    }
    let known: Vec<(Id, Need)> = sides.iter().map(|&side| (side, Need::Positive)).collect();
    let ranges = ranges(dag, &known);
    let mut rest = Vec::new();
    for (id, need) in kept {
        if !is_implied(dag, (id, need), &known, &ranges) {
            rest.push((id, need));
        }
    }
    rest
}

/// Whether a condition holds where the `known` ones do.
pub(super) fn is_implied_by(dag: &mut Dag, condition: (Id, Need), known: &[(Id, Need)]) -> bool {
    let ranges = ranges(dag, known);
    is_implied(dag, condition, known, &ranges)
}

/// Whether a condition holds where the `known` ones do, in which the variables lie in `ranges`.
fn is_implied(
    dag: &mut Dag,
    (id, need): (Id, Need),
    known: &[(Id, Need)],
    ranges: &Ranges,
) -> bool {
    if need.holds(Interval::of_within(dag, id, ranges)) {
        return true;
    }
    for &(other, _) in known {
        let difference = dag.sub(id, other);
        if simplest_range(dag, difference, ranges).is_not_negative() {
            return true;
        }
        let sum = dag.add(id, other);
        if need == Need::NonZero && simplest_range(dag, sum, ranges).is_not_positive() {
            return true;
        }
    }
    is_multiple(dag, (id, need), known)
}

/// Whether −1 ≤ u ≤ 1 holds wherever every one of `sides` is positive.
pub(super) fn holds_within_one(dag: &mut Dag, u: Id, sides: &[Id]) -> bool {
    let known: Vec<(Id, Need)> = sides.iter().map(|&side| (side, Need::Positive)).collect();
    let ranges = ranges(dag, &known);
    let range = Interval::of_within(dag, u, &ranges);
    range.low >= -1.0 && range.high <= 1.0
}

/// The conditions, those of `sides` among them, that exclude one another, if there are such:
/// together they hold nowhere, or on a set without interior only. Sides that exclude one another
/// without them say nothing of the conditions.
pub(super) fn contradiction(
    dag: &mut Dag,
    kept: &[(Id, Need)],
    within_one: &[Id],
    sides: &[Id],
) -> Option<Vec<DomainCondition>> {
    let sides: Vec<(Id, Need)> = sides.iter().map(|&side| (side, Need::Positive)).collect();
    let is_nowhere = (sides.iter()).any(|&(id, need)| {
        let none = Ranges::new();
        excluded(dag, (id, need), &sides, &none).is_some()
    });
    if is_nowhere {
        return None;
    }
    let known: Vec<(Id, Need)> = sides.iter().chain(kept).copied().collect();
    let all = ranges(dag, &known);
    for &(id, need) in kept {
        if let Some(other) = excluded(dag, (id, need), &known, &all) {
            let other = other.map(|(other, need)| need.of(other));
            return Some([need.of(id)].into_iter().chain(other).collect());
        }
    }
    let outside = within_one.iter().find(|&&u| {
        let range = Interval::of_within(dag, u, &all);
        range.low >= 1.0 || range.high <= -1.0
    });
    outside.map(|&u| vec![DomainCondition::WithinOne(u)])
}

/// Whether a condition is satisfied nowhere, alone or (then with which) beside another one.
#[expect(clippy::option_option, reason = "none, alone, or beside another one")]
fn excluded(
    dag: &mut Dag,
    (id, need): (Id, Need),
    known: &[(Id, Need)],
    all: &Ranges,
) -> Option<Option<(Id, Need)>> {
    let everywhere = Ranges::new();
    if need == Need::NonZero {
        return dag.is_zero(id).then_some(None);
    }
    // √0 has a value
    if need == Need::NotNegative && is_proved_zero(dag, id) {
        return None;
    }
    if simplest_range(dag, id, &everywhere).is_not_positive() {
        return Some(None);
    }
    if known.len() > MOST_COMPARED {
        return None;
    }
    for &(other, other_need) in known {
        if other == id || other_need == Need::NonZero {
            continue;
        }
        let sum = dag.add(id, other);
        let alone = ranges(dag, &[(other, other_need)]);
        let is_excluded = simplest_range(dag, sum, &everywhere).is_not_positive()
            || simplest_range(dag, id, &alone).is_not_positive()
            || is_opposite(dag, id, other);
        if is_excluded {
            return Some(Some((other, other_need)));
        }
    }
    // what several conditions say about the variables
    let empty = all.values().any(|range| range.low >= range.high);
    (!empty && simplest_range(dag, id, all).is_not_positive()).then_some(None)
}

/// Whether u is a multiple of v by what is not positive.
fn is_opposite(dag: &mut Dag, u: Id, v: Id) -> bool {
    let depends_on = dag.variables([u]);
    let shares = (dag.variables([v]).iter()).all(|name| depends_on.contains(name));
    shares
        && divide_exactly(dag, u, v).is_some_and(|quotient| {
            Interval::of_within(dag, quotient.value, &Ranges::new()).is_not_positive()
        })
}

/// The intervals in which single variables lie because of conditions a·x + b > 0 or ≥ 0.
pub(super) fn ranges(dag: &mut Dag, known: &[(Id, Need)]) -> Ranges {
    let mut ranges = Ranges::new();
    for &(id, need) in known {
        if need == Need::NonZero {
            continue;
        }
        let names = dag.variables([id]);
        let [name] = names.as_slice() else {
            continue;
        };
        let Some((rises, bound)) = half_line(dag, id, name) else {
            continue;
        };
        let known = ranges.entry(name.clone()).or_insert(Interval::WHOLE);
        let strict = need == Need::Positive;
        if rises {
            known.low = known.low.max(bound);
            known.nonzero |= bound > 0.0 || bound == 0.0 && strict;
        } else {
            known.high = known.high.min(bound);
            known.nonzero |= bound < 0.0 || bound == 0.0 && strict;
        }
    }
    ranges
}

/// Whether a·x + b rises, and a bound of its zero from outside of where it is positive.
fn half_line(dag: &mut Dag, id: Id, name: &Name) -> Option<(bool, f64)> {
    let slope = differentiate(dag, id, name);
    let slope = normalise(dag, slope)?;
    let slope = dag.as_constant(slope)?.clone();
    if slope.is_zero() {
        return None;
    }
    let zero = dag.integer(0);
    let offset = dag.substitute(id, &HashMap::from([(name.clone(), zero)]));
    let offset = normalise(dag, offset)?;
    let zero = -dag.as_constant(offset)? / &slope;
    let rises = slope.is_positive();
    let bound = zero.to_f64().filter(|bound| bound.is_finite())?;
    let is_exact = zero.is_integer() && bound.abs() < 9e15;
    let outwards = if is_exact {
        bound
    } else if rises {
        bound.next_down()
    } else {
        bound.next_up()
    };
    Some((rises, outwards))
}

/// The enclosure of `id`, or of its normal form where that says more about its sign.
fn simplest_range(dag: &mut Dag, id: Id, ranges: &Ranges) -> Interval {
    let range = Interval::of_within(dag, id, ranges);
    if range.is_not_negative() || range.is_not_positive() {
        return range;
    }
    match normalise(dag, id) {
        Some(normal) => Interval::of_within(dag, normal, ranges),
        None => range,
    }
}
