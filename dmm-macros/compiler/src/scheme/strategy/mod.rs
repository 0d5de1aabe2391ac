//! Strategies: how the discrete vector field f^τ is made from Λ^τ. They are tried from the most
//! to the least explicit, and the first that fits is taken.

pub(super) mod cross_product;
pub(super) mod minimal_norm;
mod regularity;
pub(super) mod skew_pairing;

use crate::algebra::{Dag, Id, Name, at_midpoint, differentiate, is_proved_zero, jacobian};
use crate::model::Model;

/// How the discrete vector field f^τ is made from Λ^τ (Wan, Bihlo & Nave 2017).
#[derive(Debug)]
pub enum Strategy {
    /// No conserved quantity: f at the midpoint.
    Midpoint {
        /// f^τ and its derivatives.
        field: Explicit,
    },
    /// f^τᵢ = α Λ^τⱼ, f^τⱼ = −α Λ^τᵢ on pairs of states.
    SkewPairing {
        /// The pairs (i, j) with the exact factor α.
        pairs: Vec<Pairing>,
        /// The states that ψ does not depend on, or that do not move: f at the midpoint.
        alone: Vec<usize>,
        /// f^τ and its derivatives.
        field: Explicit,
    },
    /// f^τ = α · (generalised cross product of the rows of Λ^τ).
    CrossProduct {
        /// α at (t, x).
        alpha: Id,
        /// f^τ and its derivatives.
        field: Explicit,
    },
    /// f^τ = f̄ − Λ^τᵀ λ, (Λ^τΛ^τᵀ) λ = Λ^τ f̄ + ∂ₜ^τψ, the small system solved at run time.
    MinimalNorm {
        /// f̄ and its derivatives.
        mean: Explicit,
        /// The variables λ that the derivatives below are taken with, M.
        lambda: Vec<Name>,
        /// The variables w = f^τ that the derivatives below are taken with, N.
        field: Vec<Name>,
        /// ∂(Λ^τᵀ λ)/∂x₁ at constant λ, N×N.
        transposed_jacobian: Vec<Vec<Id>>,
        /// ∂(Λ^τᵀ λ)/∂t₁ at constant λ, N.
        transposed_time_derivative: Vec<Id>,
        /// ∂(Λ^τ w + ∂ₜ^τψ)/∂x₁ at constant w, M×N.
        constraint_jacobian: Vec<Vec<Id>>,
        /// ∂(Λ^τ w + ∂ₜ^τψ)/∂t₁ at constant w, M.
        constraint_time_derivative: Vec<Id>,
    },
}

/// A pair of states (i, j) and α with fᵢ = α ∂ⱼψ, fⱼ = −α ∂ᵢψ.
#[derive(Debug, Clone, PartialEq)]
pub struct Pairing {
    /// i
    pub first: usize,
    /// j
    pub second: usize,
    /// α over `t` and the states.
    pub alpha: Id,
}

/// A field over the two ends of a step with its derivatives in the later end.
#[derive(Debug)]
pub struct Explicit {
    /// The field, N.
    pub value: Vec<Id>,
    /// ∂/∂x₁, N×N.
    pub jacobian: Vec<Vec<Id>>,
    /// ∂/∂t₁, N.
    pub time_derivative: Vec<Id>,
}

impl Explicit {
    /// `value` with its derivatives in the later end of the step.
    fn new(dag: &mut Dag, value: Vec<Id>, states: &[Name]) -> Self {
        let ends: Vec<Name> = states.iter().map(Name::at_end).collect();
        let end_time = Model::time().at_end();
        Self {
            jacobian: jacobian(dag, &value, &ends),
            time_derivative: value
                .iter()
                .map(|&component| differentiate(dag, component, &end_time))
                .collect(),
            value,
        }
    }
}

/// A strategy that was tried and does not fit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Which.
    pub strategy: Conditional,
    /// Why it does not fit.
    pub obstacle: Obstacle,
}

