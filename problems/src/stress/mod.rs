//! Stress: runs at the edge of what a scheme can do. What survives keeps what it promises, what
//! cannot be integrated is refused by a typed error, and nothing is wrong in silence.
//!
//! One file a study, each a function that makes its runs, judges them by bounds with a reason,
//! and draws what it saw.

mod failures;
mod long;
mod report;
mod scales;
mod setting;
mod step_sizes;
mod stiffness;
mod systems;
mod tangency;
mod transitions;

pub use report::{Extent, Observe, Row, Verdict, kind_of};

use dmm_picture::Panel;

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
        title: "failures of formulas",
        study: failures::study,
    },
];
