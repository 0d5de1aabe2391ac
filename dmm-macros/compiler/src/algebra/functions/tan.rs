//! The tangent, with Δ tan u = sinc(Δu)/(cos u₀ cos u₁) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};

/// tan u
pub(super) const TAN: Properties = Properties {
    name: "tan",
    latex: Latex::Name(r"\tan"),
    is_declarable: true,
    domain: Domain::NonZero(Function::Cos),
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: Some(Function::Atan),
    form: Form::Ratio([Function::Sin, Function::Cos]),
    derivative: |dag, u| {
        let one = dag.integer(1);
        let tangent = dag.call(Function::Tan, u);
        let square = dag.powi(tangent, 2);
        dag.add(one, square)
    },
    difference: Difference::AtEnds([Function::Cos, Function::Sinc]),
    value: f64::tan,
    slope: |u| 1.0 + u.tan() * u.tan(),
    enclosure: |u| u.call(Function::Sin) / u.call(Function::Cos),
    equation: Equation::Tangent { is_negative: false },
};
