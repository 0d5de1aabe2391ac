//! The chain rule: the elementary functions of scalars that carry derivatives.

use super::Scalar;

/// A value with derivatives, which functions change by the chain rule.
pub(crate) trait Chain: Scalar {
    /// What values and first derivatives are.
    type Value: Scalar;

    /// One that depends on nothing.
    fn constant(value: Self::Value) -> Self;

    /// The value alone.
    fn value(self) -> Self::Value;

    /// Whether all derivatives are zero.
    fn is_constant(self) -> bool;

    /// h(u), with h(u) and h′(u).
    fn chain(self, value: Self::Value, slope: Self::Value) -> Self;

    /// h(u, v), with its value and its partial derivatives.
    fn chain_two(self, v: Self, value: Self::Value, slopes: [Self::Value; 2]) -> Self;

    /// A divided difference h[a, b], of which h[a, b] = h[b, a], with its value and ∂h/∂b.
    fn difference(
        self,
        b: Self,
        value: Self::Value,
        by_second: impl Fn(Self::Value, Self::Value) -> Self::Value,
    ) -> Self {
        let (a, v) = (self.value(), b.value());
        self.chain_two(b, value, [by_second(v, a), by_second(a, v)])
    }

    /// ∂h[a, b]/∂b: of h[a, b] = ∫ h′(a + s(b − a)) ds, the second derivatives are moments of h‴.
    fn difference_slope(
        self,
        b: Self,
        value: Self::Value,
        third: impl Fn(Self::Value) -> Self::Value,
    ) -> Self {
        let a = self.value();
        let mut slopes = [Self::Value::from_f64(0.0); 2];
        for (node, weight) in NODES.iter().zip(WEIGHTS) {
            let s = Self::Value::from_f64(*node);
            let curvature = Self::Value::from_f64(weight) * s * third(a + s * (b.value() - a));
            slopes[0] += (Self::Value::from_f64(1.0) - s) * curvature;
            slopes[1] += s * curvature;
        }
        self.chain_two(b, value, slopes)
    }
}

/// The operators that follow from the chain rule and from sums; values compare, derivatives do not
/// decide on branches.
macro_rules! operators {
    ([$($parameters:tt)*] $type:ty) => {
        impl<$($parameters)*> PartialEq for $type {
            fn eq(&self, other: &Self) -> bool {
                self.value() == other.value()
            }
        }

        impl<$($parameters)*> PartialOrd for $type {
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                self.value().partial_cmp(&other.value())
            }
        }

        impl<$($parameters)*> Mul for $type {
            type Output = Self;
            fn mul(self, b: Self) -> Self {
                let (u, v) = (self.value(), b.value());
                self.chain_two(b, u * v, [v, u])
            }
        }

        impl<$($parameters)*> Div for $type {
            type Output = Self;
            fn div(self, b: Self) -> Self {
                let quotient = self.value() / b.value();
                let inverse = <Self as Chain>::Value::from_f64(1.0) / b.value();
                self.chain_two(b, quotient, [inverse, -(quotient * inverse)])
            }
        }

        impl<$($parameters)*> AddAssign for $type {
            fn add_assign(&mut self, b: Self) {
                *self = *self + b;
            }
        }

        impl<$($parameters)*> SubAssign for $type {
            fn sub_assign(&mut self, b: Self) {
                *self = *self - b;
            }
        }

        impl<$($parameters)*> MulAssign for $type {
            fn mul_assign(&mut self, b: Self) {
                *self = *self * b;
            }
        }

        impl<$($parameters)*> DivAssign for $type {
            fn div_assign(&mut self, b: Self) {
                *self = *self / b;
            }
        }
    };
}
pub(crate) use operators;

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

impl<T: Chain> Scalar for T {
    const ROUNDING: f64 = T::Value::ROUNDING;
    const DERIVATIVES: usize = T::Value::DERIVATIVES + 1;

    fn from_f64(value: f64) -> Self {
        Self::constant(T::Value::from_f64(value))
    }

    fn to_f64(self) -> f64 {
        self.value().to_f64()
    }

    fn fused(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    fn is_zero(self) -> bool {
        self.value().is_zero() && self.is_constant()
    }

    fn abs(self) -> Self {
        if self.to_f64() < 0.0 { -self } else { self }
    }

    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        self.chain(root, T::Value::from_f64(0.5) / root)
    }

    fn exp(self) -> Self {
        let value = self.value().exp();
        self.chain(value, value)
    }

