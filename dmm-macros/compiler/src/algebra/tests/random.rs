//! Random expressions of the whole language of declarations, and random points.

use std::collections::BTreeMap;

use proptest::prelude::*;

use crate::algebra::{Dag, Function, Id, Name};

/// An expression to be built.
#[derive(Clone, Debug)]
pub(super) enum Recipe {
    Variable(usize),
    Fraction(i64, i64),
    Pi,
    Neg(Box<Recipe>),
    Add(Box<Recipe>, Box<Recipe>),
    Sub(Box<Recipe>, Box<Recipe>),
    Mul(Box<Recipe>, Box<Recipe>),
    Div(Box<Recipe>, Box<Recipe>),
    Integer(Box<Recipe>, i64),
    Rational(Box<Recipe>, i64, i64),
    Pow(Box<Recipe>, Box<Recipe>),
    Call(Function, Box<Recipe>),
}

/// Names of the variables; the last one is a constant of the divided differences.
pub(super) const VARIABLES: [&str; 3] = ["x", "y", "k"];

/// The variables that differ between the ends of a step.
pub(super) fn states() -> Vec<Name> {
    VARIABLES[..2].iter().map(|name| Name::new(name)).collect()
}

/// Every variable.
pub(super) fn all_variables() -> Vec<Name> {
    VARIABLES.iter().map(|name| Name::new(name)).collect()
}

/// Functions that a declaration can call.
fn functions() -> Vec<Function> {
    let declarable = |function: &Function| function.is_declarable();
    Function::ALL.iter().copied().filter(declarable).collect()
}

/// Expressions of up to `depth` levels.
pub(super) fn recipe(depth: u32) -> impl Strategy<Value = Recipe> {
    use Recipe::*;
    let leaf = prop_oneof![
        6 => (0..VARIABLES.len()).prop_map(Variable),
        2 => (-5_i64..=5, 1_i64..=4).prop_map(|(n, d)| Fraction(n, d)),
        1 => Just(Pi),
    ];
    leaf.prop_recursive(depth, 24, 2, |inner| {
        let one = inner.clone().prop_map(Box::new);
        let two = (one.clone(), one.clone());
        prop_oneof![
            1 => one.clone().prop_map(Neg),
            3 => two.clone().prop_map(|(u, v)| Add(u, v)),
            2 => two.clone().prop_map(|(u, v)| Sub(u, v)),
            4 => two.clone().prop_map(|(u, v)| Mul(u, v)),
            1 => two.clone().prop_map(|(u, v)| Div(u, v)),
            2 => (one.clone(), -3_i64..=6).prop_map(|(u, n)| Integer(u, n)),
            1 => (one.clone(), -3_i64..=5, 2_i64..=4).prop_map(|(u, n, d)| Rational(u, n, d)),
            1 => two.prop_map(|(u, v)| Pow(u, v)),
            5 => (prop::sample::select(functions()), one).prop_map(|(f, u)| Call(f, u)),
        ]
    })
}

/// Builds a recipe. Arguments of functions that are not defined everywhere are first mapped
/// into their domain.
pub(super) fn build(dag: &mut Dag, recipe: &Recipe) -> Id {
    use Recipe::*;
    match recipe {
        Variable(index) => dag.variable(&Name::new(VARIABLES[*index])),
        Fraction(n, d) => dag.fraction(*n, *d),
        Pi => dag.pi(),
        Neg(u) => {
            let u = build(dag, u);
            dag.neg(u)
        }
        Add(u, v) | Sub(u, v) | Mul(u, v) => {
            let [a, b] = [u, v].map(|child| build(dag, child));
            match recipe {
                Add(..) => dag.add(a, b),
                Sub(..) => dag.sub(a, b),
                _ => dag.mul(a, b),
            }
        }
        Div(u, v) => {
            let [a, b] = [u, v].map(|child| build(dag, child));
            let b = positive(dag, b);
            dag.div(a, b)
        }
        Integer(u, n) => {
            let base = build(dag, u);
            let base = if *n < 0 { positive(dag, base) } else { base };
            dag.powi(base, *n)
        }
        Rational(u, n, d) => {
            let base = build(dag, u);
            let base = positive(dag, base);
            let exponent = dag.fraction(*n, *d);
            dag.pow(base, exponent)
        }
        Pow(u, v) => {
            let [base, exponent] = [u, v].map(|child| build(dag, child));
            let base = positive(dag, base);
            dag.pow(base, exponent)
        }
        Call(function, u) => {
            let u = build(dag, u);
            let u = match function {
                Function::Sqrt | Function::Ln => positive(dag, u),
                Function::Asin | Function::Acos => small(dag, u),
                _ => u,
            };
            dag.call(*function, u)
        }
    }
}

/// A variable as it is (points are positive), u² + 1/2 of anything else.
fn positive(dag: &mut Dag, u: Id) -> Id {
    if matches!(dag[u], crate::algebra::Math::Variable(_)) {
        return u;
    }
    let square = dag.powi(u, 2);
    let half = dag.fraction(1, 2);
    dag.add(square, half)
}

/// u/(1 + u²), at most 1/2 in size.
fn small(dag: &mut Dag, u: Id) -> Id {
    let square = dag.powi(u, 2);
    let one = dag.integer(1);
    let sum = dag.add(one, square);
    dag.div(u, sum)
}

/// Positive coordinates.
pub(super) fn point() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(0.3..1.6)
}

/// The values of the variables at a point.
pub(super) fn values(point: &[f64; 3]) -> BTreeMap<Name, f64> {
    all_variables().into_iter().zip(*point).collect()
}

/// The values of x₀, x₁, … at two ends with the constants of the first.
pub(super) fn ends(start: &[f64; 3], end: &[f64; 3]) -> BTreeMap<Name, f64> {
    let mut values = values(start);
    for (index, name) in states().iter().enumerate() {
        values.insert(name.at_start(), start[index]);
        values.insert(name.at_end(), end[index]);
    }
    values
}
