//! Shared formulas: parts of long formulas that get a name, `u₁ = sqrt(x₁^2 + y₁^2)`.
//!
//! Only formulas that do not fit on a line are changed. In them a part is named if it occurs
//! more than once and the name saves room, or if it would not fit on a line of its own.

use std::collections::{HashMap, HashSet};

use super::formula::{Formula, FormulaId, Formulas};
use super::size::Widths;
use super::symbol::Position;

/// A part is named if this many characters are saved at least.
const LEAST_SAVING: usize = 20;
/// A part shorter than this is never named.
const SHORTEST: usize = 8;

/// The formulas that have a name, numbered from 1.
#[derive(Debug, Default)]
pub struct Shared {
    names: HashMap<FormulaId, FormulaId>,
    count: usize,
}

/// A named formula with its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Definition {
    /// The number.
    pub number: usize,
    /// Whether there is one for every row.
    pub in_row: bool,
    /// What it stands for.
    pub formula: FormulaId,
}

impl Shared {
    /// Names parts of those `roots` that are wider than `width`, and gives what was named.
    pub fn name(
        &mut self,
        formulas: &mut Formulas,
        roots: &mut [FormulaId],
        width: usize,
    ) -> Vec<Definition> {
        let mut widths = Widths::default();
        let long: Vec<FormulaId> = roots
            .iter()
            .copied()
            .filter(|&root| widths.of(formulas, root) > width)
            .collect();
        if long.is_empty() {
            return Vec::new();
        }
        let reached = formulas.reachable(&long);
        let uses = uses(formulas, &reached, &long);
        let standing_alone = standing_alone(formulas, &long);
        let mut image: HashMap<FormulaId, FormulaId> = HashMap::new();
        let mut in_sum: HashSet<FormulaId> = HashSet::new();
        let mut in_row: HashSet<FormulaId> = HashSet::new();
        let mut definitions = Vec::new();
        for id in reached {
            if has_index(formulas, id, &in_sum, |at| matches!(at, Position::InSum(_)))
                && !matches!(formulas[id], Formula::Total { .. })
            {
                in_sum.insert(id);
            }
            if has_index(formulas, id, &in_row, |at| matches!(at, Position::InRow(_))) {
                in_row.insert(id);
            }
            if let Some(&name) = self.names.get(&id) {
                image.insert(id, name);
                continue;
            }
            let copy = formulas.with_parts(id, |part| image.get(&part).copied().unwrap_or(part));
            let size = widths.of(formulas, copy);
            let count = uses.get(&id).copied().unwrap_or(0);
            let saving = count
                .saturating_sub(1)
                .saturating_mul(size.saturating_sub(2));
            let repeated = saving >= LEAST_SAVING && size >= SHORTEST;
            let too_wide = size > width && !standing_alone.contains(&id);
            let is_symbol = matches!(formulas[id], Formula::Symbol(_) | Formula::Constant(_));
            let can_have_name = !is_symbol && !in_sum.contains(&id);
            let image_of = if (repeated || too_wide) && can_have_name {
                self.count += 1;
                let (number, in_row) = (self.count, in_row.contains(&id));
                definitions.push(Definition {
                    number,
                    in_row,
                    formula: copy,
                });
                let name = formulas.insert(Formula::Shared { number, in_row });
                self.names.insert(id, name);
                name
            } else {
                copy
            };
            image.insert(id, image_of);
        }
        for root in roots {
            *root = image.get(root).copied().unwrap_or(*root);
        }
        definitions
    }
}

/// How often each formula is written in another one, and as a root.
fn uses(
    formulas: &Formulas,
    reached: &[FormulaId],
    roots: &[FormulaId],
) -> HashMap<FormulaId, usize> {
    let mut uses: HashMap<FormulaId, usize> = HashMap::new();
    for &id in reached {
        formulas.for_each_part(id, |part| *uses.entry(part).or_default() += 1);
    }
    for &root in roots {
        *uses.entry(root).or_default() += 1;
    }
    uses
}

/// The roots and their terms, which can have lines of their own.
fn standing_alone(formulas: &Formulas, roots: &[FormulaId]) -> HashSet<FormulaId> {
    let mut alone: HashSet<FormulaId> = roots.iter().copied().collect();
    for &root in roots {
        if let Formula::Sum(terms) = &formulas[root] {
            alone.extend(terms.iter().map(|term| term.formula));
        }
    }
    alone
}

/// Whether an index of some kind occurs in a formula, given the parts in which one does. What
/// has the index of a sum has no one value, and can have no name outside of it.
fn has_index(
    formulas: &Formulas,
    id: FormulaId,
    parts: &HashSet<FormulaId>,
    kind: fn(Position) -> bool,
) -> bool {
    if let Formula::Symbol(symbol) = &formulas[id] {
        return symbol.position.is_some_and(kind);
    }
    let mut found = false;
    formulas.for_each_part(id, |part| found |= parts.contains(&part));
    found
}
