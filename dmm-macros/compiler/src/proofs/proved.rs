//! What the proofs give: the model, with what is known of its conserved quantities and
//! interfaces.

use super::Rate;
use crate::algebra::{Dag, Id, Name, differentiate, gradient, to_text};
use crate::model::Model;

/// A model that is proved to hold what it declares.
#[derive(Debug)]
pub struct Proved {
    /// The model. All nodes below are those of its DAG.
    pub model: Model,
    /// By interface, in the order of [`Model::interfaces`].
    pub interfaces: Vec<ProvedInterface>,
    /// By region, in the order of [`Model::regions`].
    pub regions: Vec<ProvedRegion>,
}

impl Proved {
    /// The interfaces of region number `region` whose switching function is proved to be constant
    /// along its flow, as indices in [`Model::interfaces`]: the flow never crosses them.
    pub fn levels(&self, region: usize) -> Vec<usize> {
        let is_level = |interface: &usize| {
            let known = self.interfaces.get(*interface);
            known.is_some_and(|known| known.rates.get(region) == Some(&Rate::Zero))
        };
        let sides = self.model.regions.get(region).map(|region| &region.sides);
        let sides = sides.into_iter().flatten();
        sides.map(|side| side.interface).filter(is_level).collect()
    }
}

/// What is known of an interface.
#[derive(Debug)]
pub struct ProvedInterface {
    /// ∂ₜg and ∇g.
    pub derivatives: Derivatives,
    /// By region, what is known of ∂ₜg + ∇g·f.
    pub rates: Vec<Rate>,
}

/// What is known of a region.
#[derive(Debug)]
pub struct ProvedRegion {
    /// Λ = ∇ψ, M×N, over `t` and the states.
    pub multiplier: Vec<Vec<Id>>,
    /// ∂ₜψ, M, over `t` and the states.
    pub time_derivative: Vec<Id>,
    /// Why each ψ is conserved, M.
    pub evidence: Vec<Conservation>,
    /// What is known of the rank of Λ.
    pub independence: Independence,
}

/// The derivatives of a function u over `t` and the states.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Derivatives {
    /// ∇u
    pub gradient: Vec<Id>,
    /// ∂ₜu
    pub time_derivative: Id,
}

impl Derivatives {
    /// The derivatives of `root` by the time and `states`.
    pub(crate) fn of(dag: &mut Dag, root: Id, states: &[Name]) -> Self {
        Self {
            gradient: gradient(dag, root, states),
            time_derivative: differentiate(dag, root, &Model::time()),
        }
    }

    /// ∂ₜu + ∇u·f
    pub(super) fn rate(&self, dag: &mut Dag, field: &[Id]) -> Id {
        let mut terms = vec![self.time_derivative];
        for (&slope, &component) in self.gradient.iter().zip(field) {
            terms.push(dag.mul(slope, component));
        }
        dag.sum(terms)
    }
}

/// Why a quantity is conserved.
#[derive(Debug, Clone, PartialEq)]
pub enum Conservation {
    /// ∂ₜψ + ∇ψ·f = 0 was proved, wherever the conditions hold.
    Proved(Vec<DomainCondition>),
    /// It is a Hamiltonian without explicit time, and f was made from it; or f is a mean of fields that
    /// conserve it.
    ByConstruction,
    /// It could not be proved, and `assume` accepts it.
    Assumed {
        /// The number of points at which ∂ₜψ + ∇ψ·f was evaluated.
        points: usize,
        /// The largest |∂ₜψ + ∇ψ·f| there, relative to the size of its terms.
        largest: f64,
    },
}

/// What has to hold for a proof to hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum DomainCondition {
    /// u > 0
    Positive(Id),
    /// u ≥ 0
    NotNegative(Id),
    /// u ≠ 0
    NonZero(Id),
    /// −1 ≤ u ≤ 1
    WithinOne(Id),
}

impl DomainCondition {
    /// As text: `x > 0`
    pub fn statement(self, dag: &Dag) -> String {
        match self {
            Self::Positive(u) => format!("{} > 0", to_text(dag, u)),
            Self::NotNegative(u) => format!("{} ≥ 0", to_text(dag, u)),
            Self::NonZero(u) => format!("{} ≠ 0", to_text(dag, u)),
            Self::WithinOne(u) => format!("|{}| ≤ 1", to_text(dag, u)),
        }
    }
}

/// What is known of the independence of the ψ of a region, the rank of Λ = ∇ψ.
#[derive(Debug, Clone, PartialEq)]
pub enum Independence {
    /// It could not be decided.
    Undecided,
    /// The gradients are dependent exactly where every one of `factors` and `minors` says so:
    /// each M×M minor of Λ is the product of the common `factors` and of one of `minors`, so
    /// that the rank falls where a factor is zero, or all of `minors` are.
    Proved {
        /// The common factors that can vanish.
        factors: Vec<Id>,
        /// The cofactors, without those that are identically zero; empty if one of them is a
        /// constant.
        minors: Vec<Id>,
    },
    /// A minor is not zero at a point, so that the rank is M at generic points; the set where
    /// it falls was not found.
    Generic,
}
