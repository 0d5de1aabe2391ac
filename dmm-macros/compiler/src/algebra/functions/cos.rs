//! The cosine, with Δ cos u = −sin(ū) sinc(Δu/2) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};

/// cos u
pub(super) const COS: Properties = Properties {
    name: "cos",
    latex: Latex::Name(r"\cos"),
    is_declarable: true,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 1)],
    right_inverse: Some(Function::Acos),
    form: Form::Circular { is_odd: false },
    derivative: |dag, u| {
        let sine = dag.call(Function::Sin, u);
        dag.neg(sine)
    },
    difference: Difference::MinusAtMean([Function::Sin, Function::Sinc]),
    value: f64::cos,
    slope: f64::sin,
    enclosure: |u| u.around_middle(f64::cos),
    equation: Equation::Pair {
        functions: [Function::Sin, Function::Cos],
        is_negative: true,
    },
};
