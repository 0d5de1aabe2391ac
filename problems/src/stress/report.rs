//! What a study tells: cases, and what became of each.

use std::ops::ControlFlow;

use dmm_runtime::{Error, ErrorKind};

/// How a case ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// It was integrated, within the bounds.
    Survived,
    /// It was stopped by a typed error, or told as undecided.
    Refused,
    /// It was integrated beyond the bounds, and nothing was said.
    Wrong,
}

impl Verdict {
    /// [`Verdict::Survived`] or [`Verdict::Wrong`].
    pub fn within(bounds: bool) -> Self {
        if bounds { Self::Survived } else { Self::Wrong }
    }

    /// In a word.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Survived => "survived",
            Self::Refused => "refused",
            Self::Wrong => "WRONG",
        }
    }
}

/// A case and what became of it.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    /// What was integrated.
    pub case: String,
    /// By which scheme.
    pub scheme: String,
    /// How it ended.
    pub verdict: Verdict,
    /// The figures.
    pub finding: String,
}

impl Row {
    /// A case by a scheme, how it ended, and its figures.
    pub fn new(
        case: impl Into<String>,
        scheme: impl Into<String>,
        verdict: Verdict,
        finding: impl Into<String>,
    ) -> Self {
        Self {
            case: case.into(),
            scheme: scheme.into(),
            verdict,
            finding: finding.into(),
        }
    }

    /// A run that was stopped.
    pub(super) fn refused(
        case: impl Into<String>,
        scheme: impl Into<String>,
        error: &Error,
    ) -> Self {
        Self::new(case, scheme, Verdict::Refused, kind_of(error))
    }
}

/// How much is done.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extent {
    /// Everything.
    Full,
    /// The same in a few seconds.
    Brief,
}

impl Extent {
    /// A number that depends on it.
    pub fn of<T>(self, full: T, brief: T) -> T {
        match self {
            Self::Full => full,
            Self::Brief => brief,
        }
    }
}

/// Follows a study, and says whether to go on; a case that is stopped has no row.
pub trait Observe {
    /// A case begins.
    fn begins(&mut self, _case: &str) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
    /// The share of the case that is done.
    fn at(&mut self, _share: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
    /// A case has ended.
    fn ended(&mut self, row: Row);
}

/// The kind of an error, in a few words.
pub fn kind_of(error: &Error) -> &'static str {
    match error.kind {
        ErrorKind::InvalidInput { .. } => "invalid input",
        ErrorKind::NewtonFailed { .. } => "Newton failed",
        ErrorKind::LeftDomain | ErrorKind::Undefined { .. } => "left the domain",
        ErrorKind::Overflow => "overflow",
        ErrorKind::Sliding { .. } => "sliding",
        ErrorKind::Tangential { .. } => "tangential",
        ErrorKind::Ambiguous { .. } => "ambiguous start",
        ErrorKind::NoRegion => "no region",
        ErrorKind::LocationFailed { .. } => "location failed",
        ErrorKind::Undecided { .. } => "undecided",
        ErrorKind::Zeno { .. } => "Zeno",
        ErrorKind::OutOfRange { .. } => "out of range",
        _ => "other",
    }
}
