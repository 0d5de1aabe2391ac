//! The arc cosine π/2 − asin u, with Δ acos u = −asin\[u₀, u₁\] Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, PairFunction, Properties};
use crate::algebra::evaluate::Interval;

/// acos u
pub(super) const ACOS: Properties = Properties {
    name: "acos",
    latex: Latex::Name(r"\arccos"),
    is_declarable: true,
    domain: Domain::WithinOne,
    is_not_negative: false,
    integers: &[],
    right_inverse: None,
    form: Form::Complement(Function::Asin),
    derivative: |dag, u| {
        let of_asin = Function::Asin.derivative(dag, u);
        dag.neg(of_asin)
    },
    difference: Difference::MinusPair(PairFunction::AsinDd),
    value: f64::acos,
    slope: |u| 1.0 / (1.0 - u * u).sqrt(),
    enclosure,
    equation: Equation::ArcSine { is_negative: true },
};

fn enclosure(u: Interval) -> Interval {
    let inside = u.restricted(-1.0, 1.0);
    (-inside).rising(|u| (-u).acos()).above(0.0)
}
