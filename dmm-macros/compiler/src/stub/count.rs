//! How many elements a group has, as far as a declaration with errors tells.

use std::collections::BTreeMap;

use num_traits::{Pow, ToPrimitive, Zero};

use crate::algebra::Rational;
use crate::syntax::{Declaration, Expression, ExpressionKind, Item, Operator};

/// No group has more elements.
const MOST_ELEMENTS: usize = 1 << 16;
/// Numbers of elements need no larger exponents.
const LARGEST_EXPONENT: u32 = 64;

/// The constants of a declaration that can be evaluated.
pub(super) struct Constants(BTreeMap<String, Rational>);

impl Constants {
    /// The constants of `declaration`, each in terms of those above it.
    pub(super) fn of(declaration: &Declaration) -> Self {
        let mut constants = Self(BTreeMap::new());
        for item in &declaration.items {
            if let Item::Constant(constant) = item
                && let Some(value) = constants.value(&constant.formula)
            {
                constants.0.insert(constant.ident.to_string(), value);
            }
        }
        constants
    }

    /// The number of elements of a group declared with `length`, if it is one.
    pub(super) fn count(&self, length: &Expression) -> Option<usize> {
        let value = self.value(length).filter(Rational::is_integer)?;
        value
            .to_usize()
            .filter(|count| (1..=MOST_ELEMENTS).contains(count))
    }

    fn value(&self, formula: &Expression) -> Option<Rational> {
        match &formula.kind {
            ExpressionKind::Number { value, .. } => Some(value.clone()),
            ExpressionKind::Name(ident) => self.0.get(&ident.to_string()).cloned(),
            ExpressionKind::Negative(operand) => Some(-self.value(operand)?),
            ExpressionKind::Parenthesised(inner) => self.value(inner),
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } => operation(*operator, self.value(left)?, self.value(right)?),
            ExpressionKind::Call { .. }
            | ExpressionKind::Element { .. }
            | ExpressionKind::If { .. }
            | ExpressionKind::Sum { .. } => None,
        }
    }
}

fn operation(operator: Operator, left: Rational, right: Rational) -> Option<Rational> {
    match operator {
        Operator::Add => Some(left + right),
        Operator::Subtract => Some(left - right),
        Operator::Multiply => Some(left * right),
        Operator::Divide => (!right.is_zero()).then(|| left / right),
        Operator::Remainder => {
            // the remainder with the sign of the divisor
            (!right.is_zero()).then(|| &left - &right * (&left / &right).floor())
        }
        Operator::Power => {
            let exponent = (right.is_integer().then(|| right.to_u32()).flatten())
                .filter(|exponent| *exponent <= LARGEST_EXPONENT)?;
            let is_small = left.to_usize().is_some_and(|base| base <= MOST_ELEMENTS);
            is_small.then(|| Pow::pow(left, exponent))
        }
    }
}
