//! What a numerical solution is compared with.

use thiserror::Error;

use crate::accurate::{self, Node, Stuck};
use crate::problem::Problem;
use crate::reference::{Reference, ReferenceError};

/// The exact solution as far as it is known: the start, crossings, and states in between.
#[derive(Clone, PartialEq, Debug)]
pub struct Truth {
    /// The start, then the crossings.
    pub nodes: Vec<Node>,
    /// Where the crossings are from.
    pub origin: Origin,
}

/// Where the exact solution is from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Origin {
    /// The reference data of 32 digits.
    Reference,
    /// The integrator of high order in [`accurate`].
    Accurate,
}

impl Origin {
    /// In words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Reference => "the reference data (32 digits)",
            Self::Accurate => "an extrapolation method of order 14",
        }
    }
}

/// Why there is nothing to compare with.
#[derive(Debug, Error)]
pub enum TruthError {
    /// Bad reference data.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The accurate integrator knows one interface.
    #[error(
        "the solution that is compared with crosses one interface between two regions: a system \
         with several interfaces, switches or events has none; `pws run` integrates it"
    )]
    Unknown,
    /// The accurate integrator cannot go on.
    #[error(transparent)]
    Stuck(#[from] Stuck),
}

/// Whether there is anything to compare with, beside reference data.
///
/// # Errors
/// [`TruthError::Unknown`] of a system with more than one interface, or with events.
pub fn is_known(problem: &Problem) -> Result<(), TruthError> {
    let metadata = problem.metadata();
    if metadata.interfaces.len() > 1 || metadata.has_constants() {
        return Err(TruthError::Unknown);
    }
    Ok(())
}

impl Truth {
    /// The solution from `initial` with `count` crossings, or as many as there are until
    /// `t_end`.
    ///
    /// # Errors
    /// [`TruthError`] if it cannot be computed.
    pub fn of(
        problem: &Problem,
        initial: &[f64],
        count: usize,
        t_end: f64,
    ) -> Result<Self, TruthError> {
        if problem.is_reference_run(initial)
            && let Some(reference) = Reference::of(problem)?
            && (reference.crossings.len() >= count
                || reference.crossings.len() as u64 == reference.crossings_total)
        {
            return Ok(Self::from_reference(problem, initial, &reference, count));
        }
        is_known(problem)?;
        Ok(Self {
            nodes: accurate::crossings(problem, initial, t_end, count)?,
            origin: Origin::Accurate,
        })
    }

    fn from_reference(
        problem: &Problem,
        initial: &[f64],
        reference: &Reference,
        count: usize,
    ) -> Self {
        let side = reference
            .segments
            .first()
            .map_or(1.0, |segment| segment.side);
        let region = |side: f64| problem.region_on_side(side).unwrap_or_default();
        let start = Node {
            t: 0.0,
            x: initial.to_vec(),
            region: region(side),
        };
        let crossings = reference.crossings.iter().take(count).map(|crossing| Node {
            t: crossing.t,
            x: crossing.x.clone(),
            region: region(crossing.to),
        });
        Self {
            nodes: std::iter::once(start).chain(crossings).collect(),
            origin: Origin::Reference,
        }
    }

    /// The state at `t`, which must lie in the segment that begins after `transitions`.
    ///
    /// # Errors
    /// [`TruthError`] if it cannot be computed.
    pub fn state(
        &self,
        problem: &Problem,
        transitions: usize,
        t: f64,
    ) -> Result<Vec<f64>, TruthError> {
        let node = self.nodes.get(transitions).ok_or(Stuck { t })?;
        Ok(accurate::state_at(problem, node, t)?)
    }
}
