//! The catalogue of diagnostics: what each means, why it is raised and what to do.
//!
//! | numbers | stage | about |
//! |---|---|---|
//! | 100–199 | [`syntax`] | how a declaration is written |
//! | 200–299 | [`check`] | names, regions, formulas |
//! | 300–399 | [`proofs`] | what a declaration claims |
//! | 400–499 | [`scheme`] | what is derived from it |
//!
//! `markdown` is the catalogue as a document, which `DIAGNOSTICS.md` of the runtime is a copy of:
//! the documentation of `pws!` shows it.

pub mod check;
#[cfg(feature = "explore")]
mod document;
pub mod proofs;
pub mod scheme;
pub mod syntax;

#[cfg(test)]
mod tests;

use std::fmt::Display;
use std::ops::RangeInclusive;

use super::Extent;
#[cfg(feature = "explore")]
pub use document::markdown;

/// An entry of the catalogue. Every error carries one; its number stands at the end of the
/// message, as in `[PWS301]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Code {
    /// Its number, which never changes its meaning.
    pub number: u16,
    /// What is wrong, in a few words.
    pub title: &'static str,
    /// Why it is an error.
    pub cause: &'static str,
    /// What to write instead.
    pub remedy: &'static str,
}

impl Code {
    /// An error of this kind on the source at `place`.
    pub fn error(&self, place: impl Into<Extent>, message: impl Display) -> syn::Error {
        place.into().error(format!("{message} [{self}]"))
    }
}

impl Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "PWS{:03}", self.number)
    }
}

/// The entries of one stage of the compiler.
#[derive(Debug, Clone)]
pub struct Stage {
    /// What they are about.
    pub about: &'static str,
    /// The numbers that they can have.
    pub numbers: RangeInclusive<u16>,
    /// The entries, by number.
    pub codes: &'static [&'static Code],
}

/// The stages, in the order in which a declaration goes through them.
pub fn stages() -> [Stage; 4] {
    let stage = |about, first: u16, codes| Stage {
        about,
        numbers: first..=first + 99,
        codes,
    };
    [
        stage("How a declaration is written", 100, syntax::ALL),
        stage("Names, regions and formulas", 200, check::ALL),
        stage("What a declaration claims", 300, proofs::ALL),
        stage("What is derived from it", 400, scheme::ALL),
    ]
}

/// Every entry, by number.
pub fn all() -> Vec<&'static Code> {
    let codes = stages().map(|stage| stage.codes.iter().copied());
    codes.into_iter().flatten().collect()
}

/// The entry with this number, if there is one.
///
/// ```
/// use dmm_compiler::diagnostics::catalogue;
///
/// let code = catalogue::find(131).expect("ranges have an entry");
/// assert_eq!(code.to_string(), "PWS131");
/// assert_eq!(code.title, "a range is not written `start..end`");
/// ```
pub fn find(number: u16) -> Option<&'static Code> {
    all().into_iter().find(|code| code.number == number)
}

/// Writes the constants of a stage together with the list of them.
macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident = $number:literal, $title:literal, $cause:literal, $remedy:literal;)*) => {
        $(
            $(#[$doc])*
            #[doc = $title]
            pub const $name: crate::diagnostics::Code = crate::diagnostics::Code {
                number: $number,
                title: $title,
                cause: $cause,
                remedy: $remedy,
            };
        )*
        /// The entries of this stage, by number.
        pub const ALL: &[&crate::diagnostics::Code] = &[$(&$name),*];
    };
}
use codes;
