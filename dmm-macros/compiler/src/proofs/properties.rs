//! Properties of what is proved, for random formulas at random points of both signs: nothing
//! that is proved is false where its conditions hold, and where they hold there is a value.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;

use super::DomainCondition;
use super::conditions::domain;
use crate::algebra::normal_form::decide_zero_on;
use crate::algebra::{Dag, Function, Id, Name, Verdict, evaluate_bounded};

/// A first-order error bound is trusted up to this factor.
const SAFETY: f64 = 64.0;

/// Formulas in which signs matter: roots, logarithms and powers of products.
#[derive(Clone, Debug)]
enum Formula {
    Variable(usize),
    Neg(Box<Formula>),
    Sum(Box<Formula>, Box<Formula>),
    Product(Box<Formula>, Box<Formula>),
    Quotient(Box<Formula>, Box<Formula>),
    Square(Box<Formula>),
    Root(Box<Formula>),
    Power(Box<Formula>, i64, i64),
    Logarithm(Box<Formula>),
    Arc(Box<Formula>),
}

fn formula() -> impl Strategy<Value = Formula> {
    use Formula::*;
    let leaf = (0..3_usize).prop_map(Variable);
    leaf.prop_recursive(4, 14, 2, |inner| {
        let one = inner.clone().prop_map(Box::new);
        let two = (one.clone(), one.clone());
        prop_oneof![
            1 => one.clone().prop_map(Neg),
            2 => two.clone().prop_map(|(u, v)| Sum(u, v)),
            5 => two.clone().prop_map(|(u, v)| Product(u, v)),
            1 => two.prop_map(|(u, v)| Quotient(u, v)),
            2 => one.clone().prop_map(Square),
            5 => one.clone().prop_map(Root),
            1 => (one.clone(), prop::sample::select(vec![(3, 2), (-1, 2), (2, 3), (-3, 1)]))
                .prop_map(|(u, (n, d))| Power(u, n, d)),
            3 => one.clone().prop_map(Logarithm),
            1 => one.prop_map(Arc),
        ]
    })
}

/// Builds a formula; `split` applies √(uv) = √u√v, √(u²) = u, ln(uv) = ln u + ln v and
/// (uv)^r = u^r v^r whatever the signs are.
fn build(dag: &mut Dag, formula: &Formula, split: bool) -> Id {
    use Formula::*;
    let pair = |dag: &mut Dag, u: &Formula, v: &Formula| [u, v].map(|w| build(dag, w, split));
    match formula {
        Variable(index) => dag.variable(&Name::new(NAMES[*index])),
        Neg(u) => {
            let u = build(dag, u, split);
            dag.neg(u)
        }
        Sum(u, v) => {
            let [u, v] = pair(dag, u, v);
            dag.add(u, v)
        }
        Product(u, v) => {
            let [u, v] = pair(dag, u, v);
            dag.mul(u, v)
        }
        Quotient(u, v) => {
            let [u, v] = pair(dag, u, v);
            dag.div(u, v)
        }
        Square(u) => {
            let u = build(dag, u, split);
            dag.powi(u, 2)
        }
        Root(u) => match (&**u, split) {
            (Product(a, b), true) => {
                let [a, b] = pair(dag, a, b).map(|w| dag.sqrt(w));
                dag.mul(a, b)
            }
            (Square(a), true) => build(dag, a, split),
            _ => {
                let u = build(dag, u, split);
                dag.sqrt(u)
            }
        },
        Power(u, n, d) => {
            let exponent = dag.fraction(*n, *d);
            match (&**u, split) {
                (Product(a, b), true) => {
                    let [a, b] = pair(dag, a, b).map(|w| dag.pow(w, exponent));
                    dag.mul(a, b)
                }
                _ => {
                    let u = build(dag, u, split);
                    dag.pow(u, exponent)
                }
            }
        }
        Logarithm(u) => match (&**u, split) {
            (Product(a, b), true) => {
                let [a, b] = pair(dag, a, b).map(|w| dag.call(Function::Ln, w));
                dag.add(a, b)
            }
            _ => {
                let u = build(dag, u, split);
                dag.call(Function::Ln, u)
            }
        },
        Arc(u) => {
            let u = build(dag, u, split);
            dag.call(Function::Asin, u)
        }
    }
}

const NAMES: [&str; 3] = ["x", "y", "z"];

fn values(point: [f64; 3]) -> BTreeMap<Name, f64> {
    NAMES
        .iter()
        .map(|name| Name::new(name))
        .zip(point)
        .collect()
}

/// Whether every condition holds clearly at a point, beyond the rounding of its argument.
fn hold(dag: &Dag, conditions: &[DomainCondition], values: &BTreeMap<Name, f64>) -> bool {
    conditions.iter().all(|condition| {
        let (DomainCondition::Positive(u)
        | DomainCondition::NotNegative(u)
        | DomainCondition::NonZero(u)
        | DomainCondition::WithinOne(u)) = condition;
        let (value, error) = evaluate_bounded(dag, &[*u], values)[0];
        let margin = SAFETY * error + 1e-12;
        match condition {
            DomainCondition::Positive(_) | DomainCondition::NotNegative(_) => value > margin,
            DomainCondition::NonZero(_) => value.abs() > margin,
            DomainCondition::WithinOne(_) => value.abs() < 1.0 - margin,
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Where the conditions hold, the formula has a value.
    #[test]
    fn conditions_are_complete(formula in formula(), points in prop::array::uniform8(prop::array::uniform3(-2.0..2.0))) {
        let mut dag = Dag::new();
        let root = build(&mut dag, &formula, false);
        let conditions = domain(&mut dag, &[root], &[], &BTreeSet::new()).conditions;
        for point in points {
            let values = values(point);
            if hold(&dag, &conditions, &values) {
                let (value, _) = evaluate_bounded(&dag, &[root], &values)[0];
                prop_assert!(!value.is_nan(), "{conditions:?} at {point:?}");
            }
        }
    }

    /// What is proved is zero where its conditions hold, whatever the signs are.
    #[test]
    fn proved_is_zero_on_its_domain(formula in formula(), points in prop::array::uniform8(prop::array::uniform3(-2.0..2.0))) {
        let mut dag = Dag::new();
        let [whole, split] = [false, true].map(|split| build(&mut dag, &formula, split));
        let residual = dag.sub(whole, split);
        if decide_zero_on(&mut dag, residual, &[whole, split]) == Verdict::Proved {
            let conditions = domain(&mut dag, &[whole, split], &[], &BTreeSet::new()).conditions;
            for point in points {
                let values = values(point);
                let (value, error) = evaluate_bounded(&dag, &[residual], &values)[0];
                if hold(&dag, &conditions, &values) && error.is_finite() {
                    prop_assert!(value.abs() <= SAFETY * error + f64::MIN_POSITIVE, "{value} at {point:?}");
                }
            }
        }
    }
}
