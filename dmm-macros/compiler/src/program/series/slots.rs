//! The arrays of coefficients that recurrences need.

use std::collections::{BTreeMap, BTreeSet};

use super::super::inputs::{Input, Variable};
use super::super::lower::Lowered;
use super::Sums;
use super::recurrence::Place;
use crate::algebra::{Equation, Function, Id, Math};

/// What a slot belongs to.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Slot {
    /// The node's own coefficients.
    Node(Id),
    /// h du/dh of the argument u of a function.
    Derivative(Id),
    /// h dw/dh of w = ∫ du/v.
    Slope(Id),
    /// v of w = ∫ v du or ∫ du/v: of a sine the cosine and the other way round. Of a power
    /// w = u^v those of ln u and of h d(v ln u)/dh.
    Partner(Function, Id),
    /// The reciprocal that a recurrence multiplies by, in the first place.
    Inverse(Id),
}

/// The slots of some roots.
pub(super) struct Slots {
    states: BTreeMap<Id, usize>,
    numbers: BTreeMap<Slot, usize>,
    /// How the sums of the recurrences are run.
    pub(super) sums: Sums,
}

impl Slots {
    /// The slots of the nodes `moving`; `first` are in use already.
    pub(super) fn new(lowered: &Lowered, inputs: &[Input], moving: &[Id], first: usize) -> Self {
        let states = inputs.iter().filter_map(|input| match input.variable {
            Variable::State(index) => Some((input.node, index)),
            _ => None,
        });
        let states: BTreeMap<Id, usize> = states.collect();
        let needed = moving.iter().map(|&id| needed(lowered, id));
        let needed: Vec<Vec<Slot>> = needed.filter(|slots| !slots.is_empty()).collect();
        let sums = Sums::of(needed.len());
        let mut slots: BTreeSet<Slot> = needed.into_iter().flatten().collect();
        let is_state = |slot: &Slot| matches!(slot, Slot::Node(id) if states.contains_key(id));
        slots.retain(|slot| !is_state(slot));
        Self {
            numbers: slots.into_iter().zip(first..).collect(),
            states,
            sums,
        }
    }

    /// How many there are beside those of the states.
    pub(super) fn count(&self) -> usize {
        self.numbers.len()
    }

    /// The number of a state.
    pub(super) fn state(&self, id: Id) -> Option<usize> {
        self.states.get(&id).copied()
    }

    /// The number of the slot of a node that is no state, if it has one.
    pub(super) fn number(&self, id: Id) -> Option<usize> {
        self.numbers.get(&Slot::Node(id)).copied()
    }

    /// Where the coefficients of a slot are.
    pub(super) fn place(&self, slot: Slot) -> Place {
        let state = match slot {
            Slot::Node(id) => self.state(id),
            _ => None,
        };
        match state {
            Some(state) => Place::State(state),
            None => Place::Slot(self.numbers[&slot]),
        }
    }
}

/// The slots that the recurrence of a node needs.
fn needed(lowered: &Lowered, id: Id) -> Vec<Slot> {
    use Slot::{Derivative, Inverse, Node, Partner, Slope};
    let is_moving = |id: Id| !lowered.is_fixed(id);
    match lowered.dag()[id] {
        Math::Mul([a, b]) if is_moving(a) && is_moving(b) => vec![Node(a), Node(b)],
        Math::Div([_, b]) if is_moving(b) => vec![Node(b), Node(id), Inverse(id)],
        Math::Pow([a, b]) if is_moving(a) && !is_moving(b) => {
            vec![Node(a), Node(id), Inverse(id), Derivative(id)]
        }
        // u^v = e^(v ln u)
        Math::Pow([a, b]) if is_moving(b) => {
            let mut slots = vec![Node(id), Inverse(id), Partner(Function::Exp, id)];
            if is_moving(a) {
                slots.extend([Node(a), Node(b), Slope(id), Partner(Function::Ln, id)]);
            }
            slots
        }
        Math::Call(function, a) => needed_by_call(id, function, a),
        _ => Vec::new(),
    }
}

/// The slots that the recurrence of a function of `a` needs.
fn needed_by_call(id: Id, function: Function, a: Id) -> Vec<Slot> {
    use Slot::{Derivative, Inverse, Node, Partner, Slope};
    match function.properties().equation {
        Equation::Root => vec![Node(id), Inverse(id)],
        Equation::Exponential => vec![Node(id), Derivative(a)],
        Equation::Logarithm => vec![Node(a), Slope(id), Inverse(id)],
        Equation::Pair {
            functions: [p, q], ..
        } => vec![Derivative(a), Partner(p, a), Partner(q, a)],
        Equation::Tangent { .. } => vec![Node(id), Derivative(a), Partner(function, a)],
        Equation::ArcTangent => vec![Node(a), Partner(function, a), Slope(id), Inverse(id)],
        Equation::ArcSine { .. } => vec![
            Node(a),
            Partner(function, a),
            Inverse(a),
            Slope(id),
            Inverse(id),
        ],
        Equation::Missing => Vec::new(),
    }
}
