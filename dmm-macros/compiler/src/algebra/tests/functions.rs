//! Every function of the language, one by one: values, derivatives and their derivatives.

use std::collections::BTreeMap;

use crate::algebra::{Dag, Function, Id, Name, PairFunction, differentiate, evaluate};

/// Central differences of fourth order with h = 10⁻³ have an error of about h⁴ = 10⁻¹² of the
/// fifth derivative and 10⁻¹³ of rounding; fifth derivatives here are of the order of 10⁴ at most.
const TOLERANCE: f64 = 1e-8;

fn value(dag: &Dag, root: Id, a: f64, b: f64) -> f64 {
    let values = BTreeMap::from([(Name::new("a"), a), (Name::new("b"), b)]);
    evaluate(dag, &[root], &values)[0]
}

/// Compares ∂`root`/∂`variable` with the difference quotient at (a, b).
fn check(dag: &mut Dag, root: Id, variable: &str, a: f64, b: f64) {
    let derivative = differentiate(dag, root, &Name::new(variable));
    let h = 1e-3;
    let at = |offset: f64| match variable {
        "a" => value(dag, root, a + offset, b),
        _ => value(dag, root, a, b + offset),
    };
    let quotient = (8.0 * (at(h) - at(-h)) - at(2.0 * h) + at(-2.0 * h)) / (12.0 * h);
    let found = value(dag, derivative, a, b);
    assert!(
        (found - quotient).abs() <= TOLERANCE * (1.0 + quotient.abs()),
        "∂/∂{variable} of {:?} at ({a}, {b}): {found}, not {quotient}",
        dag[root]
    );
}

#[test]
fn functions_of_one_argument() {
    for &function in Function::ALL {
        for a in [0.3, 0.45, 0.7] {
            let mut dag = Dag::new();
            let u = dag.variable(&Name::new("a"));
            let root = dag.call(function, u);
            check(&mut dag, root, "a", a, 0.0);
            let derivative = differentiate(&mut dag, root, &Name::new("a"));
            if function != Function::Abs {
                check(&mut dag, derivative, "a", a, 0.0);
            }
        }
    }
}

#[test]
fn functions_of_two_arguments() {
    for &function in PairFunction::ALL {
        for (a, b) in [(0.3, 0.7), (0.65, 0.2), (0.5, 0.53), (0.4, 0.4)] {
            let mut dag = Dag::new();
            let [u, v] = ["a", "b"].map(|name| dag.variable(&Name::new(name)));
            let root = dag.pair(function, u, v);
            let is_prime = !matches!(
                function,
                PairFunction::LnDd | PairFunction::AsinDd | PairFunction::AtanDd
            );
            // the defining quotients of the second derivatives have no value at a = b
            if a != b || !is_prime {
                check(&mut dag, root, "a", a, b);
                check(&mut dag, root, "b", a, b);
            }
        }
    }
}

/// (h(b) − h(a))/(b − a) where nothing cancels, h′ where the ends coincide.
#[test]
fn divided_differences_have_their_values() {
    let ln = |dag: &mut Dag, name: PairFunction| {
        let [u, v] = ["a", "b"].map(|name| dag.variable(&Name::new(name)));
        dag.pair(name, u, v)
    };
    type Real = fn(f64) -> f64;
    let cases: [(PairFunction, Real, Real); 3] = [
        (PairFunction::LnDd, f64::ln, |u| 1.0 / u),
        (PairFunction::AsinDd, f64::asin, |u| {
            1.0 / (1.0 - u * u).sqrt()
        }),
        (PairFunction::AtanDd, f64::atan, |u| 1.0 / (1.0 + u * u)),
    ];
    for (function, outer, slope) in cases {
        let mut dag = Dag::new();
        let root = ln(&mut dag, function);
        for (a, b) in [(0.1_f64, 0.9), (0.9, 0.1), (0.3, 0.6)] {
            let expected = (outer(b) - outer(a)) / (b - a);
            assert!((value(&dag, root, a, b) - expected).abs() <= 8.0 * f64::EPSILON * expected);
        }
        let found = value(&dag, root, 0.4, 0.4);
        assert!((found - slope(0.4)).abs() <= 4.0 * f64::EPSILON * found);
        // at a distance of 10⁻⁹ the value is h′ in the middle up to 10⁻¹⁸ of h‴
        let found = value(&dag, root, 0.4, 0.4 + 1e-9);
        assert!((found - slope(0.4 + 5e-10)).abs() <= 4.0 * f64::EPSILON * found);
    }
}

#[test]
fn a_variable_without_a_value_gives_nan() {
    let mut dag = Dag::new();
    let root = dag.variable(&Name::new("x"));
    assert!(evaluate(&dag, &[root], &BTreeMap::new())[0].is_nan());
}
