//! What is stored before an integration: the parameters that functions use, and every expression
//! of parameters alone.

use std::collections::BTreeSet;

use egg::Language;

use super::inputs::{self, Input};
use super::lower::Lowered;
use crate::algebra::{Id, Math, Name};

/// The values that functions find computed already.
#[derive(Debug)]
pub struct Stored {
    /// The parameters that functions use as they are.
    pub parameters: Vec<Id>,
    /// The expressions of parameters that functions use.
    pub computed: Vec<Id>,
    /// The parameters that are used or that `computed` depends on.
    pub inputs: Vec<Input>,
    /// The operations of `computed`, in the order in which they are evaluated.
    pub operations: Vec<Id>,
}

impl Stored {
    /// What functions with the results `roots` need; `parameters` are all that the system has.
    pub(super) fn new(lowered: &Lowered, roots: &[Id], parameters: &[Name]) -> Self {
        let (leaves, compound) = fixed_frontier(lowered, roots);
        let is_variable = |id: &Id| matches!(lowered.dag()[*id], Math::Variable(_));
        let used: Vec<Id> = leaves.into_iter().filter(is_variable).collect();
        let computed: Vec<Id> = compound.into_iter().collect();
        let needed = [&used[..], &computed].concat();
        let mut inputs = inputs::inputs(lowered, &needed, &inputs::parameters(parameters));
        inputs.sort_by_key(|input| input.node);
        let is_input = |id: Id| inputs.iter().any(|input| input.node == id);
        Self {
            operations: lowered.order(&computed, is_input),
            parameters: used,
            computed,
            inputs,
        }
    }

    /// The nodes whose values are stored.
    pub fn nodes(&self) -> impl Iterator<Item = Id> {
        self.parameters.iter().chain(&self.computed).copied()
    }
}

/// The outermost nodes under `roots` that depend on parameters alone: variables, and
/// expressions worth computing beforehand.
fn fixed_frontier(lowered: &Lowered, roots: &[Id]) -> (BTreeSet<Id>, BTreeSet<Id>) {
    let (mut leaves, mut compound) = (BTreeSet::new(), BTreeSet::new());
    let mut seen = BTreeSet::new();
    let mut stack = roots.to_vec();
    while let Some(id) = stack.pop() {
        if !seen.insert(id) {
            continue;
        }
        if !lowered.is_fixed(id) || matches!(lowered.dag()[id], Math::Neg(_)) {
            lowered.dag()[id].for_each(|child| stack.push(child));
        } else if lowered.is_leaf(id) {
            leaves.insert(id);
        } else {
            compound.insert(id);
        }
    }
    (leaves, compound)
}