    fn ln(self) -> Self {
        self.chain(self.value().ln(), one::<T::Value>() / self.value())
    }

    fn sin(self) -> Self {
        self.chain(self.value().sin(), self.value().cos())
    }

    fn cos(self) -> Self {
        self.chain(self.value().cos(), -self.value().sin())
    }

    fn tan(self) -> Self {
        let value = self.value().tan();
        self.chain(value, one::<T::Value>() + value * value)
    }

    fn sinh(self) -> Self {
        self.chain(self.value().sinh(), self.value().cosh())
    }

    fn cosh(self) -> Self {
        self.chain(self.value().cosh(), self.value().sinh())
    }

    fn tanh(self) -> Self {
        let value = self.value().tanh();
        self.chain(value, one::<T::Value>() - value * value)
    }

    fn asin(self) -> Self {
        let slope = one::<T::Value>() / (one::<T::Value>() - self.value() * self.value()).sqrt();
        self.chain(self.value().asin(), slope)
    }

    fn acos(self) -> Self {
        let slope = one::<T::Value>() / (one::<T::Value>() - self.value() * self.value()).sqrt();
        self.chain(self.value().acos(), -slope)
    }

    fn atan(self) -> Self {
        let slope = one::<T::Value>() / (one::<T::Value>() + self.value() * self.value());
        self.chain(self.value().atan(), slope)
    }

    fn powi(self, n: i32) -> Self {
        let slope = match n {
            0 => T::Value::from_f64(0.0),
            _ => T::Value::from_f64(f64::from(n)) * self.value().powi(n - 1),
        };
        self.chain(self.value().powi(n), slope)
    }

    fn powf(self, v: Self) -> Self {
        let value = self.value().powf(v.value());
        let by_base = v.value() * self.value().powf(v.value() - one());
        // a power with a constant exponent has a value where the logarithm has none
        let by_exponent = if v.is_constant() {
            T::Value::from_f64(0.0)
        } else {
            value * self.value().ln()
        };
        self.chain_two(v, value, [by_base, by_exponent])
    }

    fn exp_product(self, b: Self) -> Self {
        let value = self.value().exp_product(b.value());
        self.chain_two(b, value, [value * b.value(), value * self.value()])
    }

    fn sinc(self) -> Self {
        self.chain(self.value().sinc(), self.value().sinc_prime())
    }

    fn sinc_prime(self) -> Self {
        let (value, slope) = (self.value().sinc(), self.value().sinc_prime());
        self.chain(slope, cardinal_curvature(self.value(), value, slope, -1.0))
    }

    fn sinhc(self) -> Self {
        self.chain(self.value().sinhc(), self.value().sinhc_prime())
    }

    fn sinhc_prime(self) -> Self {
        let (value, slope) = (self.value().sinhc(), self.value().sinhc_prime());
        self.chain(slope, cardinal_curvature(self.value(), value, slope, 1.0))
    }

    fn ln_dd(self, b: Self) -> Self {
        self.difference(b, self.value().ln_dd(b.value()), T::Value::ln_dd_prime)
    }

    fn ln_dd_prime(self, b: Self) -> Self {
        let third = |u: T::Value| T::Value::from_f64(2.0) / (u * u * u);
        self.difference_slope(b, self.value().ln_dd_prime(b.value()), third)
    }

    fn asin_dd(self, b: Self) -> Self {
        self.difference(b, self.value().asin_dd(b.value()), T::Value::asin_dd_prime)
    }

    fn asin_dd_prime(self, b: Self) -> Self {
        // (1 + 2u²)/(1 − u²)^{5/2}
        let third = |u: T::Value| {
            let square = u * u;
            let rest = one::<T::Value>() - square;
            (one::<T::Value>() + T::Value::from_f64(2.0) * square) / (rest * rest * rest.sqrt())
        };
        self.difference_slope(b, self.value().asin_dd_prime(b.value()), third)
    }

    fn atan_dd(self, b: Self) -> Self {
        self.difference(b, self.value().atan_dd(b.value()), T::Value::atan_dd_prime)
    }

    fn atan_dd_prime(self, b: Self) -> Self {
        // (6u² − 2)/(1 + u²)³
        let third = |u: T::Value| {
            let square = u * u;
            let sum = one::<T::Value>() + square;
            (T::Value::from_f64(6.0) * square - T::Value::from_f64(2.0)) / (sum * sum * sum)
        };
        self.difference_slope(b, self.value().atan_dd_prime(b.value()), third)
    }
}
