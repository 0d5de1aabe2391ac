//! Conservative integration of piecewise-smooth systems.
//!
//! A system ẋ = fᵣ(t, x) on regions r, the sign patterns of switching functions g(t, x), with
//! quantities ψᵣ(t, x) that each field conserves, is declared with [`pws!`]. The macro proves
//! the conservation and derives the scheme; this crate holds what does not depend on the
//! system: the solve, the transitions, the levels of ψ, output.
//!
//! ```
//! use dmm_runtime::{Best, Integrator, System, pws};
//!
//! pws! {
//!     /// A mass on a spring that is k times as stiff where x < 0.
//!     pub system Spring {
//!         state x, v;
//!         param k = 3;
//!         interface middle = x;
//!         der(x) = v;
//!         region right where middle > 0 {
//!             der(v) = -x;
//!             conserved energy = (v^2 + x^2) / 2;
//!         }
//!         region left where middle < 0 {
//!             der(v) = -k * x;
//!             conserved energy = (v^2 + k * x^2) / 2;
//!         }
//!     }
//! }
//!
//! let spring = Spring::default();
//! let solution = Integrator::new(&spring, Best::tolerance(1e-12))
//!     .initial(0.0, [1.0, 0.0])
//!     .run_until(100.0)?;
//! let first = &solution.transitions()[0];
//! assert_eq!((first.from, first.to), (SpringRegion::Right, SpringRegion::Left));
//! assert!((first.t - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
//!
//! let end = solution.last().ok_or("no solution")?;
//! let energy = spring.conserved(end.region, end.t, &end.x)[0];
//! assert!((energy - 0.5).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to | use |
//! |---|---|
//! | declare a system | [`pws!`] |
//! | integrate it | [`Integrator`] with a [`Method`]: [`Best`], unless another one is meant |
//! | choose a method by name | [`Taylor`], [`Symmetric`], [`Composed`], [`RungeKutta`], [`EmbeddedRungeKutta`] |
//! | go step by step, stop, change, go on | [`Stepper`] |
//! | look at the result | [`Solution`]: points, [`Transition`]s, [`Statistics`], [`Solution::at`] |
//! | write it to files | [`Solution::write_csv`], [`Solution::write_transitions_csv`] |
//! | see how a common task is done | the [`guide`] |
//! | keep some of its points only | [`Recording`] |
//! | watch a long run in constant memory | [`on_point`], [`on_transition`], [`progress`], [`Observer`]; [`End`], [`Halted`] |
//! | go backwards in time | [`Reversed`] |
//! | integrate many initial states and parameters | [`Ensemble`] |
//! | evaluate f, g and ψ at a point | [`System::vector_field`], [`System::switching_function`], [`System::conserved`] |
//! | choose systems and methods at run time | [`dynamic`] |
//! | compile a declaration at run time | `Model`, with the feature `model` |
//! | replace the search for crossings of one-step methods | [`Locator`] |
//! | write a one-step method | [`OneStep`] in [`Uniform`] or [`Adaptive`] steps, [`Dynamics`] |
//!
//! # Words
//!
//! | word | meaning |
//! |---|---|
//! | region, interface | where one vector field f holds; the zero set of a switching function g |
//! | mode | what a run is in: a region, with what is constant between events ([`Mode`]). It is explicit state, never read off the sign of g |
//! | event | a change of states in an instant, where an interface is crossed or at a time |
//! | dynamics | what is derived for a mode: f, ψ, Λ, f^τ with its Jacobian, recurrences ([`Dynamics`]) |
//! | guard | a function whose zero ends a mode: g of an interface, a rate at which a solution leaves the interface that it slides on, or the [`Condition`] of a proof ([`Guards`]) |
//! | transition | crossing an interface, at (t̂*, x̂*), an event there, or where sliding begins or ends |
//! | sliding | motion along an interface that the fields of both sides point at |
//! | method | what moves the state through one mode ([`Method`]) |
//! | metadata | the names in a system, and where its regions lie ([`Metadata`]) |
//! | driver | what goes from mode to mode ([`Integrator`], [`Stepper`]) |
//! | level | ψ_ref, the values of ψ at the entry into a mode |
//!
//! A transition is what other libraries call an event.
//!
//! # Where a solution meets interfaces
//!
//! One rule for each case, the same for every method; [`rules`] has them beside what is common
//! elsewhere, with their tests.
//!
//! | case | what happens |
//! |---|---|
//! | one interface, crossed | a transition at (t̂*, x̂*), once; x̂* belongs to the region entered, whatever rounding did |
//! | several interfaces at once | the region is entered whose own field leads into it at each of them; the order of declaration means nothing |
//! | a crossing at the end of a step, at an output time or at the end time | steps are half-open, (t_k, t_{k+1}]: it is a transition there, once |
//! | two crossings in a step | both are found, or the run ends as [`ErrorKind::Undecided`] |
//! | a touch | none, counted by [`Statistics::grazes`] |
//! | a start on an interface | the region that its fields lead into; ambiguous where several do ([`ErrorKind::Ambiguous`]), until [one is named](InitialValueProblem::region) |
//! | the fields of both sides point at the interface, which is declared `sliding` | the solution slides along the mean of the fields, to where one of them points away ([`TransitionKind::BeganToSlide`], [`TransitionKind::LeftSlide`]) |
//! | … and is not declared so | [`ErrorKind::Sliding`] with both rates |
//! | several sliding interfaces at once | the one choice, of a side or of sliding for each of them, that all fields fit to; several are [`ErrorKind::Ambiguous`], none is [`ErrorKind::Intersection`] |
//! | a field is tangential to the interface | [`ErrorKind::Tangential`] |
//! | an event | states and discrete states change, the mode behind it is decided as at a start, and it does not happen again at the point it has led to |
//! | events at once | all see the values before; what contradicts itself is [`ErrorKind::Conflict`] |
//! | an event at a time | met at the double nearest to it |
//! | an event that stops what moves g | the solution rests on the interface, on the side that it came from |
//! | transitions that accumulate | [`ErrorKind::Zeno`], with the solution up to there |
//! | backwards in time | [`Reversed`]; a system with events or sliding is refused |
//!
//! # The methods
//!
//! [`Best`] takes the best that each region allows: its exact flow, where f and the switching
//! functions are affine with constant coefficients, and [`Taylor`]'s method to a tolerance
//! elsewhere. The other methods are there by name.
//!
//! One step of [`Symmetric`], of order 2, solves x₁ = x₀ + τ f^τ(t₀, x₀, t₁, x₁) with a discrete
//! vector field f^τ for which Λ^τ f^τ + ∂ₜ^τψ = 0, where the discrete multiplier telescopes,
//! Λ^τ Δx + ∂ₜ^τψ Δt = Δψ: so ψ is the same at both ends (Wan, Bihlo & Nave, SIAM J. Numer. Anal.
//! 55, 2017). A step that meets an interface is split at (t̂*, x̂*) with x̂* = x_k + (t̂* − t_k) f^τ
//! and g = 0 (Hirani, Wan & Wojtalewicz, Algorithm 2.1), which keeps the order.
//! [`Composed`] makes steps of order 4, 6 and 8 of it.
//!
//! [`RungeKutta`] has the classical families, explicit and implicit, in uniform steps,
//! [`EmbeddedRungeKutta`] those with an estimate of their error, in steps by it; Radau IIA is for
//! stiff regions. They keep ψ by a correction after each step.
//!
//! [`Taylor`] takes the discrete vector field in minimal-norm form instead, with a Taylor
//! polynomial of high order for its mean field and steps as long as a tolerance allows.
//!
//! # Every crossing
//!
//! Between two points of a trajectory the sign of every switching function g is *certain*. A step
//! has a dense output, a polynomial x(t). On it g is enclosed, by interval arithmetic on what
//! [`pws!`] emits, and the step is looked at in ever shorter parts until each of them has no zero
//! of g, or one. Where that is not possible, because g has no finite value or changes its sign
//! without end, the run ends with [`ErrorKind::Undecided`]. What comes to zero within rounding errors
//! and returns is a touch, which is no transition; [`Statistics::grazes`] counts them.
//!
//! | g | how it is told |
//! |---|---|
//! | affine, or a polynomial in t and x of degree 4 at most | by values and slopes at the ends of a step and a bound of the rest: at no cost that can be measured |
//! | any other | by enclosures |
//!
//! | scheme | dense output |
//! |---|---|
//! | [`Taylor`] | the Taylor polynomial of the step |
//! | exact flow in [`Best`] | the flow itself; g is affine there |
//! | [`Symmetric`], [`Composed`] by a tolerance | the Taylor polynomial of order p + 1, led to the end of the step |
//! | Radau IIA in [`EmbeddedRungeKutta`] | the collocation polynomial, of degree s |
//! | Dormand & Prince in [`EmbeddedRungeKutta`] | its continuous extension, of order 4 |
//! | [`Symmetric`], [`Composed`], [`RungeKutta`] with uniform steps | the cubic through the ends of the step |
//!
//! With uniform steps the solution is only as good as the steps. A switching function that waves
//! many times in a step is met at every zero along the cubic; what the *state* does within a step
//! that is longer than a part of its period is not in the cubic, nor anywhere else. Where the steps
//! do resolve the state (f changes by less than half of its size in one), or g is affine, a step
//! is looked at where g comes nearer to zero than half of what it changes by in this step and the
//! one before.
//!
//! # Derivatives
//!
//! [`Solution::sensitivities`] gives the derivatives of a solution by its initial state and by the
//! parameters: those of the steps that were made, through transitions of every kind.
//! [`Solution::second_sensitivities`] gives the second derivatives as well, and
//! [`Solution::gradients`] those of a few numbers, by the adjoint: where there are many parameters.
//!
//! # Conservation for ever
//!
//! Increments are added to a compensated state, and the level of ψ at the entry into a region
//! is kept: after any number of steps |ψ − ψ_ref| is a few units in the last place of ψ's
//! terms.
#![deny(missing_docs)]

