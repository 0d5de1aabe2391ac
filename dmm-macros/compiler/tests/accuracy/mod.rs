//! Rounding errors of emitted code before and after optimisation.
//!
//! Every function of a region's flow is evaluated in double precision by the operations as they
//! are written and by the optimised ones, at random points with steps v τ, τ from 1 to 10⁻¹²,
//! and both are compared with the derived expressions, before they are lowered, in 120 digits.
//! Shared by the test and by the example that prints the table.

#[allow(dead_code, reason = "the campaign uses the rest")]
mod arithmetic;

use std::collections::BTreeMap;

use arithmetic::{Big, big, doubles, exact};
use dmm_compiler::algebra::{Dag, Id, Name, evaluate_bounded};
use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::model::Model;
use dmm_compiler::program::{Function, Functions, Program, Quantity};
use dmm_compiler::scheme::{RegionScheme, Scheme, Strategy};
use dmm_compiler::{derive, syntax};
use proc_macro2::TokenStream;

/// Step sizes 10⁻ᵏ.
const DECADES: std::ops::RangeInclusive<i32> = 0..=12;

/// The errors of one function.
pub(crate) struct Row {
    /// System, region and function.
    pub(crate) function: [String; 3],
    /// As they are written.
    pub(crate) written: Errors,
    /// Optimised.
    pub(crate) optimised: Errors,
}

/// The errors of every result that takes an operation, at every point.
#[derive(Default)]
pub(crate) struct Errors {
    /// In ulp of the exact value.
    pub(crate) ulps: Vec<f64>,
    /// As parts of the a-priori bound of the operations as they are written: ε times each
    /// operation's value, carried to the result by the derivatives. A value that cancels has
    /// many ulps and a bound that allows for them.
    parts: Vec<f64>,
}

impl Errors {
    fn push(&mut self, value: f64, expected: &Big, bound: f64) {
        let size = expected.to_f64().value().abs();
        let error = big(value).map_or(f64::INFINITY, |value| {
            (value - expected).to_f64().value().abs()
        });
        let ulp = (size.next_up() - size).max(f64::MIN_POSITIVE);
        self.ulps.push(error / ulp);
        // half an ulp is the error of a result that is only rounded
        self.parts.push(error / bound.max(0.5 * ulp));
    }

    /// The number of values.
    pub(crate) fn count(&self) -> usize {
        self.ulps.len()
    }

    /// The mean and the greatest error as parts of the bound.
    pub(crate) fn parts(&self) -> (f64, f64) {
        let mean = self.parts.iter().sum::<f64>() / self.parts.len().max(1) as f64;
        (mean, greatest(&self.parts))
    }
}

/// The greatest of errors.
pub(crate) fn greatest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The scheme of a declaration.
pub(crate) fn scheme(declaration: TokenStream) -> Result<Scheme, String> {
    let mut diagnostics = Diagnostics::new();
    syntax::parse(declaration, &mut diagnostics)
        .and_then(|declaration| derive(declaration, &mut diagnostics))
        .ok_or_else(|| diagnostics.messages().join("\n"))
}

/// Measures every function of `scheme` at `points` points a step size.
pub(crate) fn measure(scheme: &Scheme, points: usize) -> Vec<Row> {
    let (written, optimised) = (Program::as_written(scheme), Program::new(scheme));
    let mut rows = Vec::new();
    for (index, region) in scheme.regions.iter().enumerate() {
        let written = &written.dynamics[index].functions;
        let optimised = &optimised.dynamics[index].functions;
        for (function, cheaper) in written.all.iter().zip(&optimised.all) {
            let Some(derived) = derived(scheme, index, region, function.quantity) else {
                continue;
            };
            let mut row = Row {
                function: [
                    scheme.model.name.to_string(),
                    scheme.model.regions[index].ident.to_string(),
                    format!("{:?}", function.quantity),
                ],
                written: Errors::default(),
                optimised: Errors::default(),
            };
            let mut random = Random(20_170_101);
            for decade in DECADES {
                for _ in 0..points {
                    let point = random.point(scheme, region, 10f64.powi(-decade));
                    let functions = [(written, function), (optimised, cheaper)];
                    row.sample(scheme.dag(), &derived, functions, &point);
                }
            }
            rows.push(row);
        }
    }
    rows
}

