//! What can stop an integration: a kind, and the place where it happened.

use std::fmt;

use thiserror::Error as ThisError;

/// Why an integration stopped before its end time.
///
/// ```
/// use dmm_runtime::{Best, ErrorKind, Integrator, pws};
///
/// pws! {
///     /// A block that a wall stops.
///     pub system Block {
///         state x;
///         param forth = 1, back = -1;
///         interface wall = x;
///         region left where wall < 0 { der(x) = forth; }
///         region right where wall > 0 { der(x) = back; }
///     }
/// }
///
/// let interrupted = Integrator::new(&Block::default(), Best::tolerance(1e-12))
///     .initial(0.0, [-1.0])
///     .run_until(3.0)
///     .unwrap_err();
/// let error = interrupted.error();
/// assert!(matches!(error.kind, ErrorKind::Sliding { interface: "wall", .. }));
/// assert_eq!(error.place().map(|place| (place.t, place.region)), Some((1.0, "left")));
/// // what was computed until there is not lost
/// assert_eq!(interrupted.solution().last().map(|point| point.t), Some(1.0));
/// ```
#[derive(Clone, PartialEq)]
pub struct Error {
    /// What happened.
    pub kind: ErrorKind,
    place: Option<Box<Place>>,
}

/// Where an integration stopped: at a point, or in the step that starts there.
#[derive(Clone, PartialEq, Debug)]
pub struct Place {
    /// Time.
    pub t: f64,
    /// State.
    pub x: Vec<f64>,
    /// The region; empty where there is none.
    pub region: &'static str,
    /// The size of the step that could not be made.
    pub step_size: Option<f64>,
}

