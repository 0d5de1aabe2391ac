//! Dual numbers: a value with its derivatives in K directions.
//!
//! Over doubles they carry first derivatives through generated code, over dual numbers second ones
//! (Griewank & Walther, Evaluating Derivatives, chapter 3).

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::Scalar;

/// A value, and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual<S, const K: usize> {
    pub(crate) value: S,
    pub(crate) parts: [S; K],
}

impl<S: Scalar, const K: usize> Dual<S, K> {
    /// A value with derivatives.
    pub(crate) fn new(value: S, parts: impl FnMut(usize) -> S) -> Self {
        Self {
            value,
            parts: std::array::from_fn(parts),
        }
    }

    /// One that depends on nothing.
    pub(crate) fn constant(value: S) -> Self {
        Self::new(value, |_| S::from_f64(0.0))
    }

    /// h(u), with h(u) and h′(u).
    fn chain(self, value: S, slope: S) -> Self {
        Self::new(value, |k| slope * self.parts[k])
    }

    /// h(u, v), with its value and its partial derivatives.
    fn chain_two(self, other: Self, value: S, slopes: [S; 2]) -> Self {
        Self::new(value, |k| {
            slopes[0] * self.parts[k] + slopes[1] * other.parts[k]
        })
    }

    /// A divided difference h[a, b], of which h[a, b] = h[b, a], with its value and ∂h/∂b.
    fn difference(self, b: Self, value: S, by_second: impl Fn(S, S) -> S) -> Self {
        let slopes = [
            by_second(b.value, self.value),
            by_second(self.value, b.value),
        ];
        self.chain_two(b, value, slopes)
    }

    /// ∂h[a, b]/∂b: of h[a, b] = ∫ h′(a + s(b − a)) ds, the second derivatives are moments of h‴.
    fn difference_slope(self, b: Self, value: S, third: impl Fn(S) -> S) -> Self {
        let a = self.value;
        let mut slopes = [S::from_f64(0.0); 2];
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let s = S::from_f64(*node);
            let curvature = S::from_f64(weight) * s * third(a + s * (b.value - a));
            slopes[0] += (S::from_f64(1.0) - s) * curvature;
            slopes[1] += s * curvature;
        }
        self.chain_two(b, value, slopes)
    }
}

/// Gauss–Legendre quadrature of order 16 on [0, 1].
#[allow(clippy::excessive_precision, reason = "the digits of the source")]
const NODES: [f64; 8] = [
    0.019_855_071_751_231_884,
    0.101_666_761_293_186_63,
    0.237_233_795_041_835_5,
    0.408_282_678_752_175_1,
    0.591_717_321_247_824_9,
    0.762_766_204_958_164_5,
    0.898_333_238_706_813_4,
    0.980_144_928_248_768_1,
];
#[allow(clippy::excessive_precision, reason = "the digits of the source")]
const WEIGHTS: [f64; 8] = [
    0.050_614_268_145_188_13,
    0.111_190_517_226_687_24,
    0.156_853_322_938_943_64,
    0.181_341_891_689_180_99,
    0.181_341_891_689_180_99,
    0.156_853_322_938_943_64,
    0.111_190_517_226_687_24,
    0.050_614_268_145_188_13,
];

/// As values compare: derivatives do not decide on branches.
impl<S: Scalar, const K: usize> PartialEq for Dual<S, K> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<S: Scalar, const K: usize> PartialOrd for Dual<S, K> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<S: Scalar, const K: usize> Add for Dual<S, K> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::new(self.value + b.value, |k| self.parts[k] + b.parts[k])
    }
}

impl<S: Scalar, const K: usize> Sub for Dual<S, K> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::new(self.value - b.value, |k| self.parts[k] - b.parts[k])
    }
}

impl<S: Scalar, const K: usize> Mul for Dual<S, K> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        self.chain_two(b, self.value * b.value, [b.value, self.value])
    }
}

impl<S: Scalar, const K: usize> Div for Dual<S, K> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let quotient = self.value / b.value;
        let inverse = S::from_f64(1.0) / b.value;
        self.chain_two(b, quotient, [inverse, -(quotient * inverse)])
    }
}

impl<S: Scalar, const K: usize> Neg for Dual<S, K> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, |k| -self.parts[k])
    }
}

