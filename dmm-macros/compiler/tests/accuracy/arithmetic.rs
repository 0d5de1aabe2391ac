//! Operations in double precision, as emitted code does them, and in 120 digits.

use std::collections::BTreeMap;

use dashu_float::{FBig, round::mode::HalfEven};
use dmm_compiler::algebra::{Dag, Function, Id, Math, Name, PairFunction, Rational};
use dmm_runtime::special;
use num_bigint::{BigInt, Sign};
use num_traits::ToPrimitive;

/// A binary number of arbitrary precision.
pub(crate) type Big = FBig<HalfEven, 2>;

/// 120 digits; ends 10⁻¹² apart cost the derivative of a divided difference 24 of them.
const BITS: usize = 400;

/// `value` with all digits.
pub(crate) fn big(value: f64) -> Option<Big> {
    Some(Big::try_from(value).ok()?.with_precision(BITS).value())
}

/// The values of `roots` in double precision.
pub(crate) fn doubles(dag: &Dag, roots: &[Id], point: &BTreeMap<Name, f64>) -> Vec<f64> {
    let mut values: BTreeMap<Id, f64> = BTreeMap::new();
    for id in dag.reachable(roots.iter().copied()) {
        let value = match &dag[id] {
            Math::Variable(name) => point.get(name).copied().unwrap_or(f64::NAN),
            _ => operation(dag, id, |child| values[&child]),
        };
        values.insert(id, value);
    }
    roots.iter().map(|root| values[root]).collect()
}

/// The value of a node that is no variable, from the values of its operands.
pub(crate) fn operation(dag: &Dag, id: Id, of: impl Fn(Id) -> f64) -> f64 {
    match dag[id] {
        Math::Pi => std::f64::consts::PI,
        Math::Constant(ref value) => value.to_f64().unwrap_or(f64::NAN),
        Math::Variable(_) => f64::NAN,
        Math::Neg(a) => -of(a),
        Math::Add([a, b]) => of(a) + of(b),
        Math::Sub([a, b]) => of(a) - of(b),
        Math::Mul([a, b]) => of(a) * of(b),
        Math::Div([a, b]) => of(a) / of(b),
        Math::Pow([a, b]) => match dag.as_integer(b).map(i32::try_from) {
            Some(Ok(n)) => of(a).powi(n),
            _ => of(a).powf(of(b)),
        },
        Math::Call(function, a) => call(function, of(a)),
        Math::Pair(function, [a, b]) => pair(function, of(a), of(b)),
    }
}

/// The value of a function of one argument.
pub(crate) fn call(function: Function, u: f64) -> f64 {
    use Function::*;
    match function {
        Sqrt => u.sqrt(),
        Exp => u.exp(),
        Ln => u.ln(),
        Sin => u.sin(),
        Cos => u.cos(),
        Tan => u.tan(),
        Sinh => u.sinh(),
        Cosh => u.cosh(),
        Tanh => u.tanh(),
        Asin => u.asin(),
        Acos => u.acos(),
        Atan => u.atan(),
        Abs => u.abs(),
        Sinc => special::sinc(u),
        SincPrime => special::sinc_prime(u),
        Sinhc => special::sinhc(u),
        SinhcPrime => special::sinhc_prime(u),
    }
}

fn pair(function: PairFunction, a: f64, b: f64) -> f64 {
    use PairFunction::*;
    match function {
        LnDd => special::ln_dd(a, b),
        LnDdPrime => special::ln_dd_prime(a, b),
        AsinDd => special::asin_dd(a, b),
        AsinDdPrime => special::asin_dd_prime(a, b),
        AtanDd => special::atan_dd(a, b),
        AtanDdPrime => special::atan_dd_prime(a, b),
    }
}

/// The values of `roots` in 120 digits; nothing outside the domain of one of them.
pub(crate) fn exact(dag: &Dag, roots: &[Id], point: &BTreeMap<Name, f64>) -> Option<Vec<Big>> {
    let mut values: BTreeMap<Id, Big> = BTreeMap::new();
    for id in dag.reachable(roots.iter().copied()) {
        let of = |child: &Id| &values[child];
        let value = match &dag[id] {
            Math::Pi => pi(),
            Math::Constant(value) => rational(value),
            Math::Variable(name) => big(*point.get(name)?)?,
            Math::Neg(a) => -of(a),
            Math::Add([a, b]) => of(a) + of(b),
            Math::Sub([a, b]) => of(a) - of(b),
            Math::Mul([a, b]) => of(a) * of(b),
            Math::Div([a, b]) => quotient(of(a), of(b))?,
            Math::Pow([a, b]) => match dag.as_integer(*b) {
                Some(n) => integer_power(of(a), n)?,
                None => (*of(a) > Big::ZERO).then(|| (of(a).ln() * of(b)).exp())?,
            },
            Math::Call(function, a) => exact_call(*function, of(a))?,
            Math::Pair(function, [a, b]) => exact_pair(*function, of(a), of(b))?,
        };
        values.insert(id, value);
    }
    Some(roots.iter().map(|root| values[root].clone()).collect())
}

