//! The sine, with Δ sin u = cos(ū) sinc(Δu/2) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};

/// sin u
pub(super) const SIN: Properties = Properties {
    name: "sin",
    latex: Latex::Name(r"\sin"),
    is_declarable: true,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: Some(Function::Asin),
    form: Form::Circular { is_odd: true },
    derivative: |dag, u| dag.call(Function::Cos, u),
    difference: Difference::AtMean([Function::Cos, Function::Sinc]),
    value: f64::sin,
    slope: f64::cos,
    enclosure: |u| u.around_middle(f64::sin),
    equation: Equation::Pair {
        functions: [Function::Sin, Function::Cos],
        is_negative: true,
    },
};