impl<S: Scalar, const K: usize> AddAssign for Dual<S, K> {
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl<S: Scalar, const K: usize> SubAssign for Dual<S, K> {
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl<S: Scalar, const K: usize> MulAssign for Dual<S, K> {
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl<S: Scalar, const K: usize> DivAssign for Dual<S, K> {
    fn div_assign(&mut self, b: Self) {
        *self = *self / b;
    }
}

/// 1 as another scalar.
fn one<S: Scalar>() -> S {
    S::from_f64(1.0)
}

/// −h(u) − 2 h′(u)/u, which is h″ of sinc, and with the other sign of h that of sinhc.
fn cardinal_curvature<S: Scalar>(u: S, value: S, slope: S, sign: f64) -> S {
    if u.to_f64() == 0.0 {
        // even: the next term is of the order of u²
        return S::from_f64(sign / 3.0);
    }
    S::from_f64(sign) * value - S::from_f64(2.0) * (slope / u)
}

impl<S: Scalar, const K: usize> Scalar for Dual<S, K> {
    const ROUNDING: f64 = S::ROUNDING;

    fn from_f64(value: f64) -> Self {
        Self::constant(S::from_f64(value))
    }

    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    fn fused(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    fn abs(self) -> Self {
        if self.to_f64() < 0.0 { -self } else { self }
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, S::from_f64(0.5) / root)
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }

    fn ln(self) -> Self {
        self.chain(self.value.ln(), one::<S>() / self.value)
    }

    fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }

    fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    fn tan(self) -> Self {
        let value = self.value.tan();
        self.chain(value, one::<S>() + value * value)
    }

    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }

    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }

    fn tanh(self) -> Self {
        let value = self.value.tanh();
        self.chain(value, one::<S>() - value * value)
    }

    fn asin(self) -> Self {
        let slope = one::<S>() / (one::<S>() - self.value * self.value).sqrt();
        self.chain(self.value.asin(), slope)
    }

    fn acos(self) -> Self {
        let slope = one::<S>() / (one::<S>() - self.value * self.value).sqrt();
        self.chain(self.value.acos(), -slope)
    }

    fn atan(self) -> Self {
        let slope = one::<S>() / (one::<S>() + self.value * self.value);
        self.chain(self.value.atan(), slope)
    }

    fn powi(self, n: i32) -> Self {
        let slope = match n {
            0 => S::from_f64(0.0),
            _ => S::from_f64(f64::from(n)) * self.value.powi(n - 1),
        };
        self.chain(self.value.powi(n), slope)
    }

    fn powf(self, v: Self) -> Self {
        let value = self.value.powf(v.value);
        let by_base = v.value * self.value.powf(v.value - one());
        // a power with a constant exponent has a value where the logarithm has none
        let is_constant = v.parts.iter().all(|part| part.to_f64() == 0.0);
        let by_exponent = if is_constant {
            S::from_f64(0.0)
        } else {
            value * self.value.ln()
        };
        self.chain_two(v, value, [by_base, by_exponent])
    }

    fn exp_product(self, b: Self) -> Self {
        let value = self.value.exp_product(b.value);
        self.chain_two(b, value, [value * b.value, value * self.value])
    }

    fn sinc(self) -> Self {
        self.chain(self.value.sinc(), self.value.sinc_prime())
    }

    fn sinc_prime(self) -> Self {
        let (value, slope) = (self.value.sinc(), self.value.sinc_prime());
        self.chain(slope, cardinal_curvature(self.value, value, slope, -1.0))
    }

    fn sinhc(self) -> Self {
        self.chain(self.value.sinhc(), self.value.sinhc_prime())
    }

    fn sinhc_prime(self) -> Self {
        let (value, slope) = (self.value.sinhc(), self.value.sinhc_prime());
        self.chain(slope, cardinal_curvature(self.value, value, slope, 1.0))
    }

    fn ln_dd(self, b: Self) -> Self {
        self.difference(b, self.value.ln_dd(b.value), S::ln_dd_prime)
    }

    fn ln_dd_prime(self, b: Self) -> Self {
        let third = |u: S| S::from_f64(2.0) / (u * u * u);
        self.difference_slope(b, self.value.ln_dd_prime(b.value), third)
    }

    fn asin_dd(self, b: Self) -> Self {
        self.difference(b, self.value.asin_dd(b.value), S::asin_dd_prime)
    }

    fn asin_dd_prime(self, b: Self) -> Self {
        // (1 + 2u²)/(1 − u²)^{5/2}
        let third = |u: S| {
            let square = u * u;
            let rest = one::<S>() - square;
            (one::<S>() + S::from_f64(2.0) * square) / (rest * rest * rest.sqrt())
        };
        self.difference_slope(b, self.value.asin_dd_prime(b.value), third)
    }

    fn atan_dd(self, b: Self) -> Self {
        self.difference(b, self.value.atan_dd(b.value), S::atan_dd_prime)
    }