/// `value` with the precision of all others: an exact zero has none, and no root.
pub(crate) fn kept(value: Big) -> Big {
    value.with_precision(BITS).value()
}

pub(crate) fn one() -> Big {
    Big::ONE.with_precision(BITS).value()
}

pub(crate) fn pi() -> Big {
    one().atan() * Big::from(4)
}

fn integer(value: &BigInt) -> Big {
    let (sign, digits) = value.to_u64_digits();
    let base = Big::from(1_u128 << 64).with_precision(BITS).value();
    let size = digits.into_iter().rev().fold(Big::ZERO, |sum, digit| {
        (sum * &base + Big::from(digit))
            .with_precision(BITS)
            .value()
    });
    match sign {
        Sign::Minus => -size,
        _ => size,
    }
}

pub(crate) fn rational(value: &Rational) -> Big {
    let [numerator, denominator] =
        [value.numer(), value.denom()].map(|part| integer(part).with_precision(BITS).value());
    numerator / denominator
}

pub(crate) fn quotient(a: &Big, b: &Big) -> Option<Big> {
    (*b != Big::ZERO).then(|| a / b)
}

pub(crate) fn integer_power(a: &Big, n: i64) -> Option<Big> {
    let power = (0..n.unsigned_abs()).fold(one(), |power, _| power * a);
    if n < 0 {
        quotient(&one(), &power)
    } else {
        Some(power)
    }
}

pub(crate) fn exact_call(function: Function, u: &Big) -> Option<Big> {
    use Function::*;
    let zero = *u == Big::ZERO;
    let within_one = || (u * u <= one()).then_some(());
    Some(match function {
        Sqrt => (*u >= Big::ZERO).then(|| u.sqrt())?,
        Exp => u.exp(),
        Ln => (*u > Big::ZERO).then(|| u.ln())?,
        Sin => u.sin(),
        Cos => u.cos(),
        Tan => quotient(&u.sin(), &u.cos())?,
        Sinh => u.sinh(),
        Cosh => u.cosh(),
        Tanh => u.sinh() / u.cosh(),
        Asin => within_one().map(|()| u.asin())?,
        Acos => within_one().map(|()| u.acos())?,
        Atan => u.atan(),
        Abs => {
            if *u < Big::ZERO {
                -u
            } else {
                u.clone()
            }
        }
        Sinc | Sinhc if zero => one(),
        SincPrime | SinhcPrime if zero => Big::ZERO,
        Sinc => u.sin() / u,
        Sinhc => u.sinh() / u,
        SincPrime => (u * u.cos() - u.sin()) / (u * u),
        SinhcPrime => (u * u.cosh() - u.sinh()) / (u * u),
    })
}

/// h, h′ and h″ of a divided difference, where they exist.
fn function_of(function: PairFunction, u: &Big) -> Option<[Big; 3]> {
    use PairFunction::*;
    Some(match function {
        LnDd | LnDdPrime => {
            let value = (*u > Big::ZERO).then(|| u.ln())?;
            [value, one() / u, -one() / (u * u)]
        }
        AsinDd | AsinDdPrime => {
            let square = one() - u * u;
            let root = (square > Big::ZERO).then(|| square.sqrt())?;
            [u.asin(), one() / &root, u / (root * square)]
        }
        AtanDd | AtanDdPrime => {
            let square = one() + u * u;
            let second = -(u * Big::from(2)) / (&square * &square);
            [u.atan(), one() / square, second]
        }
    })
}

fn exact_pair(function: PairFunction, a: &Big, b: &Big) -> Option<Big> {
    use PairFunction::*;
    let (at_a, at_b) = (function_of(function, a)?, function_of(function, b)?);
    let step = b - a;
    let prime = matches!(function, LnDdPrime | AsinDdPrime | AtanDdPrime);
    if step == Big::ZERO {
        let [_, first, second] = at_b;
        return Some(if prime { second / Big::from(2) } else { first });
    }
    let difference = (&at_b[0] - &at_a[0]) / &step;
    Some(if prime {
        (&at_b[1] - difference) / step
    } else {
        difference
    })
}
