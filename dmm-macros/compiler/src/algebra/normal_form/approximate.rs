//! Constants in floating-point numbers, with bounds of their errors.

use super::algebra::{Algebra, Kind};
use super::fraction::Fraction;
use super::monomial::Power;
use super::number::Coefficient;
use super::polynomial::Polynomial;
use crate::algebra::Function;

/// A complex number with a bound of the rounding errors of both parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approximate {
    pub(super) re: f64,
    pub(super) im: f64,
    error: f64,
}

impl Approximate {
    fn new(re: f64, im: f64, inherited: f64) -> Self {
        let error = inherited + 4.0 * f64::EPSILON * (re.abs() + im.abs());
        Self { re, im, error }
    }

    fn real(re: f64) -> Self {
        Self::new(re, 0.0, 0.0)
    }

    fn add(self, other: Self) -> Self {
        Self::new(
            self.re + other.re,
            self.im + other.im,
            self.error + other.error,
        )
    }

    fn mul(self, other: Self) -> Self {
        let size = |one: Self| one.re.abs() + one.im.abs() + one.error;
        let inherited = size(self) * other.error + size(other) * self.error;
        Self::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
            inherited,
        )
    }

    /// −1 or 1 if the sign of the real part is certain.
    pub(super) fn sign(self) -> Option<i64> {
        let clear = self.re.is_finite() && self.re.abs() > 1e3 * self.error;
        clear.then_some(if self.re < 0.0 { -1 } else { 1 })
    }
}
impl Algebra {
    /// The value of a constant.
    pub(super) fn approximate(&self, constant: &Fraction) -> Option<Approximate> {
        let mut value = self.approximate_sum(&constant.numerator)?;
        for &(index, multiplicity) in &constant.denominator {
            let factor = self.approximate_sum(self.factor(index)?)?;
            let square = factor.re * factor.re + factor.im * factor.im;
            let error = factor.error / square;
            let inverse = Approximate::new(factor.re / square, -factor.im / square, error);
            for _ in 0..multiplicity {
                value = value.mul(inverse);
            }
        }
        value.re.is_finite().then_some(value)
    }

    fn approximate_sum(&self, sum: &Polynomial) -> Option<Approximate> {
        let mut value = Approximate::new(0.0, 0.0, 0.0);
        for term in sum.terms() {
            let Coefficient { re, im } = &term.coefficient;
            let mut product = Approximate::new(re.to_f64()?, im.to_f64()?, 0.0);
            for power in &term.monomial {
                product = product.mul(self.approximate_power(*power)?);
            }
            value = value.add(product);
        }
        Some(value)
    }

    fn approximate_power(&self, power: Power) -> Option<Approximate> {
        let exponent = power.exponent.to_number().to_f64()?;
        let of = |fraction: &Fraction| {
            let value = self.approximate(fraction)?;
            (value.im.abs() <= value.error).then_some(value)
        };
        Some(match self.kind(power.atom)? {
            Kind::Pi => Approximate::real(std::f64::consts::PI.powf(exponent)),
            Kind::Root(base) => {
                let base = of(base)?;
                if base.sign()? < 0 {
                    return None;
                }
                let value = base.re.powf(exponent);
                Approximate::new(value, 0.0, value * (exponent * base.error / base.re).abs())
            }
            Kind::Exp(key) => {
                let key = of(key)?;
                let value = (exponent * key.re).exp();
                Approximate::new(value, 0.0, value * exponent.abs() * key.error)
            }
            Kind::Phase(key) => {
                let key = of(key)?;
                let angle = exponent * key.re;
                let error = exponent.abs() * key.error + f64::EPSILON * angle.abs();
                Approximate::new(angle.cos(), angle.sin(), error)
            }
            Kind::Call(function, argument) if exponent == 1.0 => {
                let u = of(argument)?;
                let (value, slope) = match function {
                    Function::Ln => (u.re.ln(), 1.0 / u.re),
                    Function::Atan => (u.re.atan(), 1.0),
                    Function::Asin => (u.re.asin(), 1.0 / (1.0 - u.re * u.re).sqrt()),
                    _ => return None,
                };
                Approximate::new(value, 0.0, slope.abs() * u.error)
            }
            Kind::Call(..) | Kind::Variable(_) | Kind::Opaque(_) => return None,
        })
    }
}
