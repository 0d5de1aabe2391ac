//! The work that normal forms may take, in terms formed: what a declaration asks for can grow
//! beyond bounds, and a macro has to end all the same, on every machine with the same answer.

use std::cell::Cell;
use std::rc::Rc;

/// Terms formed over one DAG and its copies, that is while one declaration is compiled.
/// Unoptimised, they take some second; the largest of the problems, with 64 states, needs 40 000.
const MOST: usize = 400_000;

/// A normal form may always form as many terms as this.
const LEAST: usize = 4_000;

/// What is left of [`MOST`], for a DAG and its copies together.
#[derive(Clone, Debug)]
pub(super) struct Work(Rc<Cell<usize>>);

impl Default for Work {
    fn default() -> Self {
        Self(Rc::new(Cell::new(MOST)))
    }
}

/// What a normal form may still take.
#[derive(Clone, Debug)]
pub(super) struct Budget {
    left: Cell<usize>,
    work: Work,
}

impl Work {
    /// A budget of at most `most` terms.
    pub(super) fn budget(&self, most: usize) -> Budget {
        Budget {
            left: Cell::new(most.min(self.0.get().max(LEAST))),
            work: self.clone(),
        }
    }
}

impl Budget {
    /// Takes `terms` from the budget; whether it has as many.
    pub(super) fn spend(&self, terms: usize) -> bool {
        let Some(left) = self.left.get().checked_sub(terms) else {
            self.left.set(0);
            return false;
        };
        self.left.set(left);
        self.work.0.set(self.work.0.get().saturating_sub(terms));
        true
    }
}
