//! The natural logarithm, with Δ ln u = ln\[u₀, u₁\] Δu.

use super::{Difference, Domain, Equation, Form, Function, Latex, Pair, PairFunction, Properties};
use crate::algebra::evaluate::{Interval, LIBRARY_STEPS};

/// ln u
pub(super) const LN: Properties = Properties {
    name: "ln",
    latex: Latex::Name(r"\ln"),
    is_declarable: true,
    domain: Domain::Positive,
    is_not_negative: false,
    integers: &[(1, 0)],
    right_inverse: Some(Function::Exp),
    form: Form::Logarithm,
    derivative: |dag, u| {
        let one = dag.integer(1);
        dag.div(one, u)
    },
    difference: Difference::Pair(PairFunction::LnDd),
    value: f64::ln,
    slope: |u| 1.0 / u,
    enclosure,
    equation: Equation::Logarithm,
};

/// ln\[a, b\]
pub(super) const PAIR: Pair = Pair {
    value: |a, b| {
        let d = b - a;
        let t = d / a;
        if t == 0.0 {
            1.0 / a
        } else if t.abs() < 0.5 {
            t.ln_1p() / d
        } else {
            (b.ln() - a.ln()) / d
        }
    },
    to_singularity: |a, b| a.abs().min(b.abs()),
    square: None,
    is_root: false,
    second: (-1, 0, 2),
};

fn enclosure(u: Interval) -> Interval {
    let inside = u.restricted(0.0, f64::INFINITY);
    let defined = inside.defined && inside.is_positive();
    Interval::new(inside.low.ln(), inside.high.ln(), defined).widened(LIBRARY_STEPS)
}
