//! The schemes at random points, by numbers: that Λ^τ telescopes, that f^τ conserves and is
//! consistent, and that its Jacobian is its derivative — for the minimal norm by the formula
//! ∂f^τ = P(∂f̄ − B) − Λ⁺C.

use std::collections::BTreeMap;

use dmm_compiler::algebra::{Dag, Id, Name, at_end, at_start, evaluate};
use dmm_compiler::model::Model;
use dmm_compiler::scheme::{Explicit, RegionScheme, Scheme, Strategy};

use crate::{scheme, systems};

/// Points a system.
const POINTS: usize = 20;
/// Rounding of a few dozen operations on values of about one, relative to the largest.
const ROUNDING: f64 = 1e-11;
/// Central differences with h = 1e-5: h² of truncation, and 1e-16/h of rounding, times
/// derivatives of up to a hundred.
const DIFFERENCE: f64 = 1e-7;

type Point = BTreeMap<Name, f64>;
type Matrix = Vec<Vec<f64>>;

/// A linear congruential generator: the points are the same in every run.
struct Random(u64);

impl Random {
    /// Uniform in [low, high].
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }
}

/// Both ends of a step and the parameters; all positive, so that every formula has a value.
fn random_point(scheme: &Scheme, random: &mut Random) -> Point {
    let mut point = Point::new();
    let time = Model::time();
    for name in scheme
        .model
        .states
        .iter()
        .map(|state| &state.name)
        .chain([&time])
    {
        let start = random.between(0.4, 1.6);
        point.insert(name.at_start(), start);
        point.insert(name.at_end(), start + random.between(-0.3, 0.3));
    }
    for parameter in &scheme.model.parameters {
        point.insert(parameter.name.clone(), random.between(0.5, 2.0));
    }
    point
}

fn states(scheme: &Scheme) -> Vec<Name> {
    scheme
        .model
        .states
        .iter()
        .map(|state| state.name.clone())
        .collect()
}

fn rows(dag: &Dag, rows: &[Vec<Id>], point: &Point) -> Matrix {
    rows.iter().map(|row| evaluate(dag, row, point)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn column(matrix: &Matrix, index: usize) -> Vec<f64> {
    matrix.iter().map(|row| row[index]).collect()
}

/// The solution of A x = b by elimination with pivoting.
fn solve(mut a: Matrix, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()));
        let pivot = pivot.unwrap_or(k);
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            let (above, below) = a.split_at_mut(i);
            for (entry, pivot) in below[0].iter_mut().zip(&above[k]).skip(k) {
                *entry -= factor * pivot;
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let rest: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - rest) / a[k][k];
    }
    b
}

/// (Λ Λᵀ)⁻¹ r
fn gram_solve(multiplier: &Matrix, right: Vec<f64>) -> Vec<f64> {
    let gram = multiplier
        .iter()
        .map(|row| multiplier.iter().map(|other| dot(row, other)).collect())
        .collect();
    solve(gram, right)
}

/// Λᵀ λ
fn transposed(multiplier: &Matrix, lambda: &[f64], states: usize) -> Vec<f64> {
    (0..states)
        .map(|state| dot(&column(multiplier, state), lambda))
        .collect()
}

/// f^τ and λ (empty where f^τ is an expression).
fn field(dag: &Dag, region: &RegionScheme, point: &Point) -> (Vec<f64>, Vec<f64>) {
    match &region.strategy {
        Strategy::Midpoint { field }
        | Strategy::SkewPairing { field, .. }
        | Strategy::CrossProduct { field, .. } => (evaluate(dag, &field.value, point), Vec::new()),
        Strategy::MinimalNorm { mean, .. } => {
            let multiplier = rows(dag, &region.discrete_multiplier, point);
            let by_time = evaluate(dag, &region.discrete_time_derivative, point);
            let mean = evaluate(dag, &mean.value, point);
            let right = multiplier
                .iter()
                .zip(by_time)
                .map(|(row, t)| dot(row, &mean) + t);
            let lambda = gram_solve(&multiplier, right.collect());
            let correction = transposed(&multiplier, &lambda, mean.len());
            let field = mean.iter().zip(correction).map(|(f, c)| f - c).collect();
            (field, lambda)
        }
    }
}

