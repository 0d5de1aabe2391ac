//! The e-graph of operations, with what the rules' conditions ask of a class of equal
//! expressions.

use egg::{Analysis, DidMerge, EGraph, Id, Language};

use super::constants::Constants;
use super::operation::{Operation, Symbol};

/// Equal operations.
pub(super) type Graph = EGraph<Operation, Facts>;

/// The analysis: what is known of a class, from any of its expressions.
pub(super) struct Facts {
    /// The constants by number.
    pub(super) constants: Constants,
}

/// What is known of a class of equal expressions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Known {
    /// Its value, by number.
    pub(super) constant: Option<u32>,
    /// It depends on parameters and constants alone, and so is stored.
    pub(super) fixed: bool,
    /// It has no rounding error: a variable, a constant, a sign or a power of two times one.
    /// The difference of two of them is exact where they are close, and must stay one.
    pub(super) exact: bool,
    /// It is proved not to be negative wherever it has a value.
    pub(super) not_negative: bool,
}

impl Analysis<Operation> for Facts {
    type Data = Known;

    fn make(graph: &mut Graph, node: &Operation, _: Id) -> Known {
        match *node.children() {
            [] => graph.analysis.leaf(node.symbol),
            [a] => {
                let a = graph[a].data;
                graph.analysis.unary(node.symbol, &a)
            }
            [a, b, ..] => {
                let (known_a, known_b) = (graph[a].data, graph[b].data);
                let mut known = graph.analysis.binary(node.symbol, &known_a, &known_b);
                // a square
                known.not_negative |= a == b && node.symbol == Symbol::Mul;
                known
            }
        }
    }

    fn merge(&mut self, known: &mut Known, other: Known) -> DidMerge {
        let merged = Known {
            constant: known.constant.or(other.constant),
            fixed: known.fixed || other.fixed,
            exact: known.exact || other.exact,
            not_negative: known.not_negative || other.not_negative,
        };
        let did = DidMerge(merged != *known, merged != other);
        *known = merged;
        did
    }

    fn modify(graph: &mut Graph, id: Id) {
        if let Some(number) = graph[id].data.constant {
            let leaf = graph.add(Operation::new(Symbol::Constant(number), &[]));
            graph.union(id, leaf);
        }
    }
}

impl Facts {
    fn leaf(&self, symbol: Symbol) -> Known {
        let constant = match symbol {
            Symbol::Constant(number) => Some(number),
            _ => None,
        };
        Known {
            constant,
            fixed: !matches!(symbol, Symbol::Varying(_)),
            exact: true,
            not_negative: constant.is_some_and(|number| !self.constants.is_negative(number)),
        }
    }

    fn unary(&mut self, symbol: Symbol, a: &Known) -> Known {
        let constant = a
            .constant
            .and_then(|number| self.constants.fold(symbol, number, number));
        let exact = symbol == Symbol::Neg && a.exact;
        let not_negative = match symbol {
            Symbol::Call(function) => function.properties().is_not_negative,
            _ => false,
        };
        self.of(constant, a.fixed, exact, not_negative)
    }

    fn binary(&mut self, symbol: Symbol, a: &Known, b: &Known) -> Known {
        let constant = match (a.constant, b.constant) {
            (Some(a), Some(b)) => self.constants.fold(symbol, a, b),
            _ => None,
        };
        let scales = |factor: &Known| {
            factor
                .constant
                .is_some_and(|number| self.constants.is_power_of_two(number))
        };
        let exact = symbol == Symbol::Mul && (scales(a) && b.exact || scales(b) && a.exact);
        let not_negative = matches!(symbol, Symbol::Add | Symbol::Mul | Symbol::Div)
            && a.not_negative
            && b.not_negative;
        self.of(constant, a.fixed && b.fixed, exact, not_negative)
    }

    fn of(&self, constant: Option<u32>, fixed: bool, exact: bool, not_negative: bool) -> Known {
        Known {
            constant,
            fixed,
            exact: exact || fixed || constant.is_some(),
            not_negative: not_negative
                || constant.is_some_and(|number| !self.constants.is_negative(number)),
        }
    }
}
