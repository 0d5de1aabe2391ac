//! What names stand for: quantities and functions, and the calls in which they are met.

use std::collections::BTreeMap;

use proc_macro2::Ident;

use super::evaluator::Value;
use super::names::Names;
use crate::algebra::Id;
use crate::diagnostics::Diagnostics;
use crate::syntax::{Declaration, Expression, FunctionItem};

/// The names of a declaration, and where in it a formula is read.
pub(super) struct Scope<'d> {
    pub(super) names: Names,
    pub(super) functions: BTreeMap<String, &'d FunctionItem>,
    /// The function whose declaration is read.
    pub(super) defining: Option<String>,
    /// The calls that are being written out, the outermost first.
    pub(super) calls: Vec<&'d Expression>,
    /// By function and arguments: what a call was written out to.
    pub(super) calls_known: BTreeMap<(String, Vec<Id>), Option<Value>>,
}

impl Scope<'_> {
    /// That of the top level; reserved and repeated names are reported.
    pub(super) fn of(declaration: &Declaration, diagnostics: &mut Diagnostics) -> Self {
        Self {
            names: Names::collect(declaration, diagnostics),
            functions: BTreeMap::new(),
            defining: None,
            calls: Vec::new(),
            calls_known: BTreeMap::new(),
        }
    }

    /// How a declared function is called: `V(q, k)`.
    pub(super) fn signature(&self, text: &str) -> String {
        let arguments = match self.functions.get(text) {
            Some(item) => {
                let names: Vec<String> = item.arguments.iter().map(Ident::to_string).collect();
                names.join(", ")
            }
            None => "…".into(),
        };
        format!("{text}({arguments})")
    }

    /// The values of the loop variables behind `with`: ` with i = 2, j = 0`.
    pub(super) fn turn(&self, with: &str) -> String {
        let counters: Vec<String> = (self.names.counters())
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        match counters.as_slice() {
            [] => String::new(),
            counters => format!("{with} {}", counters.join(", ")),
        }
    }
}
