//! The names of a declaration: what each is, where it was declared, whether it is used.
//!
//! A formula sees, from the inside outwards, the loop variables around it, the `let`s of its
//! region, and the names of the system. The formula of a `fn` sees its arguments instead of the
//! loop variables and the region at its call.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::Ident;

use super::Value;
pub(super) use super::kind::Kind;
use crate::algebra::Function;
use crate::diagnostics::catalogue::check as codes;
use crate::diagnostics::{Code, Diagnostics, closest};
use crate::syntax::{Declaration, Item};

/// What is known of a name so far.
#[derive(Debug, Clone)]
pub(super) enum Meaning {
    /// It is declared further down.
    Ahead,
    /// Its definition is wrong, which has been reported.
    Wrong,
    /// It has a value.
    Value(Value),
    /// It is a group with these elements.
    Elements(Rc<[Value]>),
    /// It is a function with a correct formula.
    Function,
}

/// A declared name.
#[derive(Debug, Clone)]
pub(super) struct Symbol {
    /// What it stands for.
    pub(super) kind: Kind,
    /// Where it was declared.
    pub(super) ident: Ident,
    /// What is known of it.
    pub(super) meaning: Meaning,
    /// Whether a formula uses it.
    pub(super) used: bool,
    /// Its place in the order of declaration.
    order: usize,
}

/// The names that formulas may use.
#[derive(Debug, Default)]
pub(super) struct Names {
    system: BTreeMap<String, Symbol>,
    /// The `let`s of the region at hand.
    region: BTreeMap<String, Symbol>,
    /// Loop variables and arguments, the innermost last.
    local: Vec<(String, Symbol)>,
    /// Where the arguments of each function begin that is being written out.
    frames: Vec<usize>,
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
                Item::Parameter(item) => {
                    names.declare(&item.group.ident, Kind::Parameter, diagnostics)
                }
                Item::Constant(item) => names.declare(&item.ident, Kind::Constant, diagnostics),
                Item::Let(item) => names.declare(&item.ident, Kind::Let, diagnostics),
                Item::Interface(item) => names.declare(&item.ident, Kind::Interface, diagnostics),
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

    /// Why a loop variable or an argument cannot have this name.
    pub(super) fn local_problem(&self, ident: &Ident, kind: Kind) -> Option<(Code, String)> {
        let text = ident.to_string();
        if let Some(meaning) = reserved(&text) {
            let message = format!("`{text}` is {meaning} and cannot be {}", kind.article());
            return Some((codes::RESERVED, message));
        }
        let earlier = self.get(&text)?;
        let message = if earlier.kind == kind {
            format!("the {kind} `{text}` is there already; choose another name")
        } else {
            format!(
                "the {kind} `{text}` has the name of {}; choose another name",
                earlier.kind.article()
            )
        };
        Some((codes::SHADOWED, message))
    }

    /// From here on, `ident` is a loop variable or an argument.
    pub(super) fn push_local(&mut self, ident: &Ident, kind: Kind, value: Value) {
        let symbol = Symbol {
            kind,
            ident: ident.clone(),
            meaning: Meaning::Value(value),
            used: false,
            order: 0,
        };
        self.local.push((ident.to_string(), symbol));
    }

    /// Leaves the scope of the last loop variable or argument; whether it was used.
    pub(super) fn pop_local(&mut self) -> bool {
        self.local.pop().is_some_and(|(_, symbol)| symbol.used)
    }

    /// From here on, formulas are those of a function.
    pub(super) fn enter_function(&mut self) {
        self.frames.push(self.local.len());
    }

    /// Back to where the function was called.
    pub(super) fn leave_function(&mut self) {
        if let Some(first) = self.frames.pop() {
            self.local.truncate(first);
        }
    }

    /// The loop variables with their values, the outermost first.
    pub(super) fn counters(&self) -> impl Iterator<Item = (&str, f64)> {
        self.local.iter().filter_map(|(name, symbol)| {
            let value = match &symbol.meaning {
                Meaning::Value(value) if symbol.kind == Kind::Counter => value.number?,
                _ => return None,
            };
            Some((name.as_str(), value))
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

    fn visible_locals(&self) -> usize {
        self.frames.last().copied().unwrap_or(0)
    }

    /// What `name` stands for.
    pub(super) fn get(&self, name: &str) -> Option<&Symbol> {
        let locals = self.local.get(self.visible_locals()..).unwrap_or_default();
        if let Some((_, symbol)) = locals.iter().rev().find(|(local, _)| local == name) {
            return Some(symbol);
        }
        let region = self.frames.is_empty().then(|| self.region.get(name));
        region.flatten().or_else(|| self.system.get(name))
    }

    fn get_mut(&mut self, name: &str) -> Option<&mut Symbol> {
        let first = self.visible_locals();
        let locals = self.local.get_mut(first..).unwrap_or_default();
        if let Some((_, symbol)) = locals.iter_mut().rev().find(|(local, _)| local == name) {
            return Some(symbol);
        }
        if self.frames.is_empty() && self.region.contains_key(name) {
            return self.region.get_mut(name);
        }
        self.system.get_mut(name)
    }

    /// What a name is that is no quantity: a region, a conserved quantity, …
    pub(super) fn other_meaning(&self, name: &str) -> Option<&str> {
        self.others.get(name).map(String::as_str)
    }

    /// Whether this declaration of `ident` is the one that counts: it is not, if the name is
    /// reserved, or declared as something else or as the same thing before.
    pub(super) fn is_first(&self, ident: &Ident, kind: Kind) -> bool {
        self.get(&ident.to_string())
            .is_some_and(|symbol| symbol.kind == kind && matches!(symbol.meaning, Meaning::Ahead))
    }

    /// From here on, `ident` has a meaning.
    pub(super) fn set(&mut self, ident: &Ident, meaning: Meaning) {
        if let Some(symbol) = self.get_mut(&ident.to_string()) {
            symbol.meaning = meaning;
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
        let locals = self.local.get(self.visible_locals()..).unwrap_or_default();
        let locals = locals.iter().map(|(name, symbol)| (name, symbol));
        let symbols = locals.chain(&self.region).chain(&self.system);
        let candidates = symbols
            .filter(|(_, symbol)| kinds.contains(&symbol.kind))
            .map(|(candidate, _)| candidate.as_str());
        closest(name, candidates).map(str::to_owned)
    }

    /// The declared functions.
    pub(super) fn functions(&self) -> impl Iterator<Item = &str> {
        let symbols = self.system.iter();
        symbols
            .filter(|(_, symbol)| symbol.kind == Kind::Function)
            .map(|(name, _)| name.as_str())
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
            let counts = !matches!(symbol.kind, Kind::State | Kind::Interface);
            counts && !symbol.used && !is_meant_to_be_unused(&symbol.ident)
        })
        .collect();
    unused.sort_by_key(|symbol| symbol.order);
    unused
        .into_iter()
        .map(|symbol| (symbol.kind, symbol.ident.clone()))
        .collect()
}

/// A leading underscore says so, as in Rust.
pub(super) fn is_meant_to_be_unused(ident: &Ident) -> bool {
    ident.to_string().starts_with('_')
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
pub(super) fn is_built_in(name: &str) -> bool {
    name.parse::<Function>().is_ok_and(Function::is_declarable)
}
