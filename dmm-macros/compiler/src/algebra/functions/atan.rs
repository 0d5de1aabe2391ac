//! The arc tangent, with Δ atan u = atan\[u₀, u₁\] Δu.

use super::{Difference, Domain, Equation, Form, Latex, Pair, PairFunction, Properties};

/// atan u
pub(super) const ATAN: Properties = Properties {
    name: "atan",
    latex: Latex::Name(r"\arctan"),
    is_declarable: true,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: None,
    form: Form::Arc,
    derivative: |dag, u| {
        let one = dag.integer(1);
        let square = dag.powi(u, 2);
        let sum = dag.add(one, square);
        dag.div(one, sum)
    },
    difference: Difference::Pair(PairFunction::AtanDd),
    value: f64::atan,
    slope: |u| 1.0 / (1.0 + u * u),
    enclosure: |u| u.rising(f64::atan).without_zero(u.nonzero),
    equation: Equation::ArcTangent,
};

/// atan\[a, b\], from tan(β − α) = (tan β − tan α)/(1 + tan α tan β)
pub(super) const PAIR: Pair = Pair {
    value: |a, b| {
        let c = 1.0 + a * b;
        if c > 0.0 {
            quotient((b - a) / c) / c
        } else {
            (b.atan() - a.atan()) / (b - a)
        }
    },
    to_singularity: |_, _| 1.0,
    square: Some(1),
    is_root: false,
    second: (-2, 1, 2),
};

/// atan(u)/u
pub(super) fn quotient(u: f64) -> f64 {
    if u == 0.0 { 1.0 } else { u.atan() / u }
}
