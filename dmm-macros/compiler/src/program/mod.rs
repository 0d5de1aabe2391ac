//! The program: what a machine evaluates to integrate a system.
//!
//! [`Program::new`] takes a [`Scheme`] and gives its program. For every region these are
//!
//! ```text
//! f(t, x),   ψ(t, x),   Σ|terms of ψ|,   (ψ, Λ),   f^τ,   (f^τ, ∂f^τ/∂x₁),   ∂f^τ/∂t₁
//! ```
//!
//! and the recurrences of the Taylor coefficients of the solution; for the interfaces and the
//! checked conditions g, a bound of the rounding error of g, (∂ₜg, ∇g), and the recurrences of g
//! along a solution.
//!
//! A [`Function`] says by a [`Quantity`] what it computes, which nodes are its inputs, which
//! operations are evaluated in which order, and which nodes are its results. The operations are
//! [`Lowered`]: sums, products, quotients and calls of a floating-point machine, with exact
//! constants, as few of them as [`optimise`] finds. What depends on parameters alone is
//! [`Stored`]: a machine computes that once before an integration.

mod constant;
mod dynamics;
mod events;
mod forces;
mod function;
mod guards;
mod inputs;
mod lower;
mod metadata;
pub mod optimise;
mod results;
pub mod series;
mod signs;
mod size;
mod stored;

use crate::algebra::{Id, Name};
use crate::scheme::Scheme;
pub use constant::nearest_double;
pub use dynamics::Dynamics;
pub use events::Events;
pub use function::{Function, Functions, Quantity, Stage};
pub use guards::{GuardSide, Guards};
pub use inputs::{Input, Variable};
pub use lower::Lowered;
pub use metadata::{Condition, Event, Metadata, RegionMetadata};
use optimise::Optimiser;
pub use results::{Derivative, Projected, Results, Rows};
pub use series::Series;
pub use stored::Stored;

/// The program of a system.
#[derive(Debug)]
pub struct Program<'a> {
    /// What it was made from.
    pub scheme: &'a Scheme,
    /// Names, and where the regions lie.
    pub metadata: Metadata,
    /// The states, in order.
    pub states: Vec<Name>,
    /// The parameters, in order, and behind them what else is constant in a mode: see
    /// [`Model::constants`](crate::model::Model::constants).
    pub parameters: Vec<Name>,
    /// The declared values of the parameters, in the same order.
    pub defaults: Vec<DefaultValue>,
    /// The initial values of the discrete states.
    pub initial: Vec<DefaultValue>,
    /// The functions of each region, in the order of the declaration.
    pub dynamics: Vec<Dynamics>,
    /// The functions of the interfaces and the checked conditions, if there are any.
    pub guards: Option<Guards>,
    /// The functions of the events, if there are any.
    pub events: Option<Events>,
}

/// The declared value of a parameter: an expression without variables.
#[derive(Debug)]
pub struct DefaultValue {
    /// The operations.
    pub lowered: Lowered,
    /// The operations in the order in which they are evaluated.
    pub operations: Vec<Id>,
    /// The value.
    pub value: Id,
}

impl<'a> Program<'a> {
    /// The program of `scheme`, its operations optimised.
    pub fn new(scheme: &'a Scheme) -> Self {
        Self::with(scheme, &mut Optimiser::default())
    }

    /// The program of `scheme` with its operations as they are written, which optimised ones are
    /// compared with.
    pub fn as_written(scheme: &'a Scheme) -> Self {
        Self::with(scheme, &mut Optimiser::without_rules())
    }

    fn with(scheme: &'a Scheme, optimiser: &mut Optimiser) -> Self {
        let model = &scheme.model;
        let mut dag = scheme.dag().clone();
        let states = model.state_names();
        let parameters = model.parameters.iter().map(|one| one.name.clone());
        let parameters: Vec<Name> = parameters.chain(model.constants()).collect();
        let regions = 0..scheme.regions.len();
        let dynamics = regions
            .map(|region| Dynamics::new(scheme, region, &mut dag, &parameters, optimiser))
            .collect();
        let is_bounded =
            !scheme.interfaces.is_empty() || scheme.checked_conditions().next().is_some();
        let guards = is_bounded.then(|| Guards::new(scheme, &mut dag, &parameters, optimiser));
        let events = (!model.events.is_empty()).then(|| Events::new(scheme, &mut dag, &parameters));
        Self {
            defaults: model
                .parameters
                .iter()
                .map(|one| DefaultValue::new(scheme, one.default))
                .collect(),
            initial: (model.discrete.iter())
                .map(|one| DefaultValue::new(scheme, one.initial))
                .collect(),
            metadata: Metadata::new(scheme),
            scheme,
            states,
            parameters,
            dynamics,
            guards,
            events,
        }
    }
}

impl DefaultValue {
    fn new(scheme: &Scheme, default: Id) -> Self {
        let mut lowered = Lowered::new(Vec::new());
        let value = lowered.lower(scheme.dag(), default);
        Self {
            operations: lowered.order(&[value], |_| false),
            lowered,
            value,
        }
    }
}
