//! The e-graph of operations: [`Math`] as lowering leaves it, with what the rules' conditions
//! ask of a class of equal expressions.

use egg::{Analysis, DidMerge, EGraph, Id, Language};
use num_traits::{Signed, ToPrimitive, Zero};

use super::form::is_fixed_leaf;
use crate::algebra::{Function, Math, Rational};

/// Constants with larger numerators or denominators are not folded any further: to hash a
/// rational is Euclid's algorithm, whose time grows with the square of its length.
const MOST_BITS: u64 = 1 << 7;

/// Equal operations.
pub(super) type Graph = EGraph<Math, Facts>;

/// The analysis: what is known of a class, from any of its expressions.
pub(super) struct Facts;

/// What is known of a class of equal expressions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Known {
    /// Its value.
    pub(super) constant: Option<Rational>,
    /// It depends on parameters and constants alone, and so is computed once a flow.
    pub(super) fixed: bool,
    /// It has no rounding error: a variable, a constant, a sign or a power of two times one.
    /// The difference of two of them is exact where they are close, and must stay one.
    pub(super) exact: bool,
    /// It is proved not to be negative wherever it has a value.
    pub(super) not_negative: bool,
}

impl Analysis<Math> for Facts {
    type Data = Known;

    fn make(graph: &mut Graph, node: &Math, _: Id) -> Known {
        let constant = constant(graph, node);
        let of = |id: &Id| &graph[*id].data;
        let exact = match node {
            Math::Constant(_) | Math::Pi | Math::Variable(_) => true,
            Math::Neg(a) => of(a).exact,
            Math::Mul([a, b]) => {
                let power = of(a).constant.as_ref().is_some_and(is_power_of_two);
                power && of(b).exact
            }
            _ => false,
        };
        let fixed = match node {
            Math::Variable(name) => is_fixed_leaf(name),
            node => node.all(|child| of(&child).fixed),
        };
        let not_negative = match node {
            Math::Constant(value) => !value.is_negative(),
            Math::Mul([a, b]) => a == b || (of(a).not_negative && of(b).not_negative),
            Math::Add([a, b]) | Math::Div([a, b]) => of(a).not_negative && of(b).not_negative,
            Math::Call(function, _) => matches!(
                function,
                Function::Sqrt | Function::Exp | Function::Cosh | Function::Abs | Function::Sinhc
            ),
            _ => false,
        };
        Known {
            not_negative: not_negative
                || constant.as_ref().is_some_and(|value| !value.is_negative()),
            exact: exact || constant.is_some() || fixed,
            constant,
            fixed,
        }
    }

    fn merge(&mut self, known: &mut Known, other: Known) -> DidMerge {
        let merged = Known {
            constant: known.constant.clone().or_else(|| other.constant.clone()),
            fixed: known.fixed || other.fixed,
            exact: known.exact || other.exact,
            not_negative: known.not_negative || other.not_negative,
        };
        let did = DidMerge(merged != *known, merged != other);
        *known = merged;
        did
    }

    fn modify(graph: &mut Graph, id: Id) {
        if let Some(value) = graph[id].data.constant.clone() {
            let leaf = graph.add(Math::Constant(value));
            graph.union(id, leaf);
        }
    }
}

/// The exact value of a node that is made of constants; nothing where it is too long, or
/// there is none.
fn constant(graph: &Graph, node: &Math) -> Option<Rational> {
    let of = |id: &Id| graph[*id].data.constant.as_ref();
    let value = match node {
        Math::Constant(value) => return Some(value.clone()),
        Math::Add([a, b]) => of(a)? + of(b)?,
        Math::Sub([a, b]) => of(a)? - of(b)?,
        Math::Mul([a, b]) => of(a)? * of(b)?,
        Math::Neg(a) => -of(a)?,
        Math::Div([a, b]) => {
            let (a, b) = (of(a)?, of(b)?);
            (!b.is_zero()).then(|| a / b)?
        }
        _ => return None,
    };
    (value.numer().bits() < MOST_BITS && value.denom().bits() < MOST_BITS).then_some(value)
}

/// Whether a factor `value` is exact.
fn is_power_of_two(value: &Rational) -> bool {
    let is_power =
        |value: &num_bigint::BigInt| value.abs().to_u64().is_some_and(u64::is_power_of_two);
    is_power(value.numer()) && is_power(value.denom())
}
