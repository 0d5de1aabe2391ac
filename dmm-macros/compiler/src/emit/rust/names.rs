//! Identifiers of emitted code: every one is taken once a scope, is not a keyword, and is as
//! close to what it was asked to be as that allows.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;
use quote::format_ident;

/// The identifiers that are taken in a scope.
#[derive(Debug, Clone, Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    /// By stem or wish, the smallest number that may still be free: names are never given
    /// back, so that those below stay taken.
    next: BTreeMap<String, usize>,
}

impl Names {
    /// A scope in which `reserved` are taken.
    pub(super) fn reserving<'a>(reserved: impl IntoIterator<Item = &'a str>) -> Self {
        Self {
            taken: reserved.into_iter().map(str::to_owned).collect(),
            next: BTreeMap::new(),
        }
    }

    /// An identifier like `wish`.
    pub(super) fn take(&mut self, wish: &str) -> Ident {
        let wish = wish.trim_start_matches("r#");
        if self.is_free(wish) && is_identifier(wish) {
            return self.taken(wish.to_owned());
        }
        // `match_`, then `match_2`, …
        let stem = format!("{wish}_");
        if self.is_free(&stem) && is_identifier(&stem) {
            return self.taken(stem);
        }
        self.numbered_from(&stem, 2)
    }

    /// The identifiers `stem1`, `stem2`, …: the first that is free.
    pub(super) fn number(&mut self, stem: &str) -> Ident {
        self.numbered_from(stem, 1)
    }

    /// `stem` with the first number from `first` upwards that is free.
    fn numbered_from(&mut self, stem: &str, first: usize) -> Ident {
        let mut number = self.next.get(stem).copied().unwrap_or(first).max(first);
        let mut candidate = format!("{stem}{number}");
        while !self.is_free(&candidate) {
            number += 1;
            candidate = format!("{stem}{number}");
        }
        self.next.insert(stem.to_owned(), number + 1);
        self.taken(candidate)
    }

    fn is_free(&self, candidate: &str) -> bool {
        !self.taken.contains(candidate)
    }

    fn taken(&mut self, name: String) -> Ident {
        let ident = format_ident!("{name}");
        self.taken.insert(name);
        ident
    }
}

/// Whether `text` is an identifier and no keyword. An underscore alone is neither.
fn is_identifier(text: &str) -> bool {
    syn::parse_str::<Ident>(text).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_taken_name_or_a_keyword_is_changed() {
        let mut names = Names::reserving(["self", "t"]);
        let taken: Vec<String> = ["x", "x", "x", "match", "t", "self"]
            .iter()
            .map(|wish| names.take(wish).to_string())
            .collect();
        assert_eq!(taken, ["x", "x_", "x_2", "match_", "t_", "self_"]);
        assert_eq!(names.number("u"), "u1");
        assert_eq!(names.number("u"), "u2");
    }
}
