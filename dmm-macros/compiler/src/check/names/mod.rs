//! The names of a declaration: what each is, where it was declared, whether it is used.
//!
//! A formula sees, from the inside outwards, the loop variables around it, the `let`s of its
//! region, and the names of the system. The formula of a `fn` sees its arguments instead of the
//! loop variables and the region at its call; they hide what has the same name outside.

mod declare;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::Ident;

use super::Value;
pub(super) use super::kind::Kind;
use crate::diagnostics::closest;
pub(super) use declare::is_built_in;

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

    /// Whether a loop around has a variable without a value: it is read for its mistakes, and what
    /// it gives does not count.
    pub(super) fn is_rehearsal(&self) -> bool {
        self.local.iter().any(|(_, symbol)| match &symbol.meaning {
            Meaning::Value(value) => symbol.kind == Kind::Counter && value.number.is_none(),
            _ => false,
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

    /// The loop variable or argument of this name.
    fn local(&self, name: &str) -> Option<&Symbol> {
        let locals = self.local.get(self.visible_locals()..).unwrap_or_default();
        let found = locals.iter().rev().find(|(local, _)| local == name);
        found.map(|(_, symbol)| symbol)
    }

    /// What `name` stands for.
    pub(super) fn get(&self, name: &str) -> Option<&Symbol> {
        if let Some(symbol) = self.local(name) {
            return Some(symbol);
        }
        let region = self.frames.is_empty().then(|| self.region.get(name));
        region.flatten().or_else(|| self.system.get(name))
    }

    /// Whether an argument of this name hides a group.
    pub(super) fn hides_group(&self, name: &str) -> bool {
        let symbol = self.system.get(name);
        symbol.is_some_and(|symbol| matches!(symbol.meaning, Meaning::Elements(_)))
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
            let counts = !matches!(symbol.kind, Kind::State | Kind::Discrete | Kind::Interface);
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
