//! The functions of the events: what has to hold, and the new values of all states and discrete
//! states.

use super::function::{Functions, Quantity, Variables};
use super::inputs::{Table, at_point};
use super::lower::Lowered;
use super::results::Results;
use crate::algebra::{Dag, Id, Name};
use crate::scheme::Scheme;

/// The program of the events of a system.
#[derive(Debug)]
pub struct Events {
    /// By event: its conditions, which are positive where it happens, then x, then the discrete
    /// states, in one column.
    pub functions: Functions,
    /// By event: how many conditions it has.
    pub conditions: Vec<usize>,
}

impl Events {
    /// The functions of `scheme`; `dag` has the nodes of the scheme.
    pub(super) fn new(scheme: &Scheme, dag: &mut Dag, parameters: &[Name]) -> Self {
        let model = &scheme.model;
        let states = model.state_names();
        let mut variables = |names: &mut dyn Iterator<Item = &Name>| -> Vec<Id> {
            names.map(|name| dag.variable(name)).collect()
        };
        let before = variables(&mut states.iter());
        let discrete = variables(&mut model.discrete.iter().map(|one| &one.name));
        let mut lowered = Lowered::new(parameters.to_vec());
        let mut lower = |id: Id| lowered.lower(dag, id);
        let mut results = Vec::new();
        for (number, event) in model.events.iter().enumerate() {
            let mut column: Vec<Id> = event.conditions.iter().map(|&one| lower(one)).collect();
            column.extend(after(&before, &event.states).map(&mut lower));
            column.extend(after(&discrete, &event.discrete).map(&mut lower));
            results.push((Quantity::Event(number), Results::Column(column)));
        }
        let variables = Variables {
            at_point: at_point(&states),
            over_step: Table::new(),
            solved: Table::new(),
        };
        Self {
            functions: Functions::new(lowered, results, &variables, parameters),
            conditions: (model.events.iter())
                .map(|event| event.conditions.len())
                .collect(),
        }
    }
}

/// The values after an event, where `given` is what changes.
fn after<'a>(before: &'a [Id], given: &'a [(usize, Id)]) -> impl Iterator<Item = Id> + 'a {
    let value = |(index, &before): (usize, &Id)| {
        let mut given = given.iter();
        let value = given.find(|(of, _)| *of == index);
        value.map_or(before, |&(_, value)| value)
    };
    before.iter().enumerate().map(value)
}
