//! What an integration did.

use std::ops::AddAssign;

/// Counters of an integration.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Statistics {
    /// Steps accepted, partial steps to and from an interface included.
    pub steps: u64,
    /// Steps that a tolerance made shorter, because they could not be made or were too long.
    pub rejected: u64,
    /// Newton iterations of the steps.
    pub newton_iterations: u64,
    /// Sweeps of the fixed-point iteration that takes the place of Newton's in short steps.
    pub sweeps: u64,
    /// Transitions of all kinds.
    pub transitions: u64,
    /// Those that crossed an interface.
    pub crossed: u64,
    /// Those at which an event changed states or discrete states.
    pub jumped: u64,
    /// Those from which on the solution slides on an interface, or on one more.
    pub began_to_slide: u64,
    /// Those at which it leaves an interface that it was sliding on.
    pub left_slide: u64,
    /// Newton iterations of the locator in time and state together.
    pub locator_iterations: u64,
    /// Crossings that the locator found by bracketing because Newton's method did not.
    pub bracketed: u64,
    /// Tangential contacts with an interface: no transition.
    pub grazes: u64,
}

impl AddAssign for Statistics {
    fn add_assign(&mut self, more: Self) {
        self.steps += more.steps;
        self.rejected += more.rejected;
        self.newton_iterations += more.newton_iterations;
        self.sweeps += more.sweeps;
        self.transitions += more.transitions;
        self.crossed += more.crossed;
        self.jumped += more.jumped;
        self.began_to_slide += more.began_to_slide;
        self.left_slide += more.left_slide;
        self.locator_iterations += more.locator_iterations;
        self.bracketed += more.bracketed;
        self.grazes += more.grazes;
    }
}
