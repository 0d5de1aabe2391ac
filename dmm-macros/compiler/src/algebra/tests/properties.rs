//! Properties of derivatives, divided differences and normal forms of random expressions at
//! random points. Values are compared within the bounds of their own rounding errors, by a
//! factor that covers what a first-order bound leaves out.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::random::{all_variables, build, ends, point, recipe, states, values};
use crate::algebra::{
    Dag, Id, Name, Verdict, at_end, at_start, decide_zero, differentiate, divide_exactly,
    divided_difference, evaluate, evaluate_bounded, gradient, jacobian, normalise,
};

/// A first-order error bound is trusted up to this factor.
const SAFETY: f64 = 16.0;

/// Whether two expressions have equal values at a point, as far as rounding can tell; true
/// where one of them has no value or no digit.
fn agree(dag: &Dag, a: Id, b: Id, values: &BTreeMap<Name, f64>) -> Result<(), TestCaseError> {
    let [(a, error_a), (b, error_b)] = evaluate_bounded(dag, &[a, b], values)[..] else {
        unreachable!("two roots have two values");
    };
    if (a - b).is_finite() && (error_a + error_b).is_finite() {
        let bound = SAFETY * (error_a + error_b) + f64::MIN_POSITIVE;
        prop_assert!(
            (a - b).abs() <= bound,
            "{a} and {b} differ by more than {bound}"
        );
    }
    Ok(())
}

