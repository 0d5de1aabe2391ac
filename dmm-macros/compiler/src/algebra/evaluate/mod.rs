//! Numerical evaluation: (expressions, values of the variables) → floating-point values, with
//! a bound of the rounding error where it is asked for.
//!
//! The bound is a first-order running error analysis: with ε the unit roundoff, the error of
//! u ∘ v is at most the errors of u and v through the derivative of ∘, plus ε|u ∘ v|. It tells
//! a value that is clearly not zero from what cancellation leaves. What has to be certain is
//! enclosed in intervals instead ([`enclose`]), or evaluated exactly ([`evaluate_exactly`]).

mod exact;
mod interval;

use std::collections::BTreeMap;

use num_traits::ToPrimitive;

use super::{Dag, Id, Math, Name, PairFunction, Rational};
pub use exact::evaluate_exactly;
pub(super) use interval::LIBRARY_STEPS;
pub use interval::{Interval, enclose, enclose_within};

/// The values of `roots`; NaN where a variable has no value or the point is outside a domain.
pub fn evaluate(dag: &Dag, roots: &[Id], values: &BTreeMap<Name, f64>) -> Vec<f64> {
    evaluate_bounded(dag, roots, values)
        .into_iter()
        .map(|(value, _)| value)
        .collect()
}

/// The values of `roots`, each with a bound of its rounding error.
pub fn evaluate_bounded(dag: &Dag, roots: &[Id], values: &BTreeMap<Name, f64>) -> Vec<(f64, f64)> {
    let size = roots.iter().map(|&root| usize::from(root) + 1).max();
    let mut table = vec![Bounded::NAN; size.unwrap_or(0)];
    for id in dag.reachable(roots.iter().copied()) {
        table[usize::from(id)] = node(dag, id, &table, values);
    }
    roots
        .iter()
        .map(|&root| {
            let Bounded { value, error } = table[usize::from(root)];
            (value, error)
        })
        .collect()
}

/// A value and a bound of its error.
#[derive(Clone, Copy)]
struct Bounded {
    value: f64,
    error: f64,
}

impl Bounded {
    const NAN: Self = Self {
        value: f64::NAN,
        error: f64::NAN,
    };

    /// `value`, rounded, after an error `inherited` of the arguments. What is too small for a
    /// normal number has lost digits.
    fn rounded(value: f64, inherited: f64) -> Self {
        let lost = if value.is_subnormal() {
            f64::MIN_POSITIVE
        } else {
            0.0
        };
        Self {
            value,
            error: inherited + f64::EPSILON * value.abs() + lost,
        }
    }

    /// As [`rounded`](Self::rounded) for what is not zero unless it is `exactly`: anything
    /// below the smallest number may have become 0.
    fn rounded_unless_zero(value: f64, inherited: f64, exactly: bool) -> Self {
        let lost = if value == 0.0 && !exactly {
            f64::MIN_POSITIVE
        } else {
            0.0
        };
        Self::rounded(value, inherited + lost)
    }
}

fn node(dag: &Dag, id: Id, table: &[Bounded], values: &BTreeMap<Name, f64>) -> Bounded {
    let of = |child: Id| table[usize::from(child)];
    match &dag[id] {
        Math::Pi => Bounded::rounded(std::f64::consts::PI, 0.0),
        Math::Constant(value) => constant(value),
        Math::Variable(name) => match values.get(name) {
            Some(&value) => Bounded { value, error: 0.0 },
            None => Bounded::NAN,
        },
        Math::Neg(u) => Bounded {
            value: -of(*u).value,
            ..of(*u)
        },
        Math::Add([u, v]) => {
            let (u, v) = (of(*u), of(*v));
            Bounded::rounded(u.value + v.value, u.error + v.error)
        }
        Math::Sub([u, v]) => {
            let (u, v) = (of(*u), of(*v));
            Bounded::rounded(u.value - v.value, u.error + v.error)
        }
        Math::Mul([u, v]) => {
            let (u, v) = (of(*u), of(*v));
            let inherited = u.value.abs() * v.error + v.value.abs() * u.error;
            let is_zero = u.value == 0.0 || v.value == 0.0;
            Bounded::rounded_unless_zero(u.value * v.value, inherited, is_zero)
        }
        Math::Div([u, v]) => {
            let (u, v) = (of(*u), of(*v));
            let value = u.value / v.value;
            let inherited = (u.error + value.abs() * v.error) / v.value.abs();
            Bounded::rounded_unless_zero(value, inherited, u.value == 0.0)
        }
        Math::Pow([u, v]) => power(of(*u), of(*v), dag.as_integer(*v)),
        Math::Call(function, u) => {
            let u = of(*u);
            let known = function.properties();
            let (value, slope) = ((known.value)(u.value), (known.slope)(u.value));
            Bounded::rounded(value, scaled(slope.abs(), u.error))
        }
        Math::Pair(function, [a, b]) => {
            let (a, b) = (of(*a), of(*b));
            let (value, sensitivity) = pair(*function, a.value, b.value);
            Bounded::rounded(value, scaled(sensitivity, a.error + b.error))
        }
    }
}

