//! Doubles that remember which operation first had no finite value: to say in an error where a
//! formula leaves its domain or overflows.

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::Scalar;

/// The first operation on finite numbers whose result is not finite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Fault {
    /// It is too large for a double.
    Overflow,
    /// The function is not defined at this argument.
    Undefined(&'static str, f64),
}

/// A double, and what was the matter with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Traced {
    pub(crate) value: f64,
    pub(crate) fault: Option<Fault>,
}

impl Traced {
    /// The result of an operation on `operands`, with its fault if it is not finite.
    fn of(value: f64, operands: &[Self], fault: Fault) -> Self {
        let earlier = operands.iter().find_map(|operand| operand.fault);
        let own = (!value.is_finite()).then_some(fault);
        Self {
            value,
            fault: earlier.or(own),
        }
    }

    /// The result of a function that is defined everywhere.
    fn total(value: f64, operands: &[Self]) -> Self {
        Self::of(value, operands, Fault::Overflow)
    }

    /// The result of a function, undefined where it is not a number or infinite.
    fn partial(self, value: f64, function: &'static str) -> Self {
        Self::of(value, &[self], Fault::Undefined(function, self.value))
    }
}

impl PartialEq for Traced {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Traced {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Add for Traced {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::total(self.value + b.value, &[self, b])
    }
}

impl Sub for Traced {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::total(self.value - b.value, &[self, b])
    }
}

impl Mul for Traced {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::total(self.value * b.value, &[self, b])
    }
}

impl Div for Traced {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let fault = if b.value == 0.0 {
            Fault::Undefined("1/u", b.value)
        } else {
            Fault::Overflow
        };
        Self::of(self.value / b.value, &[self, b], fault)
    }
}

impl Neg for Traced {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            ..self
        }
    }
}

impl AddAssign for Traced {
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl SubAssign for Traced {
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl MulAssign for Traced {
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl DivAssign for Traced {
    fn div_assign(&mut self, b: Self) {
        *self = *self / b;
    }
}

/// A function of one argument by its name, undefined where a double has no finite value of it.
macro_rules! partial {
    ($($function:ident $name:literal)*) => {
        $(fn $function(self) -> Self {
            self.partial(Scalar::$function(self.value), $name)
        })*
    };
}

/// A function of one argument that overflows where it is not finite.
macro_rules! total {
    ($($function:ident)*) => {
        $(fn $function(self) -> Self {
            Self::total(Scalar::$function(self.value), &[self])
        })*
    };
}

/// A divided difference, undefined where that of doubles has no finite value.
macro_rules! difference {
    ($($function:ident $name:literal)*) => {
        $(fn $function(self, b: Self) -> Self {
            let value = Scalar::$function(self.value, b.value);
            Self::of(value, &[self, b], Fault::Undefined($name, self.value.min(b.value)))
        })*
    };
}

impl Scalar for Traced {
    const ROUNDING: f64 = f64::ROUNDING;

    fn from_f64(value: f64) -> Self {
        Self { value, fault: None }
    }

    fn to_f64(self) -> f64 {
        self.value
    }

    fn fused(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    partial! {
        sqrt "sqrt(u)" ln "ln(u)" asin "asin(u)" acos "acos(u)" tan "tan(u)"
    }

    total! {
        abs exp sin cos sinh cosh tanh atan sinc sinc_prime sinhc sinhc_prime
    }

    difference! {
        ln_dd "ln(u)" ln_dd_prime "ln(u)" asin_dd "asin(u)" asin_dd_prime "asin(u)"
        atan_dd "atan(u)" atan_dd_prime "atan(u)"
    }

    fn powi(self, n: i32) -> Self {
        let fault = if self.value == 0.0 {
            Fault::Undefined("1/u", self.value)
        } else {
            Fault::Overflow
        };
        Self::of(Scalar::powi(self.value, n), &[self], fault)
    }

    fn powf(self, v: Self) -> Self {
        let value = Scalar::powf(self.value, v.value);
        let fault = if value.is_nan() || self.value == 0.0 {
            Fault::Undefined("u^k", self.value)
        } else {
            Fault::Overflow
        };
        Self::of(value, &[self, v], fault)
    }

    fn exp_product(self, b: Self) -> Self {
        Self::total(Scalar::exp_product(self.value, b.value), &[self, b])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn traced(value: f64) -> Traced {
        Traced::from_f64(value)
    }

    #[test]
    fn the_first_fault_is_remembered() {
        let x = traced(-1.0);
        let fault = (traced(2.0) * Scalar::ln(x) + traced(1.0)).fault;
        assert_eq!(fault, Some(Fault::Undefined("ln(u)", -1.0)));
        let both = Scalar::sqrt(x) / traced(0.0);
        assert_eq!(both.fault, Some(Fault::Undefined("sqrt(u)", -1.0)));
        assert_eq!(
            (traced(1.0) / traced(0.0)).fault,
            Some(Fault::Undefined("1/u", 0.0))
        );
        assert_eq!(
            Scalar::powf(x, traced(0.5)).fault,
            Some(Fault::Undefined("u^k", -1.0))
        );
        assert_eq!(Scalar::powi(traced(1e200), 2).fault, Some(Fault::Overflow));
        assert_eq!(Scalar::exp(traced(710.0)).fault, Some(Fault::Overflow));
        assert_eq!((traced(1e200) * traced(1e200)).fault, Some(Fault::Overflow));
        assert_eq!(Scalar::exp(x).fault, None);
    }
}
