//! The derivatives of a switching function, of an interface or of a condition that a run checks:
//! ∂ₜg and ∇g.

use super::degree::degree;
use crate::algebra::{Dag, Id, Name};
use crate::model::Model;
use crate::proofs::Derivatives;

/// Derivatives of a switching function, over `t` and the states.
#[derive(Debug)]
pub struct SwitchingScheme {
    /// ∂ₜg and ∇g.
    pub derivatives: Derivatives,
    /// Whether g does not depend on the time.
    pub autonomous: bool,
    /// The degree of g as a polynomial in t and x, if it is one.
    pub degree: Option<u32>,
}

impl SwitchingScheme {
    /// What is known of `function` over the time and `states`, with its derivatives.
    pub(super) fn of(dag: &Dag, function: Id, derivatives: Derivatives, states: &[Name]) -> Self {
        let arguments = [states, &[Model::time()]].concat();
        Self {
            derivatives,
            autonomous: !dag.variables([function]).contains(&Model::time()),
            degree: degree(dag, [function], &arguments),
        }
    }
}
