//! A program has everything that a back end needs: functions and Taylor coefficients are evaluated
//! here from its data alone, for every declaration that holds.

#[path = "accuracy/arithmetic.rs"]
#[allow(dead_code, reason = "the accuracy of emitted code uses the rest")]
mod arithmetic;
#[path = "support/corpus.rs"]
mod corpus;
#[path = "program/series.rs"]
mod series;
#[path = "program/tape.rs"]
mod tape;

use std::collections::BTreeMap;

use arithmetic::doubles;
use dmm_compiler::algebra::{Dag, Id, Name};
use dmm_compiler::model::Model;
use dmm_compiler::program::series::SeriesResult;
use dmm_compiler::program::{Dynamics, Functions, Program};
use dmm_compiler::scheme::{Scheme, Strategy};
use series::Coefficients;
use tape::{Point, evaluated, stored};

/// Coefficients of a series.
const ORDER: usize = 10;
/// Where a series is compared with the function that it is of.
const STEP: f64 = 1e-2;
/// Rounding errors at points of the order of 1, some cancellation included.
const ROUNDING: f64 = 1e-9;

/// The schemes of all declarations that hold.
fn schemes() -> impl Iterator<Item = (String, Scheme)> {
    corpus::all_sound().into_iter().map(|sample| {
        let tokens = sample.source.parse().expect("tokens");
        let scheme = dmm_compiler::read(tokens).expect("the declaration holds");
        (sample.name, scheme)
    })
}

/// The variables of a system at a point, by name.
fn named(scheme: &Scheme, region: Option<usize>, point: &Point) -> BTreeMap<Name, f64> {
    let model = &scheme.model;
    let mut values = BTreeMap::new();
    for (index, name) in model.state_names().into_iter().enumerate() {
        values.insert(name.at_start(), point.start[index]);
        values.insert(name.at_end(), point.end[index]);
        values.insert(name, point.state[index]);
    }
    let time = Model::time();
    values.insert(time.at_start(), point.times[0]);
    values.insert(time.at_end(), point.times[1]);
    values.insert(time, point.time);
    for (parameter, &value) in model.parameters.iter().zip(&point.parameters) {
        values.insert(parameter.name.clone(), value);
    }
    let strategy = region.map(|region| &scheme.regions[region].strategy);
    if let Some(Strategy::MinimalNorm { lambda, field, .. }) = strategy {
        values.extend(field.iter().cloned().zip(point.field.iter().copied()));
        values.extend(
            lambda
                .iter()
                .cloned()
                .zip(point.multipliers.iter().copied()),
        );
    }
    values
}

/// Compares the values of functions with those of their results as expressions.
fn check_functions(functions: &Functions, point: &Point, named: &BTreeMap<Name, f64>, name: &str) {
    let stored = stored(functions, point);
    for function in &functions.all {
        let values = evaluated(functions, function, &stored, point);
        let roots = function.results.roots();
        let expected = doubles(functions.lowered.dag(), &roots, named);
        let bits =
            |values: &[f64]| -> Vec<u64> { values.iter().map(|one| one.to_bits()).collect() };
        assert_eq!(
            bits(&values),
            bits(&expected),
            "{name}: {:?}",
            function.quantity
        );
    }
}

#[test]
fn functions_are_evaluated_from_their_inputs_in_their_order() {
    for (name, scheme) in schemes() {
        let program = Program::new(&scheme);
        let point = Point::new(&scheme);
        for (region, dynamics) in program.dynamics.iter().enumerate() {
            let named = named(&scheme, Some(region), &point);
            check_functions(&dynamics.functions, &point, &named, &name);
        }
        if let Some(guards) = &program.guards {
            check_functions(
                &guards.functions,
                &point,
                &named(&scheme, None, &point),
                &name,
            );
        }
        for (parameter, default) in scheme.model.parameters.iter().zip(&program.defaults) {
            let dag = default.lowered.dag();
            let value = doubles(dag, &[default.value], &BTreeMap::new())[0];
            let expected = doubles(scheme.dag(), &[parameter.default], &BTreeMap::new())[0];
            assert!((value - expected).abs() <= 1e-15 * expected.abs(), "{name}");
        }
    }
}

