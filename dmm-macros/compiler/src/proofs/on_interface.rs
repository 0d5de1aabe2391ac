//! Whether an expression is zero at the points of an interface g = 0.
//!
//! Where g gives one state by the others, that state is replaced: g = s x + r with a number s by
//! x = −r/s, and g = c x² + r with a c that is nowhere zero by x = ±√(−r/c), on both branches.
//! Of other interfaces only what is zero everywhere is proved. A counterexample is a point of
//! the interface.

use std::collections::{BTreeMap, HashMap};

use super::place::decide;
use super::points::points;
use super::{Derivatives, Variables};
use crate::algebra::normal_form::decide_zero_on;
use crate::algebra::{
    Counterexample, Dag, Id, Math, Name, Verdict, differentiate, evaluate, evaluate_bounded,
    gradient, normalise,
};

/// Points tried.
const TRIALS: usize = 512;
/// Steps of Newton's method from a point to the interface.
const STEPS: usize = 20;
/// How far a point is from the interface, relative to the coordinates …
const CLOSE: f64 = 1e-13;
/// … and what a residual there is relative to ψ, if it is clearly not zero.
const CLEARLY: f64 = 1e-6;

/// Whether `changed` = `psi` on g = 0 where every one of `conditions` is positive.
pub(super) fn is_equal(
    dag: &mut Dag,
    variables: &Variables,
    g: Id,
    [psi, changed]: [Id; 2],
    conditions: &[Id],
) -> Verdict {
    let residual = dag.sub(changed, psi);
    let everywhere = decide(dag, variables, residual, &[psi, changed], conditions);
    if everywhere == Verdict::Proved {
        return everywhere;
    }
    let Some(solutions) = solutions(dag, g, &variables.states) else {
        return match refute(dag, variables, g, [psi, changed], conditions) {
            Some(found) => Verdict::Refuted(found),
            None => Verdict::Undecided,
        };
    };
    for solution in solutions {
        let root = dag.substitute(residual, &solution);
        let verdict = decide(dag, variables, root, &[psi, changed], conditions);
        if verdict != Verdict::Proved {
            return verdict;
        }
    }
    Verdict::Proved
}

/// A state by the others on g = 0, on each branch; nothing if g gives none.
fn solutions(dag: &mut Dag, g: Id, states: &[Name]) -> Option<Vec<HashMap<Name, Id>>> {
    let slopes = Derivatives::of(dag, g, states).gradient;
    let mut linear = states.iter().zip(&slopes);
    let linear =
        linear.find(|(_, slope)| dag.as_constant(**slope).is_some() && !dag.is_zero(**slope));
    if let Some((state, &slope)) = linear {
        let x = dag.variable(state);
        let rest = dag.div(g, slope);
        return Some(vec![HashMap::from([(state.clone(), dag.sub(x, rest))])]);
    }
    let mut quadratic = states.iter().zip(&slopes);
    quadratic.find_map(|(state, &slope)| {
        let square = square_on(dag, g, slope, state, states)?;
        let root = dag.sqrt(square);
        let opposite = dag.neg(root);
        Some(
            [root, opposite]
                .map(|x| HashMap::from([(state.clone(), x)]))
                .into(),
        )
    })
}

/// x² = −r/c on g = c x² + r = 0, if g is that, with a c that depends on parameters alone and is
/// nowhere zero.
fn square_on(dag: &mut Dag, g: Id, slope: Id, x: &Name, states: &[Name]) -> Option<Id> {
    let twice = differentiate(dag, slope, x);
    let twice = normalise(dag, twice)?;
    if dag.is_zero(twice) || states.iter().any(|state| dag.depends_on(twice, state)) {
        return None;
    }
    let two = dag.integer(2);
    let inverse = dag.div(two, twice);
    let inverse = normalise(dag, inverse).filter(|&inverse| is_polynomial(dag, inverse))?;
    let zero = dag.integer(0);
    let rest = dag.substitute(g, &HashMap::from([(x.clone(), zero)]));
    let variable = dag.variable(x);
    let square = dag.powi(variable, 2);
    let term = dag.div(square, inverse);
    let sum = dag.add(term, rest);
    let difference = dag.sub(g, sum);
    if decide_zero_on(dag, difference, &[g]) != Verdict::Proved {
        return None;
    }
    let quotient = dag.mul(rest, inverse);
    Some(dag.neg(quotient))
}

/// Whether an expression has a value everywhere, because it is a polynomial.
fn is_polynomial(dag: &Dag, root: Id) -> bool {
    dag.reachable([root]).into_iter().all(|id| match dag[id] {
        Math::Pi | Math::Constant(_) | Math::Variable(_) | Math::Add(_) | Math::Sub(_) => true,
        Math::Mul(_) | Math::Neg(_) => true,
        Math::Pow([_, power]) => dag.as_integer(power).is_some_and(|power| power > 0),
        Math::Div([_, divisor]) => dag.as_constant(divisor).is_some(),
        Math::Call(..) | Math::Pair(..) => false,
    })
}

/// A point of g = 0 with positive `conditions` at which ψ clearly changes.
fn refute(
    dag: &mut Dag,
    variables: &Variables,
    g: Id,
    [psi, changed]: [Id; 2],
    conditions: &[Id],
) -> Option<Counterexample> {
    let slopes = gradient(dag, g, &variables.states);
    let residual = dag.sub(changed, psi);
    let roots: Vec<Id> = [residual, psi, changed]
        .iter()
        .chain(conditions)
        .copied()
        .collect();
    let tried = points(dag, variables).take(TRIALS);
    let tried: Vec<_> = tried.collect();
    let on = tried
        .into_iter()
        .filter_map(|point| on_zero(dag, variables, g, &slopes, point));
    let (point, value) = on.into_iter().find_map(|point| {
        let values = evaluate_bounded(dag, &roots, &point);
        let [(value, error), (before, _), (after, _), conditions @ ..] = values.as_slice() else {
            return None;
        };
        let holds = conditions.iter().all(|(condition, _)| *condition > 0.0);
        let clearly = (CLEARLY * (before.abs() + after.abs())).max(1e4 * error);
        (holds && value.is_finite() && value.abs() > clearly).then_some((point, *value))
    })?;
    let depends_on = dag.variables([residual]);
    Some(Counterexample {
        residual: normalise(dag, residual).unwrap_or(residual),
        point: point
            .into_iter()
            .filter(|(name, _)| depends_on.contains(name))
            .collect(),
        value,
    })
}

/// The point of g = 0 that Newton's method leads to, if it does.
fn on_zero(
    dag: &Dag,
    variables: &Variables,
    g: Id,
    slopes: &[Id],
    mut point: BTreeMap<Name, f64>,
) -> Option<BTreeMap<Name, f64>> {
    let roots: Vec<Id> = [g].iter().chain(slopes).copied().collect();
    for _ in 0..STEPS {
        let values = evaluate(dag, &roots, &point);
        let (value, slopes) = values.split_first()?;
        let square: f64 = slopes.iter().map(|slope| slope * slope).sum();
        let length = value / square;
        if !length.is_finite() {
            return None;
        }
        for (name, slope) in variables.states.iter().zip(slopes) {
            *point.get_mut(name)? -= length * slope;
        }
        if (length * square.sqrt()).abs() <= CLOSE {
            return Some(point);
        }
    }
    None
}
