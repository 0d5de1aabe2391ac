//! Identifiers of emitted code: every one is taken once a scope, is not a keyword, and is as
//! close to what it was asked to be as that allows.

use std::collections::BTreeSet;

use proc_macro2::Ident;
use quote::format_ident;

/// The identifiers that are taken in a scope.
#[derive(Debug, Clone, Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
}

impl Names {
    /// A scope in which `reserved` are taken.
    pub(super) fn reserving<'a>(reserved: impl IntoIterator<Item = &'a str>) -> Self {
        Self {
            taken: reserved.into_iter().map(str::to_owned).collect(),
        }
    }

    /// An identifier like `wish`.
    pub(super) fn take(&mut self, wish: &str) -> Ident {
        let wish = wish.trim_start_matches("r#");
        let mut candidate = wish.to_owned();
        let mut number = 1;
        while self.taken.contains(&candidate) || !is_identifier(&candidate) {
            // `match_`, then `match_2`, …
            candidate = if number == 1 {
                format!("{wish}_")
            } else {
                format!("{wish}_{number}")
            };
            number += 1;
        }
        let ident = format_ident!("{candidate}");
        self.taken.insert(candidate);
        ident
    }

    /// The identifiers `stem1`, `stem2`, …: the first that is free.
    pub(super) fn number(&mut self, stem: &str) -> Ident {
        let mut number = 1;
        while self.taken.contains(&format!("{stem}{number}")) {
            number += 1;
        }
        self.take(&format!("{stem}{number}"))
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
