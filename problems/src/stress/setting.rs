//! The schemes that a study compares, each at its step size or tolerance.

use crate::method::{Control, MethodName};
use crate::problem::{Problem, Run};

/// A scheme at a setting.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    pub(super) name: &'static str,
    pub(super) method: MethodName,
    pub(super) step_size: f64,
    pub(super) tolerance: f64,
}

impl Setting {
    /// A scheme with uniform steps.
    pub(super) const fn steps(name: &'static str, method: MethodName, step_size: f64) -> Self {
        Self {
            name,
            method,
            step_size,
            tolerance: f64::NAN,
        }
    }

    /// A scheme that chooses its steps.
    pub(super) const fn tolerance(name: &'static str, method: MethodName, tolerance: f64) -> Self {
        Self {
            name,
            method,
            // for runs whose length is given in steps
            step_size: 1.0,
            tolerance,
        }
    }

    pub(super) fn has_uniform_steps(&self) -> bool {
        matches!(self.method.control(), Control::StepSize { .. })
    }

    /// The default run of a problem at this setting.
    pub(super) fn run(&self, problem: &Problem) -> Run {
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
pub(super) const SETTINGS: [Setting; 9] = [
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
