//! The square root √u, with Δ√u = Δu/(√u₁ + √u₀).

use super::{Difference, Domain, Equation, Form, Latex, Properties};
use crate::algebra::evaluate::Interval;

/// √u
pub(super) const SQRT: Properties = Properties {
    name: "sqrt",
    latex: Latex::Root,
    is_declarable: true,
    domain: Domain::NotNegative,
    is_not_negative: true,
    integers: &[(0, 0), (1, 1)],
    right_inverse: None,
    form: Form::Root,
    derivative: |dag, u| {
        let [half, root] = [dag.fraction(1, 2), dag.sqrt(u)];
        dag.div(half, root)
    },
    difference: Difference::Quotient(|dag, ends| {
        let [start, end] = ends.map(|u| dag.sqrt(u));
        let sum = dag.add(end, start);
        [dag.integer(1), sum]
    }),
    value: f64::sqrt,
    slope: |u| 0.5 / u.sqrt(),
    enclosure,
    equation: Equation::Root,
};

fn enclosure(u: Interval) -> Interval {
    let inside = u.restricted(0.0, f64::INFINITY);
    Interval::new(inside.low.sqrt(), inside.high.sqrt(), inside.defined)
        .widened(1)
        .above(0.0)
        .without_zero(inside.nonzero)
}
