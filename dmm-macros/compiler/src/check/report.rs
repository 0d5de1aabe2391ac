//! What is reported, where, and when it is too much.
//!
//! An error in the formula of a function belongs to the call that made it one, an error in a loop
//! to a turn of it.

use std::collections::BTreeSet;
use std::fmt::Display;

use proc_macro2::Ident;

use super::Resolver;
use super::names::Kind;
use crate::diagnostics::catalogue::check as codes;
use crate::diagnostics::{Code, Diagnostics, Extent};
use crate::syntax::Expression;

/// Where errors go.
pub(super) struct Reporter<'d> {
    pub(super) diagnostics: &'d mut Diagnostics,
    /// What regions repeat of what they share, as far as it was reported.
    pub(super) repeated: BTreeSet<String>,
    /// The loop variables of which was warned.
    pub(super) warned: BTreeSet<*const Ident>,
    /// Whether what is reported is to be forgotten, because it was reported before.
    pub(super) is_quiet: bool,
}

impl<'d> Reporter<'d> {
    pub(super) fn new(diagnostics: &'d mut Diagnostics) -> Self {
        Self {
            diagnostics,
            repeated: BTreeSet::new(),
            warned: BTreeSet::new(),
            is_quiet: false,
        }
    }
}

impl Resolver<'_> {
    /// Reports an error; one within the formula of a function where that is called.
    pub(super) fn report(&mut self, code: Code, place: impl Into<Extent>, message: impl Display) {
        if self.reporter.is_quiet {
            return;
        }
        match self.scope.calls.first() {
            Some(call) => {
                let message = format!("in `{call}`: {message}");
                self.reporter.diagnostics.report(code, call.extent, message);
            }
            None => self.reporter.diagnostics.report(code, place, message),
        }
    }

    /// Warns, as [`report`](Self::report) reports an error.
    pub(super) fn warn(&mut self, code: Code, place: impl Into<Extent>, message: impl Display) {
        // what a call is written out to is no place to warn of: the function is, where it stands
        if !self.reporter.is_quiet && self.scope.calls.is_empty() {
            self.reporter.diagnostics.warn(code, place, message);
        }
    }

    /// Reports an error that may depend on the values of the loop variables.
    pub(super) fn report_turn(
        &mut self,
        code: Code,
        place: impl Into<Extent>,
        message: impl Display,
    ) {
        let turn = self.scope.turn(", with");
        self.report(code, place, format!("{message}{turn}"));
    }

    /// Does what reports nothing new.
    pub(super) fn quietly<T>(&mut self, task: impl FnOnce(&mut Self) -> T) -> T {
        let was_quiet = std::mem::replace(&mut self.reporter.is_quiet, true);
        let result = task(self);
        self.reporter.is_quiet = was_quiet;
        result
    }

    /// Counts what was read; nothing is read any more once it is too much.
    pub(super) fn spend(&mut self, work: usize, place: &Expression) -> Option<()> {
        if self.is_exhausted() {
            return None;
        }
        self.budget.spend(work);
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
        self.budget.is_exhausted(self.evaluator.dag.len())
    }

    /// Reports that the declaration is too long, and reads no more of it.
    pub(super) fn too_long(&mut self, place: &Expression, reason: &str) {
        self.budget.exhaust();
        let message = format!(
            "this declaration is too long: {reason}{}",
            self.scope.turn(", with")
        );
        self.report(codes::TOO_LONG, place.extent, message);
    }

    /// Warns of what was declared and never used, as far as everything that could use it is there.
    pub(super) fn unused(&mut self) {
        if !self.regions.lacks_region && !self.is_exhausted() {
            let unused = self.scope.names.unused();
            self.report_unused(unused);
        }
    }

    pub(super) fn report_unused(&mut self, unused: Vec<(Kind, Ident)>) {
        for (kind, ident) in unused {
            let message =
                format!("the {kind} `{ident}` is never used: remove it, or call it `_{ident}`");
            self.warn(codes::UNUSED, &ident, message);
        }
    }
}
