//! The hash of formulas: that of a number is a matter of its numerator and denominator, and not
//! of Euclid's algorithm.

use std::hash::{Hash, Hasher};
use std::mem::discriminant;

use super::super::language::hash_number;
use super::formula::{Formula, Product};

impl Hash for Formula {
    fn hash<H: Hasher>(&self, state: &mut H) {
        discriminant(self).hash(state);
        match self {
            Self::Constant(value) => hash_number(value, state),
            Self::Pi => {}
            Self::Symbol(symbol) => symbol.hash(state),
            Self::Call(function, argument) => (function, argument).hash(state),
            Self::Pair(function, arguments) => (function, arguments).hash(state),
            Self::Power(base, exponent) => (base, exponent).hash(state),
            Self::Sum(terms) => terms.hash(state),
            Self::Product(product) => product.hash(state),
            Self::Total { term, first, last } => (term, first, last).hash(state),
            Self::Shared { number, in_row } => (number, in_row).hash(state),
        }
    }
}

impl Hash for Product {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.negative.hash(state);
        hash_number(&self.constant, state);
        self.above.hash(state);
        self.below.hash(state);
    }
}