mod arithmetic;
mod contract;
mod driver;
pub mod dynamic;
mod ensemble;
mod error;
mod events;
mod expansion;
pub mod guide;
mod language;
mod level;
mod method;
#[cfg(feature = "model")]
mod model;
mod output;
pub mod rules;
mod sensitivity;
pub mod series;
pub mod special;
#[doc(hidden)]
pub mod support;
#[cfg(feature = "model")]
mod tape;

pub use arithmetic::{Matrix, MinimalNorm, Scalar, State, Time, Vector};
pub use contract::{
    Condition, Dynamics, DynamicsVisitor, Event, Guards, InitialState, Metadata, Mode, NoGuards,
    RegionMetadata, Reversed, Side, SlideEnd, Solvability, System,
};
pub use driver::{InitialValueProblem, Integrator, Recording, Stepped, Stepper};
pub use ensemble::{Ensemble, Member, Outcome};
pub use error::{Error, ErrorKind, Place};
pub use method::best::Best;
pub use method::one_step::{
    Adaptive, Composed, Composition, Correction, Crossing, EmbeddedRungeKutta, ErrorEstimate,
    Located, Locator, NewtonLocator, OneStep, RungeKutta, Step, SubSteps, Symmetric,
    TaylorCoefficients, Uniform,
};
pub use method::taylor::Taylor;
pub use method::{Method, Statistics, StepFailure, Variation};
#[cfg(feature = "model")]
pub use model::{Model, ModelError, ModelVisitor};
/// The vectors and matrices of states: [`Vector`] and [`Matrix`] are its.
pub use nalgebra;
pub use output::{
    End, EndedBy, Halted, Interrupted, IntoControlFlow, Observer, OnPoint, OnTransition, Point,
    Progress, Solution, Transition, TransitionKind, on_point, on_transition, progress,
};
pub use sensitivity::{
    Functional, Gradient, Hessians, SecondSensitivities, Sensitivities, Sensitivity,
    TransitionHessians, TransitionSensitivity,
};
