//! What may be declared under which name.

use proc_macro2::Ident;

use super::{Kind, Meaning, Names, Symbol};
use crate::algebra::Function;
use crate::check::number::Problem;
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::check as codes;
use crate::syntax::{Declaration, Item};

impl Names {
    /// The names that the top level declares; reserved and repeated ones are reported.
    pub(in crate::check) fn collect(
        declaration: &Declaration,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let mut names = Self::default();
        for item in &declaration.items {
            match item {
                Item::State(states) => {
                    for state in states {
                        names.declare(&state.ident, Kind::State, diagnostics);
                    }
                }
                Item::Parameter(item) => {
                    names.declare(&item.group.ident, Kind::Parameter, diagnostics)
                }
                Item::Discrete(item) => names.declare(&item.ident, Kind::Discrete, diagnostics),
                Item::Constant(item) => names.declare(&item.ident, Kind::Constant, diagnostics),
                Item::Let(item) => names.declare(&item.ident, Kind::Let, diagnostics),
                Item::Interface(item) => {
                    names.declare(&item.definition.ident, Kind::Interface, diagnostics);
                }
                Item::Function(item) => {
                    names.declare(&item.definition.ident, Kind::Function, diagnostics)
                }
                Item::Region(region) => {
                    names.note(&region.ident, "a region");
                    names.note_all(&region.items, &format!(" of the region `{}`", region.ident));
                }
                other => names.note_all(std::slice::from_ref(other), ""),
            }
        }
        names
    }

    /// Takes note of names that other formulas cannot use.
    fn note_all(&mut self, items: &[Item], place: &str) {
        for item in items {
            match item {
                Item::Conserved(item) => self.note(&item.definition.ident, "a conserved quantity"),
                Item::Hamiltonian(item) => {
                    self.note(&item.definition.ident, "the energy of a `hamiltonian`")
                }
                Item::Let(item) => self.note(&item.ident, &format!("a `let`{place}")),
                Item::For(item) => self.note_all(&item.items, place),
                _ => {}
            }
        }
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
    pub(in crate::check) fn declare_in_region(
        &mut self,
        ident: &Ident,
        diagnostics: &mut Diagnostics,
    ) {
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
        let text = ident.to_string();
        let problem = match (reserved(&text), self.get(&text)) {
            (Some(meaning), _) => Some((
                codes::RESERVED,
                format!(
                    "`{text}` is {meaning} and cannot be declared as {}",
                    kind.article()
                ),
            )),
            (None, Some(earlier)) if earlier.kind == kind => Some((
                codes::DECLARED_TWICE,
                format!("the {kind} `{text}` is declared twice"),
            )),
            (None, Some(earlier)) if kind == Kind::Interface => Some((
                codes::DECLARED_TWICE,
                format!(
                    "`{text}` is already declared as {}: an interface has a name of its own, as in `interface wall = {text};`",
                    earlier.kind.article()
                ),
            )),
            (None, Some(earlier)) => Some((
                codes::DECLARED_TWICE,
                format!("`{text}` is already declared as {}", earlier.kind.article()),
            )),
            (None, None) => None,
        };
        if let Some((code, message)) = problem {
            diagnostics.report(code, ident, message);
            self.refused.insert(text);
            return None;
        }
        Some(Symbol {
            kind,
            ident: ident.clone(),
            meaning: Meaning::Ahead,
            used: false,
            order: self.system.len() + self.region.len(),
        })
    }

    /// Why a loop variable cannot have this name: that of anything else would mean something
    /// different within the loop than around it.
    pub(in crate::check) fn counter_problem(&self, ident: &Ident) -> Option<Problem> {
        let text = ident.to_string();
        if let Some(problem) = reserved_problem(&text, Kind::Counter) {
            return Some(problem);
        }
        let earlier = self.get(&text)?;
        let message = match earlier.kind {
            Kind::Counter => {
                format!("the loop variable `{text}` is there already; choose another name")
            }
            kind => format!(
                "the loop variable `{text}` has the name of {}; choose another name",
                kind.article()
            ),
        };
        Some((codes::SHADOWED, message))
    }

    /// Why an argument of the function at hand cannot have this name. It may be the name of
    /// something outside of the function, which the formula then does not see.
    pub(in crate::check) fn argument_problem(&self, ident: &Ident) -> Option<Problem> {
        let text = ident.to_string();
        if let Some(problem) = reserved_problem(&text, Kind::Argument) {
            return Some(problem);
        }
        self.local(&text).map(|_| {
            let message = format!("the argument `{text}` is declared twice; rename one of the two");
            (codes::DECLARED_TWICE, message)
        })
    }
}

fn reserved_problem(text: &str, kind: Kind) -> Option<Problem> {
    let meaning = reserved(text)?;
    let message = format!("`{text}` is {meaning} and cannot be {}", kind.article());
    Some((codes::RESERVED, message))
}

/// What the language itself means by `name`.
fn reserved(name: &str) -> Option<&'static str> {
    match name {
        "t" => Some("the time"),
        "pi" => Some("the number π"),
        _ if is_built_in(name) => Some("a built-in function"),
        _ => None,
    }
}

/// Whether `name` is a built-in function.
pub(in crate::check) fn is_built_in(name: &str) -> bool {
    name.parse::<Function>().is_ok_and(Function::is_declarable)
}
