//! What is reported, where, and when it is too much.
//!
//! An error in the formula of a function belongs to the call that made it one, an error in a loop
//! to a turn of it. Loops and functions can make a short declaration arbitrarily long, so that the
//! nodes that are written out have a limit.

use std::fmt::Display;

use proc_macro2::Ident;

use super::Resolver;
use super::names::Kind;
use crate::diagnostics::catalogue::check as codes;
use crate::diagnostics::{Code, Extent};
use crate::syntax::Expression;

/// The most parts of formulas that are read, each as often as loops and functions repeat it.
const MOST_WORK: usize = 60_000;
/// The most nodes of all formulas together.
const MOST_NODES: usize = 30_000;

impl Resolver<'_> {
    /// Reports an error; one within the formula of a function where that is called.
    pub(super) fn report(&mut self, code: Code, place: impl Into<Extent>, message: impl Display) {
        if self.is_quiet {
            return;
        }
        match self.calls.first() {
            Some(call) => {
                let message = format!("in `{call}`: {message}");
                self.diagnostics.report(code, call.extent, message);
            }
            None => self.diagnostics.report(code, place, message),
        }
    }

    /// Reports an error that may depend on the values of the loop variables.
    pub(super) fn report_turn(
        &mut self,
        code: Code,
        place: impl Into<Extent>,
        message: impl Display,
    ) {
        let turn = self.turn(", with");
        self.report(code, place, format!("{message}{turn}"));
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

    /// Does what reports nothing new.
    pub(super) fn quietly<T>(&mut self, task: impl FnOnce(&mut Self) -> T) -> T {
        let was_quiet = std::mem::replace(&mut self.is_quiet, true);
        let result = task(self);
        self.is_quiet = was_quiet;
        result
    }

    /// Counts what was read; nothing is read any more once it is too much.
    pub(super) fn spend(&mut self, work: usize, place: &Expression) -> Option<()> {
        if self.is_exhausted() {
            return None;
        }
        self.work = self.work.saturating_add(work);
        if self.is_exhausted() {
            self.too_long(
                place,
                "written out, its loops and functions have too many parts",
            );
            return None;
        }
        Some(())
    }

    pub(super) fn is_exhausted(&self) -> bool {
        self.work > MOST_WORK || self.dag.len() > MOST_NODES
    }

    /// Reports that the declaration is too long, and reads no more of it.
    pub(super) fn too_long(&mut self, place: &Expression, reason: &str) {
        self.work = usize::MAX;
        let message = format!(
            "this declaration is too long: {reason}{}",
            self.turn(", with")
        );
        self.report(codes::TOO_LONG, place.extent, message);
    }

    /// What was declared and never used, as far as everything that could use it is there.
    pub(super) fn unused(&mut self) {
        if !self.lacks_region && !self.is_exhausted() {
            let unused = self.names.unused();
            self.report_unused(unused);
        }
    }

    pub(super) fn report_unused(&mut self, unused: Vec<(Kind, Ident)>) {
        for (kind, ident) in unused {
            let message = format!("the {kind} `{ident}` is never used; remove it");
            self.report(codes::UNUSED, &ident, message);
        }
    }
}
