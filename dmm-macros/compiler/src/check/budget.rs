//! The work that a declaration may take: loops and functions can make a short one arbitrarily
//! long.

/// The most parts of formulas that are read, each as often as loops and functions repeat it.
const MOST_WORK: usize = 60_000;
/// The most nodes of all formulas together.
const MOST_NODES: usize = 30_000;
/// Formulas within functions within functions may be nested this deep in all.
const DEEPEST: usize = 600;

/// What was spent so far.
#[derive(Debug, Default)]
pub(super) struct Budget {
    /// How much was read.
    work: usize,
    /// How deep the part of a formula that is read is nested.
    depth: usize,
}

impl Budget {
    /// Counts what was read.
    pub(super) fn spend(&mut self, work: usize) {
        self.work = self.work.saturating_add(work);
    }

    /// Nothing is left.
    pub(super) fn exhaust(&mut self) {
        self.work = usize::MAX;
    }

    /// Whether too much was read, or there are too many `nodes`.
    pub(super) fn is_exhausted(&self, nodes: usize) -> bool {
        self.work > MOST_WORK || nodes > MOST_NODES
    }

    /// One level deeper into a formula, if it may be as deep.
    pub(super) fn enter(&mut self) -> Option<()> {
        (self.depth < DEEPEST).then(|| self.depth += 1)
    }

    /// One level out of a formula.
    pub(super) fn leave(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }
}