/// `slope`·`error`, 0 for an exact argument even where the slope is infinite.
fn scaled(slope: f64, error: f64) -> f64 {
    if error == 0.0 { 0.0 } else { slope * error }
}

fn constant(value: &Rational) -> Bounded {
    let float = value.to_f64().unwrap_or(f64::NAN);
    let exact = value.is_integer() && float.abs() < 9e15;
    Bounded::rounded(float, 0.0).exact_if(exact)
}

impl Bounded {
    fn exact_if(self, exact: bool) -> Self {
        Self {
            error: if exact { 0.0 } else { self.error },
            ..self
        }
    }
}

fn power(u: Bounded, v: Bounded, integer: Option<i64>) -> Bounded {
    let value = match integer.and_then(|n| i32::try_from(n).ok()) {
        Some(n) => u.value.powi(n),
        None => u.value.powf(v.value),
    };
    let size = value.abs();
    let through_base = scaled(size * (v.value / u.value).abs(), u.error);
    let through_exponent = scaled(size * u.value.abs().ln().abs(), v.error);
    // repeated multiplication rounds once a factor
    let roundings = f64::EPSILON * size * v.value.abs().min(64.0);
    let inherited = through_base + through_exponent + roundings;
    Bounded::rounded_unless_zero(value, inherited, u.value == 0.0)
}

/// A divided difference (or its derivative), and the size of its derivatives.
fn pair(function: PairFunction, a: f64, b: f64) -> (f64, f64) {
    let derivative = |a, b| prime(function, a, b);
    if function.prime().is_some() {
        let sensitivity = derivative(a, b).abs() + derivative(b, a).abs();
        return ((function.properties().value)(a, b), sensitivity);
    }
    // |∂h[a, b]′| ≤ sup |h‴|, estimated by steps of the derivative itself
    let value = derivative(a, b);
    let step = 1e-4 * a.abs().min(b.abs()).max(1e-4);
    let in_a = (derivative(a + step, b) - value).abs() / step;
    let in_b = (derivative(a, b + step) - value).abs() / step;
    (value, 2.0 * (in_a + in_b) + value.abs())
}

/// ∂h\[a, b\]/∂b = (h′(b) − h\[a, b\])/(b − a) = ∫₀¹ s h″(a + s(b − a)) ds; the integral, by
/// Gauss–Legendre quadrature, where the ends are close.
fn prime(function: PairFunction, a: f64, b: f64) -> f64 {
    let (pair, slope) = (function.properties(), function.of().properties().slope);
    let d = b - a;
    if d.abs() <= 0.1 * (pair.to_singularity)(a, b) {
        let second = |u: f64| pair.second_derivative(u, slope(u));
        let terms = GAUSS_LEGENDRE.iter();
        return terms
            .map(|&(s, weight)| weight * s * second(a + s * d))
            .sum();
    }
    (slope(b) - (pair.value)(a, b)) / d
}

/// The 5-point nodes on \[0, 1\] and their weights.
const GAUSS_LEGENDRE: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];
