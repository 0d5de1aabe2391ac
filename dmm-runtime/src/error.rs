//! What can stop an integration, each with the place where it did.

use thiserror::Error;

/// Why an integration stopped before its end time.
#[derive(Clone, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The input makes no sense; nothing was integrated.
    #[error("{what}: {value} ({requirement})")]
    InvalidInput {
        /// The name of the input.
        what: &'static str,
        /// What was given.
        value: String,
        /// What it has to be.
        requirement: &'static str,
    },
    /// The implicit equation of a step could not be solved.
    #[error(
        "no solution was found of the step from t = {t}, x = {x:?} in region `{region}` with step size \
         {step_size:e} (residual {residual:e} after {iterations} Newton iterations): try a smaller \
         step size"
    )]
    NewtonFailed {
        /// Start of the step.
        t: f64,
        /// State there.
        x: Vec<f64>,
        /// Step size.
        step_size: f64,
        /// Region.
        region: &'static str,
        /// Largest component of the residual.
        residual: f64,
        /// Newton iterations spent.
        iterations: u64,
    },
    /// A formula has no finite value: a logarithm of a negative number, a division by zero.
    #[error(
        "region `{region}`'s formulas have no finite value in the step from t = {t}, x = {x:?} with \
         step size {step_size:e}: the solution leaves their domain, or the step is too large"
    )]
    LeftDomain {
        /// Start of the step.
        t: f64,
        /// State there.
        x: Vec<f64>,
        /// Step size.
        step_size: f64,
        /// Region.
        region: &'static str,
    },
    /// The solution leaves the condition under which a quantity was proved to be conserved; see
    /// [`Guard`](crate::Guard). Where it may go on without the quantity, or with another one,
    /// the declaration has an interface there and a region beyond.
    #[error(
        "at t = {t}, x = {x:?} the condition {condition} fails, under which {quantity} was proved to \
         be conserved in region `{region}`: to go on, declare an interface there, and beyond it a \
         region with what is conserved there"
    )]
    ConditionFails {
        /// Time.
        t: f64,
        /// State.
        x: Vec<f64>,
        /// The condition.
        condition: &'static str,
        /// The name of the quantity, or the names of several.
        quantity: &'static str,
        /// Region.
        region: &'static str,
    },
    /// Both vector fields point at the interface, so that the solution would slide on it.
    #[error(
        "at t = {t}, x = {x:?} the vector fields of both sides point at interface `{interface}` \
         (dg/dt = {rate_from:e} in region `{from}`, {rate_to:e} in region `{to}`): the solution \
         slides along it, which is not supported"
    )]
    Sliding {
        /// Transition time.
        t: f64,
        /// Transition point.
        x: Vec<f64>,
        /// Interface.
        interface: &'static str,
        /// The region that the solution came from.
        from: &'static str,
        /// The region on the other side.
        to: &'static str,
        /// dg/dt under the field of `from`.
        rate_from: f64,
        /// dg/dt under the field of `to`.
        rate_to: f64,
    },
    /// On an interface with a vector field tangential to it: what comes next is undecided.
    #[error(
        "at t = {t}, x = {x:?} a vector field is tangential to interface `{interface}` \
         (dg/dt = {rate_from:e} in region `{from}`, {rate_to:e} in region `{to}`): the next \
         region is not determined"
    )]
    Tangential {
        /// Time.
        t: f64,
        /// State.
        x: Vec<f64>,
        /// Interface.
        interface: &'static str,
        /// One region.
        from: &'static str,
        /// The region on the other side.
        to: &'static str,
        /// dg/dt under the field of `from`.
        rate_from: f64,
        /// dg/dt under the field of `to`.
        rate_to: f64,
    },
    /// A start on an interface from which both vector fields lead away.
    #[error(
        "the start t = {t}, x = {x:?} is on interface `{interface}` and the vector fields of both \
         sides lead away from it: name the region to start in"
    )]
    AmbiguousStart {
        /// Time.
        t: f64,
        /// State.
        x: Vec<f64>,
        /// Interface.
        interface: &'static str,
    },
    /// No region has the signs of the switching functions there.
    #[error("t = {t}, x = {x:?} lies in no region")]
    NoRegion {
        /// Time.
        t: f64,
        /// State.
        x: Vec<f64>,
    },
    /// A crossing is known to be in the step but its point could not be found.
    #[error(
        "interface `{interface}` is crossed in the step from t = {t}, x = {x:?} with step size \
         {step_size:e}, but no time could be found at which its switching function is zero"
    )]
    LocationFailed {
        /// Start of the step.
        t: f64,
        /// State there.
        x: Vec<f64>,
        /// Step size.
        step_size: f64,
        /// Interface.
        interface: &'static str,
    },
    /// Whether an interface is met in a step cannot be decided.
    #[error(
        "whether interface `{interface}` is met in the step from t = {t}, x = {x:?} with step size \
         {step_size:e} cannot be decided: its switching function has no finite value there, or \
         changes its sign too often"
    )]
    Undecided {
        /// Start of the step.
        t: f64,
        /// State there.
        x: Vec<f64>,
        /// Step size.
        step_size: f64,
        /// Interface.
        interface: &'static str,
    },
    /// Transitions accumulate.
    #[error(
        "{transitions} transitions within a time of {within:e} until t = {t}, x = {x:?}, the last at \
         interface `{interface}`: they accumulate (Zeno), and what comes after is not determined"
    )]
    Zeno {
        /// Time of the last transition.
        t: f64,
        /// Point of the last transition.
        x: Vec<f64>,
        /// Interface.
        interface: &'static str,
        /// How many there were …
        transitions: u64,
        /// … within this time.
        within: f64,
    },
    /// An output was asked for at a time that was not integrated.
    #[error("no solution at t = {t}: it is known from {from} to {to}")]
    OutOfRange {
        /// The time asked for.
        t: f64,
        /// First time.
        from: f64,
        /// Last time.
        to: f64,
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
    /// The error of a step that starts at t, x.
    pub(crate) fn at<const N: usize>(
        self,
        t: f64,
        x: &crate::system::Vector<f64, N>,
        step_size: f64,
        region: &'static str,
    ) -> Error {
        let x = x.iter().copied().collect();
        match self {
            Self::NoConvergence {
                residual,
                iterations,
            } => Error::NewtonFailed {
                t,
                x,
                step_size,
                region,
                residual,
                iterations,
            },
            Self::NotFinite => Error::LeftDomain {
                t,
                x,
                step_size,
                region,
            },
        }
    }
}

/// Bad input.
pub(crate) fn invalid(
    what: &'static str,
    value: String,
    requirement: &'static str,
) -> Result<(), Error> {
    Err(Error::InvalidInput {
        what,
        value,
        requirement,
    })
}

/// A number as people write it: small and large ones with an exponent.
pub(crate) fn number(value: f64) -> String {
    match value != 0.0 && value.is_finite() && !(1e-4..1e16).contains(&value.abs()) {
        true => format!("{value:e}"),
        false => value.to_string(),
    }
}
