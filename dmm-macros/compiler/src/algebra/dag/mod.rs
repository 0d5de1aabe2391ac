//! The hash-consed expression DAG: equal expressions are the same [`Id`]. Every node is made
//! through its constructors; what a root is made of is found in [`traversal`].

mod constructors;
mod traversal;

use std::ops::Index;

use egg::Id;
use num_bigint::BigInt;
use num_traits::{One, ToPrimitive, Zero};
use rustc_hash::FxHashMap;

use super::language::{Math, Name, Rational};
use super::work::Work;

/// A hash-consed expression DAG. Children always have smaller identifiers than parents.
#[derive(Clone, Debug, Default)]
pub struct Dag {
    nodes: Vec<Math>,
    memo: FxHashMap<Math, Id>,
    /// What normal forms over this DAG may still take.
    pub(super) work: Work,
}

impl Index<Id> for Dag {
    type Output = Math;

    fn index(&self, id: Id) -> &Math {
        &self.nodes[usize::from(id)]
    }
}

impl Dag {
    /// A DAG without nodes.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of distinct nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Adds `node` as it stands, without simplification; an equal node is shared.
    pub fn insert(&mut self, node: Math) -> Id {
        if let Some(&id) = self.memo.get(&node) {
            return id;
        }
        let id = Id::from(self.nodes.len());
        self.nodes.push(node.clone());
        self.memo.insert(node, id);
        id
    }

    /// `node` if it is there.
    pub(crate) fn find(&self, node: &Math) -> Option<Id> {
        self.memo.get(node).copied()
    }

    /// Adds a commutative `node(a, b)`, sharing `node(b, a)` if that is there.
    fn insert_commutative(&mut self, node: fn([Id; 2]) -> Math, a: Id, b: Id) -> Id {
        if let Some(&id) = self.memo.get(&node([b, a])) {
            return id;
        }
        self.insert(node([a, b]))
    }

    /// The exact constant `value`.
    pub fn constant(&mut self, value: Rational) -> Id {
        self.insert(Math::Constant(value))
    }

    /// The integer `value`.
    pub fn integer(&mut self, value: i64) -> Id {
        self.constant(Rational::from_integer(BigInt::from(value)))
    }

    /// The fraction `numerator`/`denominator`; the denominator must not be zero.
    pub fn fraction(&mut self, numerator: i64, denominator: i64) -> Id {
        self.constant(Rational::new(numerator.into(), denominator.into()))
    }

    /// π
    pub fn pi(&mut self) -> Id {
        self.insert(Math::Pi)
    }

    /// The variable `name`.
    pub fn variable(&mut self, name: &Name) -> Id {
        self.insert(Math::Variable(name.clone()))
    }

    /// The value of `id` if it is an exact constant.
    pub fn as_constant(&self, id: Id) -> Option<&Rational> {
        match &self[id] {
            Math::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// The value of `id` if it is an integer that fits.
    pub fn as_integer(&self, id: Id) -> Option<i64> {
        let value = self.as_constant(id)?;
        value.is_integer().then(|| value.to_integer().to_i64())?
    }

    /// Whether `id` is the constant zero.
    pub fn is_zero(&self, id: Id) -> bool {
        self.as_constant(id).is_some_and(Zero::is_zero)
    }

    /// Whether `id` is the constant one.
    pub fn is_one(&self, id: Id) -> bool {
        self.as_constant(id).is_some_and(One::is_one)
    }
}
