//! The cardinal hyperbolic sine sinh(u)/u and its derivative.

use super::sinc::{prime, quotient, quotient_prime};
use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};
use crate::algebra::evaluate::Interval;

/// sinh(u)/u
pub(super) const SINHC: Properties = Properties {
    name: "sinhc",
    latex: Latex::Name(r"\operatorname{sinhc}"),
    is_declarable: false,
    domain: Domain::All,
    is_not_negative: true,
    integers: &[(0, 1)],
    right_inverse: None,
    form: Form::Cardinal(Function::Sinh),
    derivative: |dag, u| dag.call(Function::SinhcPrime, u),
    difference: Difference::Definition(|dag, u| quotient(dag, Function::Sinh, u)),
    value: sinhc,
    slope: prime_value,
    enclosure: |_| Interval::WHOLE.undefined(),
    equation: Equation::Missing,
};

/// (sinh(u)/u)′
pub(super) const SINHC_PRIME: Properties = Properties {
    name: "sinhc_prime",
    latex: Latex::Name(r"\operatorname{sinhc}'"),
    is_declarable: false,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: None,
    form: Form::CardinalPrime([Function::Sinh, Function::Cosh]),
    // sinhc″ = sinhc − 2 sinhc′/u
    derivative: |dag, u| {
        let [two, prime] = [dag.integer(2), dag.call(Function::SinhcPrime, u)];
        let doubled = dag.mul(two, prime);
        let quotient = dag.div(doubled, u);
        let sinhc = dag.call(Function::Sinhc, u);
        dag.sub(sinhc, quotient)
    },
    difference: Difference::Definition(|dag, u| {
        quotient_prime(dag, [Function::Sinh, Function::Cosh], u)
    }),
    value: prime_value,
    // |sinhc″| ≤ cosh
    slope: f64::cosh,
    enclosure: |_| Interval::WHOLE.undefined(),
    equation: Equation::Missing,
};

fn sinhc(u: f64) -> f64 {
    if u == 0.0 { 1.0 } else { u.sinh() / u }
}

fn prime_value(u: f64) -> f64 {
    prime(u, 1.0, [sinhc, f64::cosh])
}