/// ψ(end) − ψ(start) and Σ c_v (v₁ − v₀).
fn telescoped(dag: &mut Dag, psi: Id) -> [Id; 2] {
    let states = states();
    let coefficients = divided_difference(dag, psi, &states);
    let end = at_end(dag, psi, &states);
    let start = at_start(dag, psi, &states);
    let mut sum = dag.integer(0);
    for (name, coefficient) in states.iter().zip(coefficients) {
        let end = dag.variable(&name.at_end());
        let start = dag.variable(&name.at_start());
        let difference = dag.sub(end, start);
        let term = dag.mul(coefficient, difference);
        sum = dag.add(sum, term);
    }
    [dag.sub(end, start), sum]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// Central differences of fourth order with two steps: their distance estimates the error.
    #[test]
    fn derivative_is_the_limit_of_quotients(recipe in recipe(4), point in point(), index in 0..3_usize) {
        let mut dag = Dag::new();
        let root = build(&mut dag, &recipe);
        let name = all_variables().swap_remove(index);
        let derivative = differentiate(&mut dag, root, &name);
        let at = |offset: f64| {
            let mut point = point;
            point[index] += offset;
            evaluate(&dag, &[root], &values(&point))[0]
        };
        let quotient = |h: f64| (8.0 * (at(h) - at(-h)) - at(2.0 * h) + at(-2.0 * h)) / (12.0 * h);
        let (coarse, fine) = (quotient(2e-3), quotient(1e-3));
        let value = evaluate(&dag, &[derivative], &values(&point))[0];
        // where the function oscillates faster than the steps, the quotients differ at random
        let finest = quotient(7e-4);
        let spread = (coarse - fine).abs().max((finest - fine).abs());
        let uncertainty = spread + 1e-11 * at(0.0).abs();
        let scale = fine.abs() + 1e-3;
        if fine.is_finite() && uncertainty < 1e-3 * scale {
            prop_assert!(
                (value - fine).abs() <= 4.0 * uncertainty + 1e-8 * scale,
                "derivative {value}, quotient {fine} ± {uncertainty}"
            );
        }
    }

    #[test]
    fn gradient_and_jacobian_are_the_derivatives(recipe in recipe(3)) {
        let mut dag = Dag::new();
        let root = build(&mut dag, &recipe);
        let square = dag.powi(root, 2);
        let names = all_variables();
        let gradient = gradient(&mut dag, root, &names);
        let jacobian = jacobian(&mut dag, &[root, square], &names);
        prop_assert_eq!(&gradient, &jacobian[0]);
        for (name, &entry) in names.iter().zip(&jacobian[1]) {
            prop_assert_eq!(differentiate(&mut dag, square, name), entry);
        }
    }

    #[test]
    fn divided_differences_telescope(recipe in recipe(4), start in point(), end in point()) {
        let mut dag = Dag::new();
        let psi = build(&mut dag, &recipe);
        let [difference, sum] = telescoped(&mut dag, psi);
        agree(&dag, difference, sum, &ends(&start, &end))?;
    }

    /// Nothing is divided by the distance of the ends: close ends lose no digits.
    #[test]
    fn divided_differences_telescope_between_close_ends(
        recipe in recipe(4), start in point(), distance in prop::array::uniform3(-1e-7..1e-7),
    ) {
        let mut dag = Dag::new();
        let psi = build(&mut dag, &recipe);
        let states = states();
        let coefficients = divided_difference(&mut dag, psi, &states);
        let derivatives = gradient(&mut dag, psi, &states);
        let end = [0, 1, 2].map(|index| start[index] + distance[index]);
        let between = ends(&start, &end);
        for ((coefficient, derivative), name) in coefficients.into_iter().zip(derivatives).zip(&states) {
            // c = ∂ψ at some point near the step: ∂ψ changes by its own derivative over it
            let slope = evaluate(&dag, &[derivative], &values(&start))[0];
            let slopes = gradient(&mut dag, derivative, &all_variables());
            let second: f64 = evaluate(&dag, &slopes, &values(&start)).iter().map(|s| s.abs()).sum();
            let (value, error) = evaluate_bounded(&dag, &[coefficient], &between)[0];
            let bound = SAFETY * (error + 1e-7 * second) + 1e-9 * (1.0 + slope.abs());
            if value.is_finite() && bound.is_finite() {
                prop_assert!((value - slope).abs() <= bound, "c_{name} = {value}, slope {slope}");
            }
        }
    }

    #[test]
    fn divided_difference_is_the_gradient_where_ends_coincide(recipe in recipe(4), point in point()) {
        let mut dag = Dag::new();
        let psi = build(&mut dag, &recipe);
        let states = states();
        let coefficients = divided_difference(&mut dag, psi, &states);
        let derivatives = gradient(&mut dag, psi, &states);
        for (coefficient, derivative) in coefficients.into_iter().zip(derivatives) {
            agree(&dag, coefficient, derivative, &ends(&point, &point))?;
        }
    }

    #[test]
    fn divided_difference_is_symmetric(recipe in recipe(4), start in point(), end in point()) {
        let mut dag = Dag::new();
        let psi = build(&mut dag, &recipe);
        let end = [end[0], end[1], start[2]];
        for coefficient in divided_difference(&mut dag, psi, &states()) {
            let forward = evaluate_bounded(&dag, &[coefficient], &ends(&start, &end))[0];
            let backward = evaluate_bounded(&dag, &[coefficient], &ends(&end, &start))[0];
            let bound = SAFETY * (forward.1 + backward.1) + f64::MIN_POSITIVE;
            if forward.0.is_finite() && backward.0.is_finite() && bound.is_finite() {
                prop_assert!((forward.0 - backward.0).abs() <= bound);
            }
        }
    }

    #[test]
    fn telescoping_is_never_refuted(recipe in recipe(3)) {
        let mut dag = Dag::new();
        let psi = build(&mut dag, &recipe);
        let [difference, sum] = telescoped(&mut dag, psi);
        let defect = dag.sub(difference, sum);
        let verdict = decide_zero(&mut dag, defect);
        prop_assert!(!matches!(verdict, Verdict::Refuted(_)), "{verdict:?}");
    }

    #[test]
    fn normal_form_keeps_the_value(recipe in recipe(4), point in point()) {
        let mut dag = Dag::new();
        let root = build(&mut dag, &recipe);
        if let Some(normal) = normalise(&mut dag, root) {
            agree(&dag, root, normal, &values(&point))?;
        }
    }

    #[test]
    fn normal_form_is_equal_to_its_origin(recipe in recipe(3)) {
        let mut dag = Dag::new();
        let root = build(&mut dag, &recipe);
        if let Some(normal) = normalise(&mut dag, root) {
            let difference = dag.sub(root, normal);
            let verdict = decide_zero(&mut dag, difference);
            prop_assert!(!matches!(verdict, Verdict::Refuted(_)), "{verdict:?}");
        }
    }

    /// Soundness: what is proved to be zero has no clearly non-zero value.
    #[test]
    fn proved_is_zero_everywhere(first in recipe(3), second in recipe(3), point in point()) {
        let mut dag = Dag::new();
        let [a, b] = [first, second].map(|recipe| build(&mut dag, &recipe));
        let sum = dag.add(a, b);
        let square = dag.powi(sum, 2);
        let [a_squared, b_squared] = [a, b].map(|root| dag.powi(root, 2));
        let product = dag.mul(a, b);
        let two = dag.integer(2);
        let mixed = dag.mul(two, product);
        let rest = dag.sum([a_squared, b_squared, mixed]);
        let binomial = dag.sub(square, rest);
        for root in [a, b, sum, binomial] {
            if decide_zero(&mut dag, root) == Verdict::Proved {
                let zero = dag.integer(0);
                agree(&dag, root, zero, &values(&point))?;
            }
        }
        prop_assert!(!matches!(decide_zero(&mut dag, binomial), Verdict::Refuted(_)));
    }

    #[test]
    fn division_undoes_multiplication(first in recipe(3), second in recipe(2), point in point()) {
        let mut dag = Dag::new();
        let [a, b] = [first, second].map(|recipe| build(&mut dag, &recipe));
        let product = dag.mul(a, b);
        // none where b is zero or the quotient cannot be written back
        if let Some(quotient) = divide_exactly(&mut dag, product, b) {
            agree(&dag, quotient.value, a, &values(&point))?;
        }
    }
}
