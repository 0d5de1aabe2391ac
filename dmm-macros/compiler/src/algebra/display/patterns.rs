//! Patterns: terms and rows that are the same up to a shift of the indices of groups.
//!
//! The terms `p[0]^2/2 + p[1]^2/2 + p[2]^2/2 + p[3]^2/2` of a sum are one term and a range,
//! `sum(j in 0..4, p[j]^2/2)`. Formulas are compared with their indices measured from one of
//! them and with the operands of sums and products in a fixed order, so that the order in
//! which they happen to be written plays no part.

use std::collections::HashMap;

use super::formula::{Formula, FormulaId, Formulas, Image};
use super::symbol::Position;

/// So many terms or rows of the same form are written as one.
pub const FEWEST: usize = 4;

/// What was found of formulas so far.
#[derive(Debug, Default)]
pub struct Patterns {
    least: HashMap<FormulaId, Option<usize>>,
    collapsed: Image,
    ordered: Image,
}

impl Patterns {
    /// The least index of a group's element in `root`.
    pub fn least_index(&mut self, formulas: &Formulas, root: FormulaId) -> Option<usize> {
        if let Some(&least) = self.least.get(&root) {
            return least;
        }
        for id in formulas.reachable(&[root]) {
            if self.least.contains_key(&id) {
                continue;
            }
            let mut least = match &formulas[id] {
                Formula::Symbol(symbol) => match symbol.position {
                    Some(Position::At(index)) => Some(index),
                    _ => None,
                },
                _ => None,
            };
            formulas.for_each_part(id, |part| {
                let part = self.least.get(&part).copied().flatten();
                least = [least, part].into_iter().flatten().min();
            });
            self.least.insert(id, least);
        }
        self.least.get(&root).copied().flatten()
    }

    /// `root` with its indices measured from `from`, as the row or the term with that index.
    pub fn shifted(
        &mut self,
        formulas: &mut Formulas,
        root: FormulaId,
        from: usize,
        position: fn(i64) -> Position,
    ) -> FormulaId {
        let mut image = Image::of(formulas);
        for id in formulas.reachable(&[root]) {
            let shifted = match &formulas[id] {
                Formula::Symbol(symbol) => {
                    let symbol = symbol.shifted(from, position);
                    formulas.symbol(symbol)
                }
                _ => formulas.with_parts(id, |part| image.get(part).unwrap_or(part)),
            };
            image.insert(id, shifted);
        }
        image.get(root).unwrap_or(root)
    }

    /// `root` with the operands of sums and products in a fixed order, for comparison.
    pub fn ordered(&mut self, formulas: &mut Formulas, root: FormulaId) -> FormulaId {
        if let Some(ordered) = self.ordered.get(root) {
            return ordered;
        }
        for id in formulas.reachable(&[root]) {
            if self.ordered.get(id).is_some() {
                continue;
            }
            let known = &self.ordered;
            let copy = formulas.with_parts(id, |part| known.get(part).unwrap_or(part));
            let sorted = match formulas[copy].clone() {
                Formula::Sum(mut terms) => {
                    terms.sort_unstable_by_key(|term| (term.formula, term.negative));
                    formulas.insert(Formula::Sum(terms))
                }
                Formula::Product(mut product) => {
                    product.above.sort_unstable();
                    product.below.sort_unstable();
                    formulas.insert(Formula::Product(product))
                }
                Formula::Pair(function, mut pair) if function.prime().is_some() => {
                    // the arguments of a divided difference may be exchanged
                    pair.sort_unstable();
                    formulas.insert(Formula::Pair(function, pair))
                }
                _ => copy,
            };
            self.ordered.insert(id, sorted);
        }
        self.ordered.get(root).unwrap_or(root)
    }

    /// `root` with runs of terms of the same form written as one sum over an index.
    pub fn collapsed(&mut self, formulas: &mut Formulas, root: FormulaId) -> FormulaId {
        if let Some(short) = self.collapsed.get(root) {
            return short;
        }
        for id in formulas.reachable(&[root]) {
            if self.collapsed.get(id).is_some() {
                continue;
            }
            let known = &self.collapsed;
            let copy = formulas.with_parts(id, |part| known.get(part).unwrap_or(part));
            let short = match &formulas[copy] {
                Formula::Sum(terms) if terms.len() >= FEWEST => {
                    let terms = terms
                        .iter()
                        .map(|one| (one.negative, one.formula))
                        .collect();
                    self.totals(formulas, terms)
                }
                _ => copy,
            };
            self.collapsed.insert(id, short);
        }
        self.collapsed.get(root).unwrap_or(root)
    }

    /// The sum of terms, with its runs at the place of their first terms.
    fn totals(&mut self, formulas: &mut Formulas, terms: Vec<(bool, FormulaId)>) -> FormulaId {
        let mut form_of: HashMap<(bool, FormulaId), usize> = HashMap::new();
        let mut forms: Vec<Vec<(usize, usize)>> = Vec::new();
        for (place, &(negative, term)) in terms.iter().enumerate() {
            let Some(index) = self.least_index(formulas, term) else {
                continue;
            };
            let form = self.shifted(formulas, term, index, Position::InSum);
            let form = self.ordered(formulas, form);
            let next = forms.len();
            let number = *form_of.entry((negative, form)).or_insert(next);
            if number == next {
                forms.push(Vec::new());
            }
            forms[number].push((index, place));
        }
        let mut written: Vec<Option<(bool, FormulaId)>> = terms.iter().copied().map(Some).collect();
        for form in &mut forms {
            form.sort_unstable();
            for run in runs(form) {
                let (Some(&(first, start)), Some(&(last, _))) = (run.first(), run.last()) else {
                    continue;
                };
                let place = run.iter().map(|&(_, place)| place).min().unwrap_or(start);
                let (negative, term) = terms[start];
                let term = self.shifted(formulas, term, first, Position::InSum);
                for &(_, gone) in run {
                    written[gone] = None;
                }
                let total = formulas.insert(Formula::Total { term, first, last });
                written[place] = Some((negative, total));
            }
        }
        formulas.sum(written.into_iter().flatten())
    }
}

/// The longest stretches of consecutive indices in `sorted`, those of [`FEWEST`] or more.
pub fn runs<T>(sorted: &[(usize, T)]) -> impl Iterator<Item = &[(usize, T)]> {
    sorted
        .chunk_by(|a, b| a.0.checked_add(1) == Some(b.0))
        .filter(|run| run.len() >= FEWEST)
}
