//! The size of a number, with Δ|u| = (u₁ + u₀)/(|u₁| + |u₀|) Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};

/// |u|
pub(super) const ABS: Properties = Properties {
    name: "abs",
    latex: Latex::Bars,
    is_declarable: false,
    domain: Domain::All,
    is_not_negative: true,
    integers: &[(0, 0)],
    right_inverse: None,
    form: Form::Size,
    derivative: |dag, u| {
        let size = dag.call(Function::Abs, u);
        dag.div(u, size)
    },
    difference: Difference::Quotient(|dag, [start, end]| {
        let sizes = [end, start].map(|u| dag.call(Function::Abs, u));
        let divisor = dag.add(sizes[0], sizes[1]);
        [dag.add(end, start), divisor]
    }),
    value: f64::abs,
    slope: |_| 1.0,
    enclosure: |u| u.size(),
    equation: Equation::Missing,
};
