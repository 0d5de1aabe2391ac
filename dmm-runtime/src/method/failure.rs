//! Why a method cannot go on, without names: the driver adds them.

/// A step that could not be made from where the cursor is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Failure {
    /// Why.
    pub kind: FailureKind,
    /// Its size.
    pub step_size: f64,
}

impl Failure {
    /// A guard is met in a step, at a point that was not found.
    #[cold]
    pub(crate) fn not_located(guard: usize, step_size: f64) -> Self {
        Self {
            kind: FailureKind::NotLocated { guard },
            step_size,
        }
    }

    /// Whether a guard is met in a step cannot be decided.
    #[cold]
    pub(crate) fn undecided(guard: usize, step_size: f64) -> Self {
        Self {
            kind: FailureKind::Undecided { guard },
            step_size,
        }
    }
}

/// Why a step could not be made.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum FailureKind {
    /// Its equations have no solution, or a formula no value.
    Step(StepFailure),
    /// A guard is met in it, but no point was found at which its function is zero.
    NotLocated {
        /// Which one.
        guard: usize,
    },
    /// Whether a guard is met in it cannot be decided.
    Undecided {
        /// Which one.
        guard: usize,
    },
}

/// Why a scheme could not make a step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum StepFailure {
    /// Newton's method did not converge.
    NoConvergence {
        /// Largest component of the residual.
        residual: f64,
        /// Iterations spent.
        iterations: u64,
    },
    /// A formula had no finite value.
    NotFinite,
}

impl StepFailure {
    /// The failure of a step over `step_size`.
    #[cold]
    pub(crate) fn over(self, step_size: f64) -> Failure {
        Failure {
            kind: FailureKind::Step(self),
            step_size,
        }
    }
}