    fn atan_dd_prime(self, b: Self) -> Self {
        // (6u² − 2)/(1 + u²)³
        let third = |u: S| {
            let square = u * u;
            let sum = one::<S>() + square;
            (S::from_f64(6.0) * square - S::from_f64(2.0)) / (sum * sum * sum)
        };
        self.difference_slope(b, self.value.atan_dd_prime(b.value), third)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type First = Dual<f64, 1>;
    type Second = Dual<First, 1>;

    /// u, to be derived by itself twice.
    fn variable(u: f64) -> Second {
        Dual::new(Dual::new(u, |_| 1.0), |_| First::from_f64(1.0))
    }

    /// h, h′ and h″ against central differences of h and of h′.
    fn assert_derivatives(name: &str, u: f64, h: impl Fn(Second) -> Second) {
        let of = |u: f64| {
            let result = h(variable(u));
            let first = result.value.parts[0];
            assert_eq!(first, result.parts[0].value, "{name}");
            [result.value.value, first, result.parts[0].parts[0]]
        };
        let step = 1e-5;
        let [_, first, second] = of(u);
        let (above, below) = (of(u + step), of(u - step));
        for (order, derivative) in [(0, first), (1, second)] {
            let difference = (above[order] - below[order]) / (2.0 * step);
            let error = (derivative - difference).abs() / (1.0 + derivative.abs());
            assert!(
                error < 1e-8,
                "{name} {u} {order}: {derivative} {difference}"
            );
        }
    }

    #[test]
    fn derivatives_are_those_of_the_functions() {
        for u in [0.3, 0.7, -0.4] {
            assert_derivatives("quotient", u, |u| (u * u - u) / (u + one()));
            assert_derivatives("exp", u, Scalar::exp);
            assert_derivatives("sin", u, Scalar::sin);
            assert_derivatives("cos", u, Scalar::cos);
            assert_derivatives("tan", u, Scalar::tan);
            assert_derivatives("sinh", u, Scalar::sinh);
            assert_derivatives("cosh", u, Scalar::cosh);
            assert_derivatives("tanh", u, Scalar::tanh);
            assert_derivatives("asin", u, Scalar::asin);
            assert_derivatives("acos", u, Scalar::acos);
            assert_derivatives("atan", u, Scalar::atan);
            assert_derivatives("abs", u, Scalar::abs);
            assert_derivatives("powi", u, |u| Scalar::powi(u, -3));
            assert_derivatives("exp_product", u, |u| u.exp_product(u * u));
            assert_derivatives("sinc", u, Scalar::sinc);
            assert_derivatives("sinc'", u, Scalar::sinc_prime);
            assert_derivatives("sinhc", u, Scalar::sinhc);
            assert_derivatives("sinhc'", u, Scalar::sinhc_prime);
            let near = |u: Second| u * Second::from_f64(0.9) + Second::from_f64(0.01);
            assert_derivatives("asin_dd", u, |u| u.asin_dd(near(u)));
            assert_derivatives("asin_dd'", u, |u| u.asin_dd_prime(near(u)));
            assert_derivatives("atan_dd", u, |u| u.atan_dd(near(u)));
            assert_derivatives("atan_dd'", u, |u| u.atan_dd_prime(near(u)));
        }
        for u in [0.3, 2.5] {
            let near = |u: Second| u * u + Second::from_f64(0.1);
            assert_derivatives("sqrt", u, Scalar::sqrt);
            assert_derivatives("ln", u, Scalar::ln);
            assert_derivatives("powf", u, |u| Scalar::powf(u, u + one()));
            assert_derivatives("ln_dd", u, |u| u.ln_dd(near(u)));
            assert_derivatives("ln_dd'", u, |u| u.ln_dd_prime(near(u)));
        }
    }

    #[test]
    fn a_power_of_a_negative_number_has_a_derivative() {
        let u = Dual::<f64, 1>::new(-2.0, |_| 1.0);
        let cube = Scalar::powf(u, Dual::constant(3.0));
        assert_eq!((cube.value, cube.parts[0]), (-8.0, 12.0));
    }

    #[test]
    fn cardinal_functions_are_even() {
        let at_zero = variable(0.0).sinc();
        assert_eq!(at_zero.value.parts[0], 0.0);
        assert!((at_zero.parts[0].parts[0] + 1.0 / 3.0).abs() < 1e-15);
        assert!((variable(0.0).sinhc().parts[0].parts[0] - 1.0 / 3.0).abs() < 1e-15);
    }
}
