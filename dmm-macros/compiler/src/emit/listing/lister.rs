//! What the sections of a region have in common: what they list, the document that they are
//! added to, and how symbols of states, columns and headings are written.

use std::collections::HashMap;

use super::compose::{Composer, Entry, words_and_signs};
use super::document::{Part, Section};
use crate::algebra::display::Symbol;
use crate::algebra::{Dag, Id, Name};
use crate::model::Region;
use crate::model::plain_text;
use crate::scheme::{RegionScheme, Scheme, Strategy};

/// Lists one region.
pub(super) struct Lister<'a> {
    pub(super) composer: &'a mut Composer,
    pub(super) scheme: &'a Scheme,
    pub(super) region: &'a Region,
    pub(super) derived: &'a RegionScheme,
}

impl<'a> Lister<'a> {
    /// A new part of the document, for one region of `scheme`.
    pub(super) fn start(composer: &'a mut Composer, scheme: &'a Scheme, region: usize) -> Self {
        let (declared, derived) = (&scheme.model.regions[region], &scheme.regions[region]);
        let mut written_as = HashMap::new();
        if let Strategy::MinimalNorm { lambda, field, .. } = &derived.strategy {
            for (name, conserved) in lambda.iter().zip(&declared.conserved) {
                let of = Name::new(&plain_text(&conserved.ident));
                written_as.insert(name.clone(), Symbol::component("λ", &of));
            }
            for (name, state) in field.iter().zip(&scheme.model.states) {
                written_as.insert(name.clone(), Symbol::component("f^τ", &state.name));
            }
        }
        composer.start_part(written_as);
        Self {
            composer,
            scheme,
            region: declared,
            derived,
        }
    }

    pub(super) fn dag(&self) -> &'a Dag {
        self.scheme.dag()
    }

    pub(super) fn states(&self) -> impl Iterator<Item = &'a Name> + use<'a> {
        self.scheme.model.states.iter().map(|state| &state.name)
    }

    /// A column with an entry a state.
    pub(super) fn column(&mut self, sign: &'static str, entries: &[Id]) -> Vec<Entry> {
        self.states()
            .zip(entries)
            .map(|(state, &entry)| {
                let left = vec![Part::Sign(sign), symbol(state), Part::Sign("]")];
                (left, self.composer.formula(self.scheme.dag(), entry))
            })
            .collect()
    }
}

/// A state on the left-hand side.
pub(super) fn symbol(name: &Name) -> Part {
    Part::Symbol(Symbol::from(name))
}

/// A section with a heading of words and signs.
pub(super) fn titled(heading: &str, signs: &'static str) -> Section {
    Section {
        heading: words_and_signs(heading, signs),
        ..Section::default()
    }
}
