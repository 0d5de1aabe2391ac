//! The names of a declaration: what each is, where it was declared, whether it is used.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Display, Formatter};

use proc_macro2::Ident;

use super::Value;
use crate::algebra::Function;
use crate::diagnostics::{Diagnostics, closest};
use crate::syntax::{Declaration, Item};

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A state.
    State,
    /// A parameter.
    Parameter,
    /// A `const`.
    Constant,
    /// A `let`.
    Let,
    /// An interface.
    Interface,
}

impl Display for Kind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::State => "state",
            Self::Parameter => "parameter",
            Self::Constant => "constant",
            Self::Let => "`let`",
            Self::Interface => "interface",
        })
    }
}

/// How far a name is.
#[derive(Debug, Clone, Copy)]
pub(super) enum Progress {
    /// Declared further down.
    Ahead,
    /// Its definition is wrong, which has been reported.
    Wrong,
    /// Resolved.
    Resolved(Value),
}

/// A declared name.
#[derive(Debug, Clone)]
pub(super) struct Symbol {
    /// What it stands for.
    pub(super) kind: Kind,
    /// Where it was declared.
    pub(super) ident: Ident,
    /// How far it is.
    pub(super) progress: Progress,
    used: bool,
    /// Its place in the order of declaration.
    order: usize,
}

/// The names that formulas may use: those of the system, and the `let`s of the region at hand.
#[derive(Debug, Default)]
pub(super) struct Names {
    system: BTreeMap<String, Symbol>,
    region: BTreeMap<String, Symbol>,
    /// Names with another meaning, of which a formula cannot use the name: what they are.
    others: BTreeMap<String, String>,
    /// Names of which a declaration was refused.
    refused: BTreeSet<String>,
}

impl Names {
    /// The names that the top level declares; reserved and repeated ones are reported.
    pub(super) fn collect(declaration: &Declaration, diagnostics: &mut Diagnostics) -> Self {
        let mut names = Self::default();
        for item in &declaration.items {
            match item {
                Item::State(states) => {
                    for state in states {
                        names.declare(&state.ident, Kind::State, diagnostics);
                    }
                }
                Item::Parameter(item) => names.declare(&item.ident, Kind::Parameter, diagnostics),
                Item::Constant(item) => names.declare(&item.ident, Kind::Constant, diagnostics),
                Item::Let(item) => names.declare(&item.ident, Kind::Let, diagnostics),
                Item::Interface(item) => names.declare(&item.ident, Kind::Interface, diagnostics),
                Item::Conserved(item) => names.note(&item.ident, "a conserved quantity"),
                Item::Region(region) => {
                    names.note(&region.ident, "a region");
                    for item in &region.items {
                        match item {
                            Item::Conserved(item) => {
                                names.note(&item.ident, "a conserved quantity")
                            }
                            Item::Let(item) => {
                                let what = format!("a `let` of the region `{}`", region.ident);
                                names.note(&item.ident, &what);
                            }
                            _ => {}
                        }
                    }
                }
                Item::Derivative(_) => {}
            }
        }
        names
    }

    fn note(&mut self, ident: &Ident, what: &str) {
        self.others
            .entry(ident.to_string())
            .or_insert_with(|| what.into());
    }

    fn declare(&mut self, ident: &Ident, kind: Kind, diagnostics: &mut Diagnostics) {
        if let Some(symbol) = self.new_symbol(ident, kind, diagnostics) {
            self.system.insert(ident.to_string(), symbol);
        }
    }

    /// Declares a `let` of the region at hand.
    pub(super) fn declare_in_region(&mut self, ident: &Ident, diagnostics: &mut Diagnostics) {
        if let Some(symbol) = self.new_symbol(ident, Kind::Let, diagnostics) {
            self.region.insert(ident.to_string(), symbol);
        }
    }

    fn new_symbol(
        &mut self,
        ident: &Ident,
        kind: Kind,
        diagnostics: &mut Diagnostics,
    ) -> Option<Symbol> {
        if let Some(meaning) = reserved(&ident.to_string()) {
            let message = format!("`{ident}` is {meaning} and cannot be declared as a {kind}");
            diagnostics.error(ident, message);
            self.refused.insert(ident.to_string());
            return None;
        }
        if let Some(earlier) = self.get(&ident.to_string()) {
            let message = if earlier.kind == kind {
                format!("the {kind} `{ident}` is declared twice")
            } else {
                format!("`{ident}` is already declared as a {}", earlier.kind)
            };
            diagnostics.error(ident, message.replace("as a interface", "as an interface"));
            self.refused.insert(ident.to_string());
            return None;
        }
        Some(Symbol {
            kind,
            ident: ident.clone(),
            progress: Progress::Ahead,
            used: false,
            order: self.system.len() + self.region.len(),
        })
    }

