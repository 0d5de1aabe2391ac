//! Dual numbers: a value with its derivatives in K directions.
//!
//! Over doubles they carry first derivatives through generated code, over dual numbers second ones
//! (Griewank & Walther, Evaluating Derivatives, chapter 3).

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::chain::{Chain, operators};
use super::{Derived, Scalar};

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
}

impl<S: Scalar, const K: usize> Chain for Dual<S, K> {
    type Value = S;

    fn constant(value: S) -> Self {
        Self::new(value, |_| S::from_f64(0.0))
    }

    fn value(self) -> S {
        self.value
    }

    fn is_constant(self) -> bool {
        self.parts.iter().all(|part| part.is_zero())
    }

    fn chain(self, value: S, slope: S) -> Self {
        Self::new(value, |k| slope * self.parts[k])
    }

    fn chain_two(self, v: Self, value: S, slopes: [S; 2]) -> Self {
        Self::new(value, |k| {
            slopes[0] * self.parts[k] + slopes[1] * v.parts[k]
        })
    }
}

impl<S: Scalar, const K: usize> Derived for Dual<S, K> {
    fn derivative(at: f64, h: impl FnOnce(Self) -> Option<Self>) -> Option<f64> {
        let unit = |k| S::from_f64(f64::from(u8::from(k == 0)));
        Some(h(Self::new(S::from_f64(at), unit))?.parts[0].to_f64())
    }
}

operators!([S: Scalar, const K: usize] Dual<S, K>);

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

impl<S: Scalar, const K: usize> Neg for Dual<S, K> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, |k| -self.parts[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one<S: Scalar>() -> S {
        S::from_f64(1.0)
    }

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
