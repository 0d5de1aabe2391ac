//! The exact numbers of an e-graph, each by a number of its own: what is compared and hashed at
//! every step is never a long fraction.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};

use super::operation::Symbol;
use crate::algebra::Rational;

/// Constants with larger numerators or denominators are not folded any further.
const MOST_BITS: u64 = 1 << 7;

/// Exact numbers with what the rules ask of them.
#[derive(Debug, Clone)]
pub(super) struct Constants {
    known: Vec<Constant>,
    numbers: HashMap<(BigInt, BigInt), u32>,
    /// The results of operations.
    folded: HashMap<(u8, u32, u32), Option<u32>>,
}

#[derive(Debug, Clone, PartialEq)]
struct Constant {
    value: Rational,
    is_negative: bool,
    is_power_of_two: bool,
}

/// The numbers in rules, which come first, as numerators and denominators.
const OF_RULES: [(i64, i64); 4] = [(1, 1), (2, 1), (1, 2), (1, 4)];

/// The number of 1.
pub(super) const ONE: u32 = 0;

impl PartialEq for Constants {
    fn eq(&self, other: &Self) -> bool {
        self.known == other.known
    }
}

impl Eq for Constants {}

impl Constants {
    /// The numbers in rules.
    pub(super) fn new() -> Self {
        let mut constants = Self {
            known: Vec::new(),
            numbers: HashMap::new(),
            folded: HashMap::new(),
        };
        for (numerator, denominator) in OF_RULES {
            constants.number(&Rational::new(numerator.into(), denominator.into()));
        }
        constants
    }

    /// The number of `value`.
    pub(super) fn number(&mut self, value: &Rational) -> u32 {
        let count = self.known.len() as u32;
        let key = (value.numer().clone(), value.denom().clone());
        let number = *self.numbers.entry(key).or_insert(count);
        if number == count {
            let is_power = |value: &BigInt| value.abs().to_u64().is_some_and(u64::is_power_of_two);
            self.known.push(Constant {
                is_negative: value.is_negative(),
                is_power_of_two: is_power(value.numer()) && is_power(value.denom()),
                value: value.clone(),
            });
        }
        number
    }

    /// The value of a number.
    pub(super) fn value(&self, number: u32) -> &Rational {
        &self.known[number as usize].value
    }

    /// Whether a factor is exact.
    pub(super) fn is_power_of_two(&self, number: u32) -> bool {
        self.known[number as usize].is_power_of_two
    }

    pub(super) fn is_negative(&self, number: u32) -> bool {
        self.known[number as usize].is_negative
    }

    /// The value of an operation on a and b (of one operand, on a); nothing where it is too
    /// long, or there is none.
    pub(super) fn fold(&mut self, symbol: Symbol, a: u32, b: u32) -> Option<u32> {
        let key = (symbol.kind(), a, b);
        if let Some(&known) = self.folded.get(&key) {
            return known;
        }
        let folded = self.apply(symbol, a, b).map(|value| self.number(&value));
        self.folded.insert(key, folded);
        folded
    }

    fn apply(&self, symbol: Symbol, a: u32, b: u32) -> Option<Rational> {
        let (a, b) = (self.value(a), self.value(b));
        let value = match symbol {
            Symbol::Add => a + b,
            Symbol::Sub => a - b,
            Symbol::Mul => a * b,
            Symbol::Neg => -a,
            Symbol::Div if !b.is_zero() => a / b,
            _ => return None,
        };
        (value.numer().bits() < MOST_BITS && value.denom().bits() < MOST_BITS).then_some(value)
    }
}