/// The derivatives of f^τ by the states at the end and by the time there: N columns and one.
fn derivatives(dag: &Dag, region: &RegionScheme, point: &Point) -> Matrix {
    let with_time = |field: &Explicit| -> Matrix {
        let mut columns = rows(dag, &field.jacobian, point);
        let by_time = evaluate(dag, &field.time_derivative, point);
        columns
            .iter_mut()
            .zip(by_time)
            .for_each(|(row, entry)| row.push(entry));
        columns
    };
    let Strategy::MinimalNorm {
        mean,
        lambda,
        field: field_names,
        transposed_jacobian,
        transposed_time_derivative,
        constraint_jacobian,
        constraint_time_derivative,
    } = &region.strategy
    else {
        return match &region.strategy {
            Strategy::Midpoint { field }
            | Strategy::SkewPairing { field, .. }
            | Strategy::CrossProduct { field, .. } => with_time(field),
            Strategy::MinimalNorm { .. } => Vec::new(),
        };
    };
    let (values, multipliers) = field(dag, region, point);
    let mut extended = point.clone();
    extended.extend(lambda.iter().cloned().zip(multipliers));
    extended.extend(field_names.iter().cloned().zip(values));
    let append = |matrix: &[Vec<Id>], vector: &[Id]| -> Matrix {
        let mut matrix = rows(dag, matrix, &extended);
        let vector = evaluate(dag, vector, &extended);
        matrix
            .iter_mut()
            .zip(vector)
            .for_each(|(row, entry)| row.push(entry));
        matrix
    };
    let b = append(transposed_jacobian, transposed_time_derivative);
    let c = append(constraint_jacobian, constraint_time_derivative);
    let mean = with_time(mean);
    let multiplier = rows(dag, &region.discrete_multiplier, point);
    let states = mean.len();
    let mut result = mean.clone();
    for j in 0..=states {
        let inner: Vec<f64> = (0..states).map(|i| mean[i][j] - b[i][j]).collect();
        // P v − Λ⁺c = v − Λᵀ(ΛΛᵀ)⁻¹(Λv + c)
        let right = multiplier
            .iter()
            .zip(column(&c, j))
            .map(|(row, c)| dot(row, &inner) + c);
        let correction = transposed(
            &multiplier,
            &gram_solve(&multiplier, right.collect()),
            states,
        );
        for i in 0..states {
            result[i][j] = inner[i] - correction[i];
        }
    }
    result
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let size = 1.0 + found.abs().max(expected.abs());
    assert!(
        (found - expected).abs() <= tolerance * size,
        "{what}: {found} instead of {expected}"
    );
}

/// Every declaration, with its regions, at random points.
fn everywhere(mut check: impl FnMut(&Scheme, usize, &Point)) {
    let mut random = Random(20_170_101);
    for source in [
        systems::HARMONIC,
        systems::ELLIPTIC,
        systems::PENDULUM,
        systems::LOTKA_VOLTERRA,
        systems::DAMPED,
        systems::RIGID_BODY,
        systems::KEPLER,
    ] {
        let scheme = scheme(source);
        for region in 0..scheme.regions.len() {
            for _ in 0..POINTS {
                check(&scheme, region, &random_point(&scheme, &mut random));
            }
        }
    }
}

#[test]
fn multipliers_telescope() {
    everywhere(|scheme, region, point| {
        let mut dag = scheme.dag().clone();
        let mut names = states(scheme);
        names.push(Model::time());
        let steps: Vec<f64> = names
            .iter()
            .map(|name| point[&name.at_end()] - point[&name.at_start()])
            .collect();
        let derived = &scheme.regions[region];
        let multiplier = rows(&dag, &derived.discrete_multiplier, point);
        let by_time = evaluate(&dag, &derived.discrete_time_derivative, point);
        for (index, conserved) in scheme.model.regions[region].conserved.iter().enumerate() {
            let ends = [
                at_end(&mut dag, conserved.psi, &names),
                at_start(&mut dag, conserved.psi, &names),
            ];
            let psi = evaluate(&dag, &ends, point);
            let mut row = multiplier[index].clone();
            row.push(by_time[index]);
            assert_close(dot(&row, &steps), psi[0] - psi[1], ROUNDING, "Λ^τ Δx");
        }
    });
}

#[test]
fn fields_conserve() {
    everywhere(|scheme, region, point| {
        let dag = scheme.dag();
        let derived = &scheme.regions[region];
        let multiplier = rows(dag, &derived.discrete_multiplier, point);
        let by_time = evaluate(dag, &derived.discrete_time_derivative, point);
        let (field, _) = field(dag, derived, point);
        for (row, by_time) in multiplier.iter().zip(by_time) {
            assert_close(dot(row, &field), -by_time, ROUNDING, "Λ^τ f^τ");
        }
    });
}

#[test]
fn fields_are_consistent() {
    everywhere(|scheme, region, point| {
        let mut point = point.clone();
        for name in states(scheme).iter().chain([&Model::time()]) {
            let value = point[&name.at_start()];
            point.insert(name.at_end(), value);
            point.insert(name.clone(), value);
        }
        let dag = scheme.dag();
        let (found, _) = field(dag, &scheme.regions[region], &point);
        let expected = evaluate(dag, &scheme.model.regions[region].field, &point);
        for (found, expected) in found.into_iter().zip(expected) {
            assert_close(found, expected, ROUNDING, "f^τ(x, x)");
        }
    });
}

#[test]
fn jacobians_are_derivatives() {
    const H: f64 = 1e-5;
    everywhere(|scheme, region, point| {
        let dag = scheme.dag();
        let derived = &scheme.regions[region];
        let found = derivatives(dag, derived, point);
        let names = states(scheme);
        for (j, name) in names.iter().chain([&Model::time()]).enumerate() {
            let at = |shift: f64| {
                let mut point = point.clone();
                *point.entry(name.at_end()).or_default() += shift;
                field(dag, derived, &point).0
            };
            let (above, below) = (at(H), at(-H));
            for i in 0..names.len() {
                let expected = (above[i] - below[i]) / (2.0 * H);
                assert_close(found[i][j], expected, DIFFERENCE, "∂f^τ");
            }
        }
    });
}
