//! The cardinal sine sin(u)/u and its derivative.

use super::{Difference, Domain, Equation, Form, Function, Latex, Properties};
use crate::algebra::evaluate::Interval;
use crate::algebra::{Dag, Id};

/// sin(u)/u
pub(super) const SINC: Properties = Properties {
    name: "sinc",
    latex: Latex::Name(r"\operatorname{sinc}"),
    is_declarable: false,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 1)],
    right_inverse: None,
    form: Form::Cardinal(Function::Sin),
    derivative: |dag, u| dag.call(Function::SincPrime, u),
    difference: Difference::Definition(|dag, u| quotient(dag, Function::Sin, u)),
    value: sinc,
    slope: prime_value,
    enclosure: |_| Interval::WHOLE.undefined(),
    equation: Equation::Missing,
};

/// (sin(u)/u)′
pub(super) const SINC_PRIME: Properties = Properties {
    name: "sinc_prime",
    latex: Latex::Name(r"\operatorname{sinc}'"),
    is_declarable: false,
    domain: Domain::All,
    is_not_negative: false,
    integers: &[(0, 0)],
    right_inverse: None,
    form: Form::CardinalPrime([Function::Sin, Function::Cos]),
    // sinc″ = −sinc − 2 sinc′/u
    derivative: |dag, u| {
        let [two, prime] = [dag.integer(2), dag.call(Function::SincPrime, u)];
        let doubled = dag.mul(two, prime);
        let quotient = dag.div(doubled, u);
        let sinc = dag.call(Function::Sinc, u);
        let sum = dag.add(sinc, quotient);
        dag.neg(sum)
    },
    difference: Difference::Definition(|dag, u| {
        quotient_prime(dag, [Function::Sin, Function::Cos], u)
    }),
    value: prime_value,
    slope: |_| 1.0,
    enclosure: |_| Interval::WHOLE.undefined(),
    equation: Equation::Missing,
};

fn sinc(u: f64) -> f64 {
    if u == 0.0 { 1.0 } else { u.sin() / u }
}

fn prime_value(u: f64) -> f64 {
    prime(u, -1.0, [sinc, f64::cos])
}

/// Below this size the derivatives of `sinc` and `sinhc` are summed as series.
const SERIES: f64 = 1.0;

/// (p(u)/u)′ of p = sin or sinh, from \[p(u)/u, p′(u)\]; near 0 Σ 2k σᵏ u^(2k−1)/(2k+1)! over
/// k ≥ 1, the derivative of Σ σᵏ u^(2k)/(2k+1)!.
pub(super) fn prime(u: f64, sign: f64, [quotient, slope]: [fn(f64) -> f64; 2]) -> f64 {
    if u.abs() >= SERIES {
        return (slope(u) - quotient(u)) / u;
    }
    let mut power = u;
    let mut sum = 0.0;
    for k in 1..=10_u32 {
        let n = f64::from(2 * k);
        power *= sign / (n * (n + 1.0));
        sum += n * power;
        power *= u * u;
    }
    sum
}

/// p(u)/u
pub(super) fn quotient(dag: &mut Dag, p: Function, u: Id) -> Id {
    let value = dag.call(p, u);
    dag.div(value, u)
}

/// (p(u)/u)′ = (p′(u) − p(u)/u)/u
pub(super) fn quotient_prime(dag: &mut Dag, [p, slope]: [Function; 2], u: Id) -> Id {
    let quotient = quotient(dag, p, u);
    let slope = dag.call(slope, u);
    let difference = dag.sub(slope, quotient);
    dag.div(difference, u)
}
