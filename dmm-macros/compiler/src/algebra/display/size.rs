//! How wide a formula is when it is written.

use std::collections::HashMap;

use num_traits::One;

use super::formula::{Formula, FormulaId, Formulas};
use super::symbol::Symbol;

/// Widths of formulas as text, about; each is found once.
#[derive(Debug, Default)]
pub struct Widths(HashMap<FormulaId, usize>);

impl Widths {
    /// The width of `root`, `usize::MAX` if it is larger.
    pub fn of(&mut self, formulas: &Formulas, root: FormulaId) -> usize {
        if let Some(&width) = self.0.get(&root) {
            return width;
        }
        let mut stack = vec![root];
        while let Some(&id) = stack.last() {
            let before = stack.len();
            formulas.for_each_part(id, |part| {
                if !self.0.contains_key(&part) {
                    stack.push(part);
                }
            });
            if stack.len() == before {
                stack.pop();
                let width = self.of_parts(formulas, id);
                self.0.insert(id, width);
            }
        }
        self.0.get(&root).copied().unwrap_or(0)
    }

    fn of_parts(&self, formulas: &Formulas, id: FormulaId) -> usize {
        let mut parts = 0_usize;
        formulas.for_each_part(id, |part| {
            let width = self.0.get(&part).copied().unwrap_or(0);
            parts = parts.saturating_add(width);
        });
        let signs = match &formulas[id] {
            Formula::Constant(value) => value.to_string().chars().count(),
            Formula::Pi => 2,
            Formula::Shared { in_row, .. } => 2 + 3 * usize::from(*in_row),
            Formula::Symbol(symbol) => symbol_width(symbol),
            Formula::Call(function, _) => function.name().len() + 2,
            Formula::Pair(function, _) => function.name().len() + 4,
            Formula::Power(base, exponent) => {
                1 + bracket(formulas, *base) + bracket(formulas, *exponent)
            }
            Formula::Total { .. } => 15,
            Formula::Sum(terms) => 3 * terms.len().saturating_sub(1),
            Formula::Product(product) => {
                let factors = product.above.iter().chain(&product.below);
                let brackets: usize = factors.map(|&factor| 1 + bracket(formulas, factor)).sum();
                let constant = if product.constant.is_one() {
                    0
                } else {
                    product.constant.to_string().len() + 1
                };
                let bar = if product.below.is_empty() { 0 } else { 2 };
                brackets + constant + bar + usize::from(product.negative)
            }
        };
        parts.saturating_add(signs)
    }
}

fn symbol_width(symbol: &Symbol) -> usize {
    let count = |text: &str| text.chars().count();
    count(&symbol.base)
        + symbol
            .component
            .as_deref()
            .map_or(0, |name| count(name) + 2)
        + symbol.position.map_or(0, |_| 3)
        + usize::from(symbol.end.is_some())
}

/// The width of the parentheses that a factor needs.
fn bracket(formulas: &Formulas, id: FormulaId) -> usize {
    match formulas[id] {
        Formula::Sum(_) => 2,
        _ => 0,
    }
}
