//! The hyperbolic sine, with Δ sinh u = cosh(ū) sinhc(Δu/2) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};

/// sinh u
pub(super) const SINH: Properties = Properties {
    name: "sinh",
    latex: Latex::Name(r"\sinh"),
    is_declarable: true,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: None,
    form: Form::Hyperbolic { is_odd: true },
    derivative: |dag, u| dag.call(Function::Cosh, u),
    difference: Difference::AtMean([Function::Cosh, Function::Sinhc]),
    value: f64::sinh,
    slope: f64::cosh,
    enclosure: |u| u.rising(f64::sinh).without_zero(u.nonzero),
    equation: Equation::Pair {
        functions: [Function::Sinh, Function::Cosh],
        is_negative: false,
    },
};
