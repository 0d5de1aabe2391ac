//! The hyperbolic cosine, with Δ cosh u = sinh(ū) sinhc(Δu/2) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};

/// cosh u
pub(super) const COSH: Properties = Properties {
    name: "cosh",
    latex: Latex::Name(r"\cosh"),
    is_declarable: true,
    domain: Domain::All,
    is_not_negative: true,
    integers: &[(0, 1)],
    right_inverse: None,
    form: Form::Hyperbolic { is_odd: false },
    derivative: |dag, u| dag.call(Function::Sinh, u),
    difference: Difference::AtMean([Function::Sinh, Function::Sinhc]),
    value: f64::cosh,
    slope: f64::sinh,
    enclosure: |u| u.size().rising(f64::cosh).above(1.0),
    equation: Equation::Pair {
        functions: [Function::Sinh, Function::Cosh],
        is_negative: false,
    },
};
