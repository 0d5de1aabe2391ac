//! Cost: what an operation takes on a processor, and how operations are counted.
//!
//! A sum or product is the unit. A division has 4 times its latency (13 cycles to 3 on Zen 2
//! to 4, 13–15 to 4 on Intel since Skylake) and a square root 5 to 7 times (20; Fog,
//! *Instruction tables*); neither is pipelined as well. A call of an elementary function takes
//! 5 to 20 ns, some 20 units and more; it makes no difference how many as long as no rule
//! trades calls for anything. What depends on parameters alone is stored; a step reads it from
//! memory beside other operands, and so next to nothing is charged, enough to prefer the form
//! that stores less.

use std::collections::HashMap;
use std::ops::AddAssign;

use egg::{Id, Language};

use super::operation::Symbol;
use crate::algebra::{Dag, Function, Math};

/// The unit of [`weight`]: the cost of a sum or product.
pub(super) const UNIT: u32 = 16;

/// The cost of a value that is stored before an integration.
pub(super) const STORED: u32 = 1;

/// The cost of an operation, in parts of [`UNIT`].
pub(super) fn weight(symbol: Symbol) -> u32 {
    UNIT * match symbol {
        Symbol::Fixed(_) | Symbol::Varying(_) | Symbol::Constant(_) | Symbol::Pi => 0,
        Symbol::Add | Symbol::Sub | Symbol::Mul | Symbol::Neg => 1,
        Symbol::Call(Function::Abs) => 1,
        Symbol::Div => 4,
        Symbol::Call(Function::Sqrt) => 6,
        Symbol::Call(_) | Symbol::Pair(_) => 20,
        Symbol::Pow => 40,
    }
}

/// Operations of one evaluation. Operations on parameters alone are none, and a sign is one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Count {
    /// How many.
    pub operations: u64,
    /// The sum of their costs, a sum or product being 1.
    pub weighted: u64,
}

impl Count {
    fn of(node: &Math) -> Self {
        let cost = u64::from(Symbol::of(node).map_or(0, weight) / UNIT);
        Self {
            operations: u64::from(cost > 0),
            weighted: cost,
        }
    }

    /// The operations of `roots`, those that several have in common counted once.
    pub fn shared(dag: &Dag, roots: &[Id], is_fixed: impl Fn(Id) -> bool) -> Self {
        let mut count = Self::default();
        let mut seen = std::collections::BTreeSet::new();
        let mut stack = roots.to_vec();
        while let Some(id) = stack.pop() {
            if !is_stored(dag, id, &is_fixed) && seen.insert(id) {
                count += Self::of(&dag[id]);
                dag[id].for_each(|child| stack.push(child));
            }
        }
        count
    }

    /// The operations of `roots` written out as trees.
    pub fn tree(dag: &Dag, roots: &[Id], is_fixed: impl Fn(Id) -> bool) -> Self {
        let mut counts: HashMap<Id, Self> = HashMap::new();
        for id in dag.reachable(roots.iter().copied()) {
            let mut count = Self::default();
            if !is_stored(dag, id, &is_fixed) {
                count = Self::of(&dag[id]);
                dag[id].for_each(|child| count += counts[&child]);
            }
            counts.insert(id, count);
        }
        let mut total = Self::default();
        roots.iter().for_each(|root| total += counts[root]);
        total
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.operations = self.operations.saturating_add(other.operations);
        self.weighted = self.weighted.saturating_add(other.weighted);
    }
}

/// Whether a node is read, not computed; the sign of what is read is computed.
fn is_stored(dag: &Dag, id: Id, is_fixed: impl Fn(Id) -> bool) -> bool {
    is_fixed(id) && !matches!(dag[id], Math::Neg(_))
}
