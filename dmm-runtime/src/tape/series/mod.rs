//! The Taylor coefficients of a solution, and of switching functions along it: the recurrences of
//! a program, one order at a time.

mod order;
mod steps;
mod translation;

use dmm_compiler::algebra::Id;
use dmm_compiler::program::series::{Recurrence, SeriesResult};
use dmm_compiler::program::{Functions, Series, Variable};

use self::order::AtOrder;
use self::steps::{Outcome, Step};
use self::translation::Translation;
use super::code::inputs;
use super::operation::{Register, register};
use crate::arithmetic::Scalar;
use crate::series::Order;

/// The recurrences of some roots.
#[derive(Debug)]
pub(super) struct SeriesCode {
    inputs: Vec<(Register, Variable)>,
    /// How many arrays there are.
    slots: usize,
    /// How many of them are those of the states or of the roots.
    first: usize,
    steps: Vec<Step>,
    results: Vec<Outcome>,
}

/// The nodes of a series whose values are constant in time.
pub(super) fn fixed(functions: &Functions, series: &Series) -> Vec<Id> {
    let lowered = &functions.lowered;
    let nodes = series.operations.iter().chain(&series.roots).copied();
    nodes.filter(|&id| lowered.is_fixed(id)).collect()
}

impl SeriesCode {
    /// That of `series`, of which `first` arrays are those of the states or of the roots.
    pub(super) fn new(functions: &Functions, series: &Series, first: usize) -> Self {
        let translation = Translation {
            lowered: &functions.lowered,
        };
        let mut steps = Vec::new();
        for coefficient in &series.coefficients {
            let node = coefficient.node;
            let is_input = series.inputs.iter().any(|input| input.node == node);
            if !is_input {
                steps.extend(translation.step(node, &coefficient.recurrence));
                if let Recurrence::Pair { own, .. } = coefficient.recurrence {
                    steps.push(Step::Computed(register(node), own));
                }
            }
            if let Some(slot) = coefficient.kept {
                steps.push(Step::Keep(slot, register(node)));
            }
        }
        let results = series.results.iter().map(|result| match result {
            SeriesResult::Value(root) => Outcome::Value(translation.value(*root)),
            SeriesResult::Solution { value, later } => Outcome::Solution {
                value: translation.multiple(value),
                later: later.as_ref().map(|later| {
                    let factor = later.factor.map(Translation::multiplier);
                    (factor, translation.multiple(&later.value))
                }),
            },
        });
        Self {
            inputs: inputs(&series.inputs),
            slots: series.slots,
            first,
            steps,
            results: results.collect(),
        }
    }

    /// How many arrays there are, of which the first are `components`.
    pub(super) fn slots(&self, components: usize) -> usize {
        components + self.slots - self.first
    }

    /// How many roots there are.
    pub(super) fn roots(&self) -> usize {
        self.results.len()
    }

    /// Coefficients of order k + 1 of the solution, and those of order k of what it is made from.
    pub(super) fn solution<S: Scalar, K: Order, const N: usize, const P: usize>(
        &self,
        k: K,
        t: S,
        registers: &mut [S],
        series: &mut [[S; P]],
    ) {
        let mut order = AtOrder {
            k,
            t,
            registers,
            series,
            states: None,
            shift: N - self.first,
        };
        order.run(self);
    }

    /// Coefficients of order k of the roots along a solution.
    pub(super) fn along<S: Scalar, K: Order, const P: usize>(
        &self,
        k: K,
        t: S,
        registers: &mut [S],
        states: &[[S; P]],
        series: &mut [[S; P]],
    ) {
        let mut order = AtOrder {
            k,
            t,
            registers,
            series,
            states: Some(states),
            shift: 0,
        };
        order.run(self);
    }
}