/// The coefficients of the solution through `point`.
fn solution(dynamics: &Dynamics, point: &Point) -> Coefficients {
    let mut solution = Coefficients::of_solution(&dynamics.series, point, ORDER);
    let stored = stored(&dynamics.functions, point);
    for k in 0..ORDER {
        solution.advance(
            &dynamics.functions,
            &dynamics.series,
            &stored,
            k,
            point.time,
        );
    }
    solution
}

/// Σ cₖ hᵏ and its derivative.
fn sum(coefficients: &[f64]) -> (f64, f64) {
    let terms = coefficients.iter().enumerate();
    terms.fold((0.0, 0.0), |(value, slope), (k, c)| {
        let power = STEP.powi(k as i32);
        (value + c * power, slope + k as f64 * c * power / STEP)
    })
}

/// What the terms that are left out may add to a derivative.
fn remainder(states: &[Vec<f64>]) -> f64 {
    let last = states
        .iter()
        .map(|c| c[ORDER].abs() + c[ORDER - 1].abs() * STEP);
    let largest = last.fold(0.0, f64::max);
    100.0 * ORDER as f64 * largest * STEP.powi(ORDER as i32 - 1)
}

/// The values of expressions at the end of the step of a solution.
fn at_the_end(scheme: &Scheme, states: &[Vec<f64>], point: &Point, roots: &[Id]) -> Vec<f64> {
    let mut point = point.clone();
    point.time += STEP;
    point.state = states.iter().map(|c| sum(c).0).collect();
    let dag: &Dag = scheme.dag();
    doubles(dag, roots, &named(scheme, None, &point))
}

#[test]
fn recurrences_give_the_taylor_coefficients_of_the_solution() {
    let mut compared = 0;
    for (name, scheme) in schemes() {
        let (program, point) = (Program::new(&scheme), Point::new(&scheme));
        for (region, dynamics) in program.dynamics.iter().enumerate() {
            let solution = solution(dynamics, &point);
            let states = &solution.slots[..program.states.len()];
            if states.iter().flatten().any(|c| !c.is_finite()) {
                continue; // beyond the domain of f
            }
            let field = &scheme.model.regions[region].field;
            let expected = at_the_end(&scheme, states, &point, field);
            for (c, expected) in states.iter().zip(expected) {
                let error = (sum(c).1 - expected).abs();
                let bound = ROUNDING * (1.0 + expected.abs()) + remainder(states);
                assert!(error <= bound, "{name}: {error:e} > {bound:e}");
                compared += usize::from(bound < 1e-6 * (1.0 + expected.abs()));
            }
            assert!(
                solution.disagreement <= ROUNDING,
                "{name}: later coefficients"
            );
        }
    }
    assert!(compared > 300, "{compared} components were compared");
}

#[test]
fn recurrences_give_the_taylor_coefficients_of_switching_functions() {
    let mut compared = 0;
    for (name, scheme) in schemes() {
        let (program, point) = (Program::new(&scheme), Point::new(&scheme));
        let Some(guards) = &program.guards else {
            continue;
        };
        let solution = solution(&program.dynamics[0], &point);
        let states = &solution.slots[..program.states.len()];
        let mut along = Coefficients::along(&guards.series, states, ORDER);
        let stored = stored(&guards.functions, &point);
        for k in 0..=ORDER {
            along.advance(&guards.functions, &guards.series, &stored, k, point.time);
        }
        let interfaces = scheme.model.interfaces.iter();
        let interfaces: Vec<Id> = interfaces.map(|one| one.switching_function).collect();
        let expected = at_the_end(&scheme, states, &point, &interfaces);
        for (index, expected) in expected.into_iter().enumerate() {
            assert!(matches!(
                guards.series.results[index],
                SeriesResult::Value(_)
            ));
            let c = &along.slots[index];
            if expected.is_finite() && c.iter().all(|c| c.is_finite()) {
                let error = (sum(c).0 - expected).abs();
                let bound = ROUNDING * (1.0 + expected.abs()) + remainder(&along.slots[..=index]);
                assert!(error <= bound, "{name}: {error:e} > {bound:e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 10, "{compared} functions were compared");
}
