//! The exponential function eᵘ, with Δeᵘ = exp(ū) sinhc(Δu/2) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};
use crate::algebra::evaluate::{Interval, LIBRARY_STEPS};

/// eᵘ
pub(super) const EXP: Properties = Properties {
    name: "exp",
    latex: Latex::Name(r"\exp"),
    is_declarable: true,
    domain: Domain::All,
    is_not_negative: true,
    integers: &[(0, 1)],
    right_inverse: Some(Function::Ln),
    form: Form::Exponential,
    derivative: |dag, u| dag.call(Function::Exp, u),
    difference: Difference::AtMean([Function::Exp, Function::Sinhc]),
    value: f64::exp,
    slope: f64::exp,
    enclosure,
    equation: Equation::Exponential,
};

fn enclosure(u: Interval) -> Interval {
    Interval::new(u.low.exp(), u.high.exp(), u.defined)
        .widened(LIBRARY_STEPS)
        .above(0.0)
        .without_zero(true)
}