/// The strategies that do not always fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Conditional {
    /// [`Strategy::SkewPairing`]
    SkewPairing,
    /// [`Strategy::CrossProduct`]
    CrossProduct,
}

/// Why a strategy does not fit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Obstacle {
    /// The number M of conserved quantities in N states is not the one that it takes.
    Count {
        /// N
        states: usize,
        /// M
        conserved: usize,
    },
    /// The minors of so many conserved quantities cost more than the minimal-norm solve.
    Cost {
        /// M
        conserved: usize,
    },
    /// ψ depends on the time.
    Time,
    /// The states do not fall into pairs with fᵢ ∂ᵢψ + fⱼ ∂ⱼψ = 0.
    NoPairs,
    /// The conserved quantities are dependent everywhere.
    Dependent,
    /// f is not proved to be parallel to the cross product of ∇ψ.
    NotParallel,
    /// α as this quotient has no normal form.
    NoNormalForm {
        /// The numerator.
        numerator: Id,
        /// The denominator.
        denominator: Id,
    },
    /// α has this denominator over `t` and the states, which can vanish where f and ∇ψ are
    /// finite. Where it does and f does not, the gradients ∇ψ vanish or are dependent.
    Denominator(Id),
}

/// What a strategy is made from in one region.
pub(super) struct Context<'a> {
    /// The states, N.
    pub(super) states: &'a [Name],
    /// f, N.
    pub(super) field: &'a [Id],
    /// f at the midpoint (t̄, x̄), N.
    pub(super) mean: &'a [Id],
    /// Λ = ∇ψ, M×N.
    pub(super) multiplier: &'a [Vec<Id>],
    /// ∂ₜψ, M.
    pub(super) time_derivative: &'a [Id],
    /// Λ^τ, M×N.
    pub(super) discrete_multiplier: &'a [Vec<Id>],
    /// ∂ₜ^τψ, M.
    pub(super) discrete_time_derivative: &'a [Id],
    /// The canonical pairs (q, p) of a Hamiltonian.
    pub(super) canonical: &'a [(usize, usize)],
    /// Whether a row of Λ may be zero, of a switch that does not slide.
    pub(super) may_vanish: bool,
}

impl Context<'_> {
    fn wrong_count(&self) -> Obstacle {
        Obstacle::Count {
            states: self.states.len(),
            conserved: self.multiplier.len(),
        }
    }

    /// Whether one ψ is not proved to be free of the time.
    fn depends_on_time(&self, dag: &Dag) -> bool {
        let mut rates = self.time_derivative.iter();
        rates.any(|&by_time| !is_proved_zero(dag, by_time))
    }
}

/// The first strategy that fits, with the reasons against those before it.
pub(super) fn choose(dag: &mut Dag, context: &Context<'_>) -> (Strategy, Vec<Refusal>) {
    if context.multiplier.is_empty() {
        let field = Explicit::new(dag, context.mean.to_vec(), context.states);
        return (Strategy::Midpoint { field }, Vec::new());
    }
    let mut refusals = Vec::new();
    if context.may_vanish {
        return (minimal_norm::derive(dag, context), refusals);
    }
    for strategy in [Conditional::SkewPairing, Conditional::CrossProduct] {
        let derived = match strategy {
            Conditional::SkewPairing => skew_pairing::derive(dag, context),
            Conditional::CrossProduct => cross_product::derive(dag, context),
        };
        match derived {
            Ok(derived) => return (derived, refusals),
            Err(obstacle) => refusals.push(Refusal { strategy, obstacle }),
        }
    }
    (minimal_norm::derive(dag, context), refusals)
}

/// The value of `root` at the midpoint ((t₀+t₁)/2, (x₀+x₁)/2) of a step.
pub(super) fn midpoint(dag: &mut Dag, root: Id, states: &[Name]) -> Id {
    if dag.as_constant(root).is_some() {
        return root;
    }
    let mut names = states.to_vec();
    names.push(Model::time());
    at_midpoint(dag, root, &names)
}