impl Row {
    /// Adds the errors at a point, if all results have values there.
    fn sample(
        &mut self,
        dag: &Dag,
        derived: &[Id],
        functions: [(&Functions, &Function); 2],
        point: &BTreeMap<Name, f64>,
    ) {
        let Some(expected) = exact(dag, derived, point) else {
            return;
        };
        let [written, optimised] = functions.map(|(functions, function)| {
            let (dag, roots) = (functions.lowered.dag(), function.results.roots());
            (dag, roots)
        });
        let bounds = evaluate_bounded(written.0, &written.1, point);
        let before = doubles(written.0, &written.1, point);
        let after = doubles(optimised.0, &optimised.1, point);
        for (entry, expected) in expected.iter().enumerate() {
            let takes_operations = |(dag, roots): &(&Dag, Vec<Id>)| dag.tree_size(roots[entry]) > 1;
            if takes_operations(&written) || takes_operations(&optimised) {
                let bound = bounds[entry].1;
                self.written.push(before[entry], expected, bound);
                self.optimised.push(after[entry], expected, bound);
            }
        }
    }
}

/// The results of a function as they were derived, in its order; nothing for those that are made
/// while lowering.
fn derived(
    scheme: &Scheme,
    index: usize,
    region: &RegionScheme,
    quantity: Quantity,
) -> Option<Vec<Id>> {
    let declared = &scheme.model.regions[index];
    let psi: Vec<Id> = declared.conserved.iter().map(|one| one.psi).collect();
    match quantity {
        Quantity::VectorField => return Some(declared.field.clone()),
        Quantity::Conserved => return Some(psi),
        Quantity::Multiplier => return Some(row_by_row(&psi, &region.proved.multiplier)),
        Quantity::Jacobian => return Some(region.jacobian.concat()),
        Quantity::ConservedSize => return None,
        _ => {}
    }
    match &region.strategy {
        Strategy::Midpoint { field }
        | Strategy::SkewPairing { field, .. }
        | Strategy::CrossProduct { field, .. } => Some(match quantity {
            Quantity::DiscreteVectorField => field.value.clone(),
            Quantity::Linearised => row_by_row(&field.value, &field.jacobian),
            _ => field.time_derivative.clone(),
        }),
        Strategy::MinimalNorm {
            mean,
            transposed_jacobian,
            transposed_time_derivative,
            constraint_jacobian,
            constraint_time_derivative,
            ..
        } => {
            let mut results = row_by_row(&mean.value, &region.discrete_multiplier);
            results.extend(&region.discrete_time_derivative);
            if quantity == Quantity::Linearised {
                for matrix in [&mean.jacobian, transposed_jacobian, constraint_jacobian] {
                    results.extend(matrix.concat());
                }
            } else if quantity == Quantity::TimeDerivative {
                results.extend(&mean.time_derivative);
                results.extend(transposed_time_derivative);
                results.extend(constraint_time_derivative);
            }
            Some(results)
        }
    }
}

/// The entries of a column and a matrix, row by row.
fn row_by_row(column: &[Id], rows: &[Vec<Id>]) -> Vec<Id> {
    let mut entries = Vec::new();
    let longest = column.len().max(rows.len());
    for index in 0..longest {
        entries.extend(column.get(index));
        entries.extend(rows.get(index).into_iter().flatten());
    }
    entries
}

/// A reproducible stream of numbers (Steele, Lea & Flood 2014: SplitMix).
struct Random(u64);

impl Random {
    /// Uniform in (low, high).
    fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        low + (high - low) * ((z >> 11) as f64 * 2f64.powi(-53))
    }

    /// Values of every variable: states and time at both ends of a step v τ, parameters, and
    /// the λ and w of a minimal-norm field. States and parameters are positive, because some
    /// systems need them so.
    fn point(&mut self, scheme: &Scheme, region: &RegionScheme, tau: f64) -> BTreeMap<Name, f64> {
        let mut point = BTreeMap::new();
        let time = [(Model::time(), 1.0)];
        let states = scheme.model.state_names();
        let states: Vec<(Name, f64)> = states
            .into_iter()
            .map(|name| (name, self.uniform(-1.0, 1.0)))
            .collect();
        for (name, velocity) in states.into_iter().chain(time) {
            let start = self.uniform(0.1, 0.9);
            point.insert(name.at_end(), start + tau * velocity);
            point.insert(name.at_start(), start);
            point.insert(name, start);
        }
        for parameter in &scheme.model.parameters {
            point.insert(parameter.name.clone(), self.uniform(0.5, 1.5));
        }
        if let Strategy::MinimalNorm { lambda, field, .. } = &region.strategy {
            for name in lambda.iter().chain(field) {
                point.insert(name.clone(), self.uniform(-1.0, 1.0));
            }
        }
        point
    }
}
