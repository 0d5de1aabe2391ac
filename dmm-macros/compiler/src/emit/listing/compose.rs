//! Equations put together: rows of the same form as one, parts of long ones with a name.

use std::collections::{BTreeSet, HashMap};

use super::document::{Document, Part, Phrase, Piece, Row, Section};
use super::text;
use crate::algebra::display::patterns::{Patterns, runs};
use crate::algebra::display::shared::Shared;
use crate::algebra::display::size::Widths;
use crate::algebra::display::text::Letters;
use crate::algebra::display::{FormulaId, Formulas, Position, Symbol};
use crate::algebra::{Dag, Id, Name};
use crate::model::Model;
use crate::scheme::Scheme;

/// A section has no more rows than this.
const MOST_ROWS: usize = 40;

/// Composes the sections of one document.
pub(super) struct Composer {
    document: Document,
    patterns: Patterns,
    shared: Shared,
    /// The width of a line.
    width: usize,
}

/// An equation before it is composed with others.
pub(super) type Entry = (Vec<Part>, FormulaId);

impl Composer {
    pub(super) fn new(scheme: &Scheme, source: &str, width: usize) -> Self {
        Self {
            document: Document {
                source: source.into(),
                formulas: Formulas::collected(HashMap::new()),
                letters: letters(&scheme.model),
                sections: Vec::new(),
            },
            patterns: Patterns::default(),
            shared: Shared::default(),
            width,
        }
    }

    /// Starts a part whose formulas share nothing with those before it.
    pub(super) fn start_part(&mut self, written_as: HashMap<Name, Symbol>) {
        self.document.formulas.write_as(written_as);
        self.shared = Shared::default();
    }

    pub(super) fn formulas(&mut self) -> &mut Formulas {
        &mut self.document.formulas
    }

    /// The step size.
    pub(super) fn step_size(&mut self) -> FormulaId {
        let step = Symbol::plain(&self.document.letters.step);
        self.formulas().symbol(step)
    }

    /// An expression, its sums of terms of the same form written as one.
    pub(super) fn formula(&mut self, dag: &Dag, root: Id) -> FormulaId {
        let formula = self.document.formulas.build(dag, root);
        self.patterns
            .collapsed(&mut self.document.formulas, formula)
    }

    /// Whether a formula fits into another one on a line.
    pub(super) fn is_short(&self, formula: FormulaId) -> bool {
        let width = Widths::default().of(&self.document.formulas, formula);
        2 * width <= self.width
    }

    /// Adds `section` with the rows that `entries` make.
    pub(super) fn add(&mut self, mut section: Section, entries: Vec<Entry>) {
        let mut rows = self.together(entries);
        let more = rows.len().saturating_sub(MOST_ROWS);
        if more > 1 {
            rows.truncate(MOST_ROWS);
        }
        let letters = &self.document.letters;
        let left = rows.iter().map(|row| text::width_of_left(row, letters));
        let width = self.width.saturating_sub(left.max().unwrap_or(0) + 7);
        let mut roots: Vec<FormulaId> = rows.iter().map(|row| row.right).collect();
        let formulas = &mut self.document.formulas;
        let definitions = self.shared.name(formulas, &mut roots, width);
        for (row, root) in rows.iter_mut().zip(roots) {
            row.right = root;
        }
        section.rows = rows;
        section.shared = definitions
            .into_iter()
            .map(|definition| Row {
                left: vec![Part::Shared(definition.number, definition.in_row)],
                right: definition.formula,
                range: None,
            })
            .collect();
        if more > 1 {
            section.notes.insert(0, vec![left_out(more)]);
        }
        self.document.sections.push(section);
    }

    pub(super) fn finish(self) -> Document {
        self.document
    }

    /// Rows, those of the same form as one with a range.
    fn together(&mut self, entries: Vec<Entry>) -> Vec<Row> {
        type Form = (Vec<Part>, FormulaId);
        let mut forms: Vec<Vec<(usize, usize)>> = Vec::new();
        let mut form_of: HashMap<Form, usize> = HashMap::new();
        for (place, entry) in entries.iter().enumerate() {
            let Some(index) = first_index(&entry.0) else {
                continue;
            };
            let (left, right) = self.shifted(entry, index);
            let right = self.patterns.ordered(&mut self.document.formulas, right);
            let next = forms.len();
            let number = *form_of.entry((left, right)).or_insert(next);
            if number == next {
                forms.push(Vec::new());
            }
            forms[number].push((index, place));
        }
        let mut rows: Vec<Option<Row>> = entries
            .iter()
            .map(|(left, right)| {
                Some(Row {
                    left: left.clone(),
                    right: *right,
                    range: None,
                })
            })
            .collect();
        for form in &mut forms {
            form.sort_unstable();
            for run in runs(form) {
                let (Some(&(first, place)), Some(&(last, _))) = (run.first(), run.last()) else {
                    continue;
                };
                let (left, right) = self.shifted(&entries[place], first);
                for &(_, gone) in run {
                    rows[gone] = None;
                }
                rows[place] = Some(Row {
                    left,
                    right,
                    range: Some((first, last)),
                });
            }
        }
        rows.into_iter().flatten().collect()
    }

    /// An equation with its indices measured from `index`.
    fn shifted(&mut self, (left, right): &Entry, index: usize) -> Entry {
        let left = left
            .iter()
            .map(|part| match part {
                Part::Symbol(symbol) => Part::Symbol(symbol.shifted(index, Position::InRow)),
                other => other.clone(),
            })
            .collect();
        let formulas = &mut self.document.formulas;
        let right = self
            .patterns
            .shifted(formulas, *right, index, Position::InRow);
        (left, right)
    }
}

fn left_out(more: usize) -> Piece {
    format!("… and {more} more rows like these").into()
}

/// The index of the first element on a left-hand side.
fn first_index(left: &[Part]) -> Option<usize> {
    left.iter().find_map(|part| match part {
        Part::Symbol(symbol) => match symbol.position {
            Some(Position::At(index)) => Some(index),
            _ => None,
        },
        _ => None,
    })
}

/// Letters that the declaration has no other use for.
fn letters(model: &Model) -> Letters {
    let mut taken: BTreeSet<String> = model
        .variables()
        .map(|name| Symbol::from(name).base.to_string())
        .collect();
    taken.insert("t".into());
    let mut free = |candidates: &[&str]| {
        let found = candidates.iter().map(|&letter| letter.to_owned());
        let doubled = (2..).map(|times| candidates[0].repeat(times));
        let letter = found.chain(doubled).find(|letter| !taken.contains(letter));
        let letter = letter.unwrap_or_default();
        taken.insert(letter.clone());
        letter
    };
    Letters {
        step: free(&["τ", "Δt", "δ"]),
        shared: free(&["u", "w", "s", "a", "b", "c", "d"]),
        row: free(&["i", "j", "k", "l", "m", "n"]),
        term: free(&["j", "k", "l", "m", "n", "r"]),
    }
}

/// A phrase of words alone.
pub(super) fn words(words: impl Into<String>) -> Phrase {
    match words.into() {
        words if words.is_empty() => Vec::new(),
        words => vec![words.into()],
    }
}

/// A phrase of words, then signs.
pub(super) fn words_and_signs(words: &str, signs: &'static str) -> Phrase {
    vec![words.into(), Piece::Signs(signs)]
}
