//! The functions of a program: what each computes, from what, in which order.

use std::collections::BTreeSet;

use super::inputs::{Input, Table, inputs};
use super::lower::Lowered;
use super::optimise::Count;
use super::results::Results;
use super::stored::Stored;
use crate::algebra::{Id, Name};

/// What a function computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// f(t, x)
    VectorField,
    /// ∂f/∂x at (t, x)
    Jacobian,
    /// ψ(t, x)
    Conserved,
    /// Σ|terms of ψ(t, x)|, which the rounding error of ψ is measured against.
    ConservedSize,
    /// ψ(t, x) and Λ = ∇ψ(t, x)
    Multiplier,
    /// f^τ(t₀, x₀, t₁, x₁)
    DiscreteVectorField,
    /// f^τ(t₀, x₀, t₁, x₁) and ∂f^τ/∂x₁
    Linearised,
    /// ∂f^τ/∂t₁, where f or ψ depends on the time.
    TimeDerivative,
    /// g(t, x) of an interface, or the function of a condition, by its number.
    SwitchingFunction(usize),
    /// A bound of the rounding error of g(t, x), in units of that of 1.
    SwitchingSize(usize),
    /// ∂ₜg(t, x) and ∇g(t, x)
    SwitchingGradient(usize),
    /// What has to hold for an event, by its number, and the values after it.
    Event(usize),
}

impl Quantity {
    /// Whether it is one over the two ends of a step, and not one at a point (t, x).
    pub fn is_over_step(self) -> bool {
        matches!(
            self,
            Self::DiscreteVectorField | Self::Linearised | Self::TimeDerivative
        )
    }

    /// Whether a·b + c is one operation with one rounding: in what is evaluated in every
    /// iteration of a step. There it takes 2 % (elliptic curve) to 15 % (Hénon–Heiles) off the
    /// time where the processor has the instruction.
    pub fn is_fused(self) -> bool {
        self.is_over_step()
    }
}

/// A function.
#[derive(Debug)]
pub struct Function {
    /// What it computes.
    pub quantity: Quantity,
    /// What is evaluated first: all, but for a derivative of a field that is solved for.
    pub first: Stage,
    /// What is evaluated after f^τ and λ have been solved for.
    pub second: Option<Stage>,
    /// What it gives.
    pub results: Results,
}

/// Operations that are evaluated one after the other.
#[derive(Debug)]
pub struct Stage {
    /// The variables that they depend on, beside what is [`Stored`].
    pub inputs: Vec<Input>,
    /// The operations in the order in which they are evaluated.
    pub operations: Vec<Id>,
}

impl Function {
    /// All operations in the order in which they are evaluated.
    pub fn operations(&self) -> Vec<Id> {
        let second = self.second.iter().flat_map(|stage| &stage.operations);
        self.first
            .operations
            .iter()
            .chain(second)
            .copied()
            .collect()
    }
}

/// Functions over the same operations and the same stored values.
#[derive(Debug)]
pub struct Functions {
    /// The operations.
    pub lowered: Lowered,
    /// What is computed before an integration.
    pub stored: Stored,
    /// The functions.
    pub all: Vec<Function>,
}

/// The names of the variables of functions at a point, over a step, and of what is solved for.
pub(super) struct Variables {
    pub(super) at_point: Table,
    pub(super) over_step: Table,
    pub(super) solved: Table,
}

impl Functions {
    /// The functions with the given results.
    pub(super) fn new(
        lowered: Lowered,
        results: Vec<(Quantity, Results)>,
        variables: &Variables,
        parameters: &[Name],
    ) -> Self {
        let roots: Vec<Id> = results.iter().flat_map(|(_, one)| one.roots()).collect();
        let stored = Stored::new(&lowered, &roots, parameters);
        let all = results
            .into_iter()
            .map(|(quantity, results)| {
                Function::new(&lowered, &stored, variables, quantity, results)
            })
            .collect();
        Self {
            lowered,
            stored,
            all,
        }
    }

    /// The function that computes `quantity`, if there is one.
    pub fn get(&self, quantity: Quantity) -> Option<&Function> {
        self.all
            .iter()
            .find(|function| function.quantity == quantity)
    }

    /// How many operations an evaluation of `function` takes.
    pub fn count(&self, function: &Function) -> Count {
        let (dag, roots) = (self.lowered.dag(), function.results.roots());
        Count::shared(dag, &roots, |id| self.lowered.is_fixed(id))
    }

    /// How many it would take if nothing were shared.
    pub fn count_as_tree(&self, function: &Function) -> Count {
        let (dag, roots) = (self.lowered.dag(), function.results.roots());
        Count::tree(dag, &roots, |id| self.lowered.is_fixed(id))
    }
}

impl Function {
    fn new(
        lowered: &Lowered,
        stored: &Stored,
        variables: &Variables,
        quantity: Quantity,
        results: Results,
    ) -> Self {
        let table = if quantity.is_over_step() {
            &variables.over_step
        } else {
            &variables.at_point
        };
        let roots = results.roots();
        let mut known: BTreeSet<Id> = stored.nodes().collect();
        let mut stage = |inputs: Vec<Input>, roots: &[Id]| {
            known.extend(inputs.iter().map(|input| input.node));
            let operations = lowered.order(roots, |id| known.contains(&id));
            known.extend(&operations);
            Stage { inputs, operations }
        };
        let given = inputs(lowered, &roots, table);
        let (first, second) = match &results {
            Results::Projected(projected) => {
                let first = stage(given, &projected.roots());
                let second = projected.derivative.as_ref().map(|derivative| {
                    let solved = inputs(lowered, &roots, &variables.solved);
                    stage(solved, &derivative.roots())
                });
                (first, second)
            }
            _ => (stage(given, &roots), None),
        };
        Self {
            quantity,
            first,
            second,
            results,
        }
    }
}
