//! The arc sine, with Δ asin u = asin\[u₀, u₁\] Δu.

use super::atan::quotient;
use super::{Difference, Domain, Equation, Form, Latex, Pair, PairFunction, Properties};
use crate::algebra::evaluate::Interval;

/// asin u
pub(super) const ASIN: Properties = Properties {
    name: "asin",
    latex: Latex::Name(r"\arcsin"),
    is_declarable: true,
    domain: Domain::WithinOne,
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: None,
    form: Form::Arc,
    derivative: |dag, u| {
        let one = dag.integer(1);
        let square = dag.powi(u, 2);
        let difference = dag.sub(one, square);
        let root = dag.sqrt(difference);
        dag.div(one, root)
    },
    difference: Difference::Pair(PairFunction::AsinDd),
    value: f64::asin,
    slope: |u| 1.0 / (1.0 - u * u).sqrt(),
    enclosure,
    equation: Equation::ArcSine { is_negative: false },
};

/// asin\[a, b\], from tan((β − α)/2) = (sin β − sin α)/(cos β + cos α)
pub(super) const PAIR: Pair = Pair {
    value: |a, b| {
        let cosines = (1.0 - a * a).sqrt() + (1.0 - b * b).sqrt();
        2.0 / cosines * quotient((b - a) / cosines)
    },
    to_singularity: |a, b| 1.0 - a.abs().max(b.abs()),
    square: Some(-1),
    is_root: true,
    second: (1, 1, 3),
};

fn enclosure(u: Interval) -> Interval {
    let inside = u.restricted(-1.0, 1.0);
    inside.rising(f64::asin).without_zero(inside.nonzero)
}
