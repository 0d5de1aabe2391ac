//! The hyperbolic tangent, with Δ tanh u = sinhc(Δu)/(cosh u₀ cosh u₁) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};
use crate::algebra::evaluate::Interval;

/// tanh u
pub(super) const TANH: Properties = Properties {
    name: "tanh",
    latex: Latex::Name(r"\tanh"),
    is_declarable: true,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: None,
    form: Form::Ratio([Function::Sinh, Function::Cosh]),
    // 1 − tanh² would cancel where tanh is close to ±1
    derivative: |dag, u| {
        let cosh = dag.call(Function::Cosh, u);
        let square = dag.powi(cosh, 2);
        let one = dag.integer(1);
        dag.div(one, square)
    },
    difference: Difference::AtEnds([Function::Cosh, Function::Sinhc]),
    value: f64::tanh,
    slope: |u| 1.0 / (u.cosh() * u.cosh()),
    enclosure,
    equation: Equation::Tangent { is_negative: true },
};

fn enclosure(u: Interval) -> Interval {
    u.rising(f64::tanh)
        .within(-1.0, 1.0)
        .without_zero(u.nonzero)
}