    /// Whether a declaration of `name` was refused, which explains what follows.
    pub(super) fn is_refused(&self, name: &str) -> bool {
        self.refused.contains(name)
    }

    /// Whether any declaration was refused.
    pub(super) fn any_refused(&self) -> bool {
        !self.refused.is_empty()
    }

    /// Refuses `name` from here on; false if it was refused before.
    pub(super) fn refuse(&mut self, name: &str) -> bool {
        self.refused.insert(name.to_owned())
    }

    /// Leaves the region at hand; its unused `let`s are returned.
    pub(super) fn leave_region(&mut self) -> Vec<(Kind, Ident)> {
        unused(&std::mem::take(&mut self.region))
    }

    /// What `name` stands for.
    pub(super) fn get(&self, name: &str) -> Option<&Symbol> {
        self.region.get(name).or_else(|| self.system.get(name))
    }

    fn get_mut(&mut self, name: &str) -> Option<&mut Symbol> {
        match self.region.get_mut(name) {
            Some(symbol) => Some(symbol),
            None => self.system.get_mut(name),
        }
    }

    /// What a name is that is no quantity: a region, a conserved quantity, …
    pub(super) fn other_meaning(&self, name: &str) -> Option<&str> {
        self.others.get(name).map(String::as_str)
    }

    /// Whether this declaration of `ident` is the one that counts: it is not, if the name is
    /// reserved, or declared as something else or as the same thing before.
    pub(super) fn is_first(&self, ident: &Ident, kind: Kind) -> bool {
        self.get(&ident.to_string())
            .is_some_and(|symbol| symbol.kind == kind && matches!(symbol.progress, Progress::Ahead))
    }

    /// From here on, `ident` has a value.
    pub(super) fn set(&mut self, ident: &Ident, value: Value) {
        if let Some(symbol) = self.get_mut(&ident.to_string()) {
            symbol.progress = Progress::Resolved(value);
        }
    }

    /// From here on, `ident` is known to be wrong.
    pub(super) fn set_wrong(&mut self, ident: &Ident) {
        if let Some(symbol) = self.get_mut(&ident.to_string()) {
            symbol.progress = Progress::Wrong;
        }
    }

    /// Takes note that `name` is used.
    pub(super) fn mark_used(&mut self, name: &str) {
        if let Some(symbol) = self.get_mut(name) {
            symbol.used = true;
        }
    }

    /// The declared name among those of the `kinds` that `name` was probably meant to be.
    pub(super) fn closest(&self, name: &str, kinds: &[Kind]) -> Option<String> {
        let symbols = self.region.iter().chain(&self.system);
        let candidates = symbols
            .filter(|(_, symbol)| kinds.contains(&symbol.kind))
            .map(|(candidate, _)| candidate.as_str());
        closest(name, candidates).map(str::to_owned)
    }

    /// What the top level declares and nothing uses, in the order of declaration.
    pub(super) fn unused(&self) -> Vec<(Kind, Ident)> {
        unused(&self.system)
    }
}

fn unused(symbols: &BTreeMap<String, Symbol>) -> Vec<(Kind, Ident)> {
    let mut unused: Vec<&Symbol> = symbols
        .values()
        .filter(|symbol| {
            let counts = matches!(symbol.kind, Kind::Parameter | Kind::Constant | Kind::Let);
            // a leading underscore says that it is meant to be unused, as in Rust
            counts && !symbol.used && !symbol.ident.to_string().starts_with('_')
        })
        .collect();
    unused.sort_by_key(|symbol| symbol.order);
    unused
        .into_iter()
        .map(|symbol| (symbol.kind, symbol.ident.clone()))
        .collect()
}

/// What the language itself means by `name`.
fn reserved(name: &str) -> Option<&'static str> {
    match name {
        "t" => Some("the time"),
        "pi" => Some("the number π"),
        _ if name.parse::<Function>().is_ok_and(Function::is_declarable) => Some("a function"),
        _ => None,
    }
}
