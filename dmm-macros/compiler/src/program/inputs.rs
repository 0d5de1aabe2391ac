//! The inputs of a function: which node of its operations is which variable.

use std::collections::BTreeMap;

use super::lower::Lowered;
use crate::algebra::{Id, Math, Name};
use crate::model::Model;
use crate::scheme::Strategy;

/// A variable, by what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// A parameter, by its number.
    Parameter(usize),
    /// t
    Time,
    /// xᵢ
    State(usize),
    /// t₀
    StartTime,
    /// Entry i of x₀.
    StartState(usize),
    /// t₁
    EndTime,
    /// Entry i of x₁.
    EndState(usize),
    /// wᵢ, an entry of f^τ that was solved for.
    Field(usize),
    /// λᵢ, which was solved for together with f^τ.
    Multiplier(usize),
}

/// A node whose value is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Input {
    /// The node.
    pub node: Id,
    /// Where its value comes from.
    pub variable: Variable,
}

/// The names of some variables, in the order in which they are listed.
pub(super) type Table = Vec<(Name, Variable)>;

/// x and t.
pub(super) fn at_point(states: &[Name]) -> Table {
    let states = states.iter().enumerate();
    let states = states.map(|(index, state)| (state.clone(), Variable::State(index)));
    states.chain([(Model::time(), Variable::Time)]).collect()
}

/// x₀ and x₁, t₀ and t₁.
pub(super) fn over_step(states: &[Name]) -> Table {
    let time = Model::time();
    let states = states.iter().enumerate().flat_map(|(index, state)| {
        [
            (state.at_start(), Variable::StartState(index)),
            (state.at_end(), Variable::EndState(index)),
        ]
    });
    let times = [
        (time.at_start(), Variable::StartTime),
        (time.at_end(), Variable::EndTime),
    ];
    states.chain(times).collect()
}

/// w and λ, where f^τ is solved for.
pub(super) fn solved(strategy: &Strategy) -> Table {
    let Strategy::MinimalNorm { lambda, field, .. } = strategy else {
        return Table::new();
    };
    let numbered = |names: &[Name], variable: fn(usize) -> Variable| -> Table {
        let names = names.iter().cloned().enumerate();
        names.map(|(index, name)| (name, variable(index))).collect()
    };
    let field = numbered(field, Variable::Field);
    [field, numbered(lambda, Variable::Multiplier)].concat()
}

/// The parameters.
pub(super) fn parameters(names: &[Name]) -> Table {
    let names = names.iter().cloned().enumerate();
    names
        .map(|(index, name)| (name, Variable::Parameter(index)))
        .collect()
}

/// The variables of `table` that `roots` depend on, in its order.
pub(super) fn inputs(lowered: &Lowered, roots: &[Id], table: &[(Name, Variable)]) -> Vec<Input> {
    let dag = lowered.dag();
    let nodes: BTreeMap<&Name, Id> = dag
        .reachable(roots.iter().copied())
        .into_iter()
        .filter_map(|id| match &dag[id] {
            Math::Variable(name) => Some((name, id)),
            _ => None,
        })
        .collect();
    let known = table.iter().filter_map(|(name, variable)| {
        let node = *nodes.get(name)?;
        Some(Input {
            node,
            variable: *variable,
        })
    });
    known.collect()
}
