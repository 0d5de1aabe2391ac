//! The functions of a program, operation by operation.

use std::collections::BTreeMap;

use dmm_compiler::algebra::Id;
use dmm_compiler::program::{Function, Functions, Input, Variable};
use dmm_compiler::scheme::Scheme;

use crate::arithmetic::operation;

/// The values of all variables.
#[derive(Clone)]
pub(crate) struct Point {
    pub(crate) parameters: Vec<f64>,
    pub(crate) time: f64,
    pub(crate) state: Vec<f64>,
    pub(crate) times: [f64; 2],
    pub(crate) start: Vec<f64>,
    pub(crate) end: Vec<f64>,
    pub(crate) field: Vec<f64>,
    pub(crate) multipliers: Vec<f64>,
}

/// Values by node.
pub(crate) type Values = BTreeMap<Id, f64>;

impl Point {
    /// A point at which all variables are different and of the order of 1.
    pub(crate) fn new(scheme: &Scheme) -> Self {
        let model = &scheme.model;
        let mut last = 0.5_f64;
        // the fractional parts of multiples of the golden ratio
        let mut next = |from: f64, to: f64| {
            last = (last + 0.618_033_988_749_894_9).fract();
            from + (to - from) * last
        };
        let mut some = |count: usize, from, to| (0..count).map(|_| next(from, to)).collect();
        let n = model.states.len();
        Self {
            parameters: some(model.parameters.len(), 0.5, 1.5),
            time: 0.3,
            state: some(n, 0.1, 0.9),
            times: [0.3, 0.4],
            start: some(n, 0.1, 0.9),
            end: some(n, 0.1, 0.9),
            field: some(n, -1.0, 1.0),
            multipliers: some(n, -1.0, 1.0),
        }
    }

    fn value(&self, variable: Variable) -> f64 {
        match variable {
            Variable::Parameter(index) => self.parameters[index],
            Variable::Time => self.time,
            Variable::State(index) => self.state[index],
            Variable::StartTime => self.times[0],
            Variable::StartState(index) => self.start[index],
            Variable::EndTime => self.times[1],
            Variable::EndState(index) => self.end[index],
            Variable::Field(index) => self.field[index],
            Variable::Multiplier(index) => self.multipliers[index],
        }
    }

    fn give(&self, inputs: &[Input], values: &mut Values) {
        values.extend(
            inputs
                .iter()
                .map(|one| (one.node, self.value(one.variable))),
        );
    }
}

/// Evaluates operations in their order.
fn run(functions: &Functions, operations: &[Id], values: &mut Values) {
    let dag = functions.lowered.dag();
    for &id in operations {
        let value = operation(dag, id, |child| values[&child]);
        values.insert(id, value);
    }
}

/// What is stored before an integration.
pub(crate) fn stored(functions: &Functions, point: &Point) -> Values {
    let (stored, mut values) = (&functions.stored, Values::new());
    point.give(&stored.inputs, &mut values);
    run(functions, &stored.operations, &mut values);
    stored.nodes().map(|node| (node, values[&node])).collect()
}

/// The results of a function.
pub(crate) fn evaluated(
    functions: &Functions,
    function: &Function,
    stored: &Values,
    point: &Point,
) -> Vec<f64> {
    let mut values = stored.clone();
    for stage in [Some(&function.first), function.second.as_ref()] {
        let Some(stage) = stage else { continue };
        point.give(&stage.inputs, &mut values);
        run(functions, &stage.operations, &mut values);
    }
    let roots = function.results.roots().into_iter();
    roots.map(|root| values[&root]).collect()
}
