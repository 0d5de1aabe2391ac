//! The derivatives of a switching function, of an interface or of a condition that a run checks:
//! ∂ₜg and ∇g.

use super::degree::degree;
use crate::algebra::{Dag, Id, Name, differentiate, gradient};
use crate::model::Model;

/// Derivatives of a switching function, over `t` and the states.
#[derive(Debug)]
pub struct SwitchingScheme {
    /// ∂ₜg
    pub time_derivative: Id,
    /// ∇g
    pub gradient: Vec<Id>,
    /// Whether g does not depend on the time.
    pub autonomous: bool,
    /// The degree of g as a polynomial in t and x, if it is one.
    pub degree: Option<u32>,
}

impl SwitchingScheme {
    /// The derivatives of `function` by the time and `states`.
    pub(super) fn of(dag: &mut Dag, function: Id, states: &[Name]) -> Self {
        let arguments = [states, &[Model::time()]].concat();
        Self {
            time_derivative: differentiate(dag, function, &Model::time()),
            gradient: gradient(dag, function, states),
            autonomous: !dag.variables([function]).contains(&Model::time()),
            degree: degree(dag, [function], &arguments),
        }
    }
}
