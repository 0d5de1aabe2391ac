//! Stress: runs at the edge of what a scheme can do. What survives keeps what it promises, what
//! cannot be integrated is refused by a typed error, and nothing is wrong in silence.
//!
//! One file a study, each a function that makes its runs, judges them by bounds with a reason,
//! and draws what it saw.

mod failures;
mod growth;
mod long;
mod scales;
mod step_sizes;
mod stiffness;
mod systems;
mod tangency;
mod transitions;

use dmm_runtime::{Error, ErrorKind};

use crate::method::{Control, MethodName};
use crate::picture::Panel;
use crate::problem::{Problem, Run};

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
    fn refused(case: impl Into<String>, scheme: impl Into<String>, error: &Error) -> Self {
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

/// Follows a study.
pub trait Observe {
    /// A case begins.
    fn begins(&mut self, case: &str);
    /// A case has ended.
    fn ended(&mut self, row: Row);
}

/// A study.
#[derive(Clone, Copy, Debug)]
pub struct Study {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it does.
    pub title: &'static str,
    study: fn(Extent, &mut dyn Observe) -> Vec<Panel>,
}

impl Study {
    /// Makes the study and draws what it saw; `observer` is told of each case.
    pub fn run(&self, extent: Extent, observer: &mut dyn Observe) -> Vec<Panel> {
        (self.study)(extent, observer)
    }
}

/// All studies.
pub const STUDIES: [Study; 7] = [
    Study {
        name: "long",
        title: "conservation within segments over up to 10⁹ steps",
        study: long::study,
    },
    Study {
        name: "transitions",
        title: "levels over up to 10⁶ transitions",
        study: transitions::study,
    },
    Study {
        name: "step-sizes",
        title: "step sizes from the limit of stability to 10⁻⁹",
        study: step_sizes::study,
    },
    Study {
        name: "scales",
        title: "states from 10⁻¹⁵⁰ to 10¹⁵⁰",
        study: scales::study,
    },
    Study {
        name: "stiffness",
        title: "ratios of stiffness up to 10⁸",
        study: stiffness::study,
    },
    Study {
        name: "tangency",
        title: "crossings at angles from 10⁻¹ to 10⁻¹²",
        study: tangency::study,
    },
    Study {
        name: "failures",
        title: "injected failures of solvers, locators and formulas",
        study: failures::study,
    },
];

/// A scheme at a setting.
#[derive(Clone, Copy, Debug)]
struct Setting {
    name: &'static str,
    method: MethodName,
    step_size: f64,
    tolerance: f64,
}

impl Setting {
    /// A scheme with uniform steps.
    const fn steps(name: &'static str, method: MethodName, step_size: f64) -> Self {
        Self {
            name,
            method,
            step_size,
            tolerance: f64::NAN,
        }
    }

    /// A scheme that chooses its steps.
    const fn tolerance(name: &'static str, method: MethodName, tolerance: f64) -> Self {
        Self {
            name,
            method,
            // for runs whose length is given in steps
            step_size: 1.0,
            tolerance,
        }
    }

    fn has_uniform_steps(&self) -> bool {
        matches!(self.method.control(), Control::StepSize { .. })
    }

    /// The default run of a problem at this setting.
    fn run(&self, problem: &Problem) -> Run {
        Run {
            method: self.method,
            step_size: self.step_size,
            tolerance: self.tolerance,
            ..problem.default_run()
        }
    }
}

/// Every scheme, at settings for problems whose time scale is about 1; those that choose their
/// steps also at a loose tolerance.
const SETTINGS: [Setting; 9] = [
    Setting::steps("Symmetric", MethodName::Symmetric, 0.02),
    Setting::steps("Composed<4>", MethodName::Composed4, 0.04),
    Setting::steps("Composed<6>", MethodName::Composed6, 0.08),
    Setting::steps("Composed<8>", MethodName::Composed8, 0.08),
    Setting::tolerance("Symmetric 1e-5", MethodName::SymmetricAdaptive, 1e-5),
    Setting::tolerance("Composed<8> 1e-9", MethodName::Composed8Adaptive, 1e-9),
    Setting::tolerance("Taylor 1e-3", MethodName::Taylor, 1e-3),
    Setting::tolerance("Taylor 1e-12", MethodName::Taylor, 1e-12),
    Setting::tolerance("Best 1e-12", MethodName::Best, 1e-12),
];

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

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Default)]
    struct Seen {
        begun: usize,
        rows: Vec<Row>,
    }

    impl Observe for Seen {
        fn begins(&mut self, _case: &str) {
            self.begun += 1;
        }

        fn ended(&mut self, row: Row) {
            self.rows.push(row);
        }
    }

    #[test]
    fn nothing_is_wrong_in_silence() {
        let mut wrong = Vec::new();
        for study in STUDIES {
            let mut seen = Seen::default();
            study.run(Extent::Brief, &mut seen);
            assert!(seen.begun > 1 && seen.rows.len() > 1, "{}", study.name);
            let rows = seen.rows.into_iter();
            wrong.extend(rows.filter(|row| row.verdict == Verdict::Wrong));
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}