/// What stopped an integration.
#[derive(Clone, PartialEq, Debug, ThisError)]
#[non_exhaustive]
pub enum ErrorKind {
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
    /// The end time lies before the initial time.
    #[error(
        "the end time {t_end} is before the initial time {t0}: time runs forwards; to go backwards, \
         integrate `Reversed(system)` from {} to {}", 0.0 - t0, 0.0 - t_end
    )]
    BackwardTime {
        /// Initial time.
        t0: f64,
        /// End time.
        t_end: f64,
    },
    /// A slice of another length than the system has states was given as a state.
    #[error("the state has {given} entries, but the system has {states} states")]
    StateLength {
        /// How many states the system has.
        states: usize,
        /// How many entries were given.
        given: usize,
    },
    /// The implicit equation of a step could not be solved.
    #[error(
        "no solution of the step was found (residual {residual:e} after {iterations} Newton \
         iterations): try a smaller step size"
    )]
    NewtonFailed {
        /// Largest component of the residual.
        residual: f64,
        /// Newton iterations spent.
        iterations: u64,
    },
    /// A formula has no finite value: a logarithm of a negative number, a division by zero.
    #[error(
        "the formulas have no finite value in the step: the solution leaves their domain, or the \
         step is too large"
    )]
    LeftDomain,
    /// The vector field has no value at the point: a start outside its domain, or a step that led out
    /// of it.
    #[error("the vector field has no value there: {function} is not defined at u = {}", number(*argument))]
    Undefined {
        /// The function that has none, of u; of what is left of the formula when it is compiled.
        function: &'static str,
        /// u
        argument: f64,
    },
    /// The solution, or what is computed from it, grows beyond the largest double.
    #[error("overflow: the solution or what is computed from it grows beyond 1.8e308")]
    Overflow,
    /// The solution leaves the condition under which a quantity was proved to be conserved; see
    /// [`Condition`](crate::Condition). Where it may go on without the quantity, or with another
    /// one, the declaration has an interface there and a region beyond.
    #[error(
        "the condition {condition} fails, under which {quantity} was proved to be conserved: to go \
         on, declare an interface there, and beyond it a region with what is conserved there"
    )]
    ConditionFails {
        /// The condition.
        condition: &'static str,
        /// The name of the quantity, or the names of several.
        quantity: &'static str,
    },
    /// Both vector fields point at the interface, so that the solution would slide on it.
    #[error(
        "the vector fields of both sides point at interface `{interface}` (dg/dt = {rate_from:e} \
         in region `{from}`, {rate_to:e} in region `{to}`): the solution slides along it, which has \
         to be declared with the interface or the `if`, by `sliding`"
    )]
    Sliding {
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
        "a vector field is tangential to interface `{interface}` (dg/dt = {rate_from:e} in region \
         `{from}`, {rate_to:e} in region `{to}`): the next region is not determined"
    )]
    Tangential {
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
    /// At a point of interfaces from which the vector fields of several regions lead away: each of
    /// them is a solution.
    #[error(
        "the point is on {interfaces}, and the vector fields of several regions lead away from \
         it: {regions}; name the region to go on in"
    )]
    Ambiguous {
        /// The interfaces.
        interfaces: String,
        /// The regions.
        regions: String,
    },
    /// At a point of several interfaces at once none of the regions around has a vector field that
    /// leads into it.
    #[error(
        "the point is on {interfaces} at once, and no region around it has a vector field that \
         leads into it, nor is there one sliding motion: the interfaces have to be declared `sliding`, \
         and the mean of their fields has to be determined"
    )]
    Intersection {
        /// The interfaces.
        interfaces: String,
    },
    /// Events that happen at once give a state different values.
    #[error("events that happen at once give `{state}` different values")]
    Conflict {
        /// The state or discrete state.
        state: &'static str,
    },
    /// No region has the signs of the switching functions there.
    #[error("the point lies in no region")]
    NoRegion,
    /// A crossing is known to be in the step but its point could not be found.
    #[error(
        "interface `{interface}` is crossed in the step, but no time could be found at which its \
         switching function is zero"
    )]
    LocationFailed {
        /// Interface.
        interface: &'static str,
    },
    /// Whether an interface is met in a step cannot be decided.
    #[error(
        "whether interface `{interface}` is met in the step cannot be decided: its switching \
         function has no finite value there, or changes its sign too often"
    )]
    Undecided {
        /// Interface.
        interface: &'static str,
    },
    /// Transitions accumulate.
    #[error(
        "{transitions} transitions within a time of {within:e}, the last at interface \
         `{interface}`: they accumulate (Zeno), and what comes after is not determined"
    )]
    Zeno {
        /// Interface.
        interface: &'static str,
        /// How many there were …
        transitions: u64,
        /// … within this time.
        within: f64,
    },
    /// The points and transitions of a trajectory take more memory than they may.
    #[error(
        "the {points} points and {transitions} transitions up to here take all of {bytes} bytes, or \
         all that there are: keep fewer by `every` or `output_times`, watch the run by \
         `observe_until`, which keeps none, or raise `memory_limit`"
    )]
    MemoryLimit {
        /// The limit.
        bytes: usize,
        /// Points that are kept.
        points: usize,
        /// Transitions that are kept.
        transitions: usize,
    },
    /// The solution has no derivative by its initial state or by a parameter.
    #[error("there is no derivative by the initial state and the parameters: {reason}")]
    NoDerivative {
        /// Why.
        reason: &'static str,
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

impl Error {
    /// Where it happened; nothing if nothing was integrated.
    pub fn place(&self) -> Option<&Place> {
        self.place.as_deref()
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self { kind, place: None }
    }
}

impl ErrorKind {
    /// The error at a point of a region.
    #[cold]
    pub(crate) fn at(self, t: f64, x: &[f64], region: &'static str) -> Error {
        let place = Place {
            t,
            x: x.to_vec(),
            region,
            step_size: None,
        };
        Error {
            kind: self,
            place: Some(Box::new(place)),
        }
    }
}

impl Error {
    /// The same of the first states alone: there may have been room for more.
    #[cold]
    pub(crate) fn with_states(mut self, states: usize) -> Self {
        if let Some(place) = &mut self.place {
            place.x.truncate(states);
        }
        self
    }

    /// The same in a region.
    #[cold]
    pub(crate) fn in_region(mut self, region: &'static str) -> Self {
        if let Some(place) = &mut self.place {
            place.region = region;
        }
        self
    }

    /// The same in a step that starts there.
    #[cold]
    pub(crate) fn in_step(mut self, step_size: f64) -> Self {
        if let Some(place) = &mut self.place {
            place.step_size = Some(step_size);
        }
        self
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x: Vec<String> = self.x.iter().copied().map(number).collect();
        write!(f, "t = {}, x = [{}]", number(self.t), x.join(", "))?;
        if !self.region.is_empty() {
            write!(f, " in region `{}`", self.region)?;
        }
        match self.step_size {
            Some(step_size) => write!(f, " with step size {step_size:e}"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Some(place) => write!(f, "at {place}: {}", self.kind),
            None => self.kind.fmt(f),
        }
    }
}

/// As text, like [`Display`](fmt::Display): what a `main` returns is printed so. The fields are
/// printed by `{:#?}`.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fmt_as_text_or(f, |f| {
            f.debug_struct("Error")
                .field("kind", &self.kind)
                .field("place", &self.place)
                .finish()
        })
    }
}

impl Error {
    /// The text, or `fields` where `{:#?}` asks for them.
    pub(crate) fn fmt_as_text_or(
        &self,
        f: &mut fmt::Formatter<'_>,
        fields: impl FnOnce(&mut fmt::Formatter<'_>) -> fmt::Result,
    ) -> fmt::Result {
        if f.alternate() {
            fields(f)
        } else {
            fmt::Display::fmt(self, f)
        }
    }
}

impl std::error::Error for Error {}

/// Bad input.
pub(crate) fn invalid(
    what: &'static str,
    value: String,
    requirement: &'static str,
) -> Result<(), Error> {
    Err(ErrorKind::InvalidInput {
        what,
        value,
        requirement,
    }
    .into())
}

/// A number as people write it: small and large ones with an exponent.
pub(crate) fn number(value: f64) -> String {
    if value != 0.0 && value.is_finite() && !(1e-4..1e16).contains(&value.abs()) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}
