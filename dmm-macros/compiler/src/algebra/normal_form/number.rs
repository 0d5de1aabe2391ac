//! Exact numbers: rationals that stay in machine words while they fit, and Gaussian rationals
//! a + b·i over them, the coefficients of the normal form.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive, Zero};

use super::super::Rational;

/// A rational number. Equal numbers have equal representations.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Number {
    /// numerator, denominator > 0, without a common factor.
    Small(i64, i64),
    /// What does not fit there.
    Big(Box<Rational>),
}

impl Number {
    pub(super) const ZERO: Self = Self::Small(0, 1);
    pub(super) const ONE: Self = Self::Small(1, 1);

    pub(super) fn integer(value: i64) -> Self {
        Self::Small(value, 1)
    }

    /// n/d, d > 0.
    pub(super) fn from_ratio(n: i64, d: i64) -> Self {
        Self::from_wide(n.into(), d.into())
    }

    /// The nearest double, if it is finite.
    pub(super) fn to_f64(&self) -> Option<f64> {
        let value = match self {
            Self::Small(n, d) => *n as f64 / *d as f64,
            Self::Big(value) => value.to_f64()?,
        };
        value.is_finite().then_some(value)
    }

    pub(super) fn from_rational(value: &Rational) -> Self {
        match (value.numer().to_i64(), value.denom().to_i64()) {
            (Some(numerator), Some(denominator)) => Self::Small(numerator, denominator),
            _ => Self::Big(Box::new(value.clone())),
        }
    }

    pub(super) fn to_rational(&self) -> Rational {
        match self {
            Self::Small(n, d) => Rational::new_raw(BigInt::from(*n), BigInt::from(*d)),
            Self::Big(value) => (**value).clone(),
        }
    }

    fn from_wide(numerator: i128, denominator: i128) -> Self {
        let divisor = numerator.gcd(&denominator);
        let (n, d) = (numerator / divisor, denominator / divisor);
        match (i64::try_from(n), i64::try_from(d)) {
            (Ok(n), Ok(d)) => Self::Small(n, d),
            _ => Self::Big(Box::new(Rational::new_raw(n.into(), d.into()))),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        matches!(self, Self::Small(0, _))
    }

    pub(super) fn is_one(&self) -> bool {
        matches!(self, Self::Small(1, 1))
    }

    pub(super) fn is_negative(&self) -> bool {
        match self {
            Self::Small(n, _) => *n < 0,
            Self::Big(value) => value.is_negative(),
        }
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        if let (Self::Small(a, b), Self::Small(c, d)) = (self, other) {
            if *b == 1
                && *d == 1
                && let Some(sum) = a.checked_add(*c)
            {
                return Self::Small(sum, 1);
            }
            let (a, b, c, d) = (
                i128::from(*a),
                i128::from(*b),
                i128::from(*c),
                i128::from(*d),
            );
            // |a·d| and |c·b| are below 2¹²⁶
            return Self::from_wide(a * d + c * b, b * d);
        }
        Self::from_rational(&(self.to_rational() + other.to_rational()))
    }

    pub(super) fn mul(&self, other: &Self) -> Self {
        if let (Self::Small(a, b), Self::Small(c, d)) = (self, other) {
            if *b == 1
                && *d == 1
                && let Some(product) = a.checked_mul(*c)
            {
                return Self::Small(product, 1);
            }
            let numerator = i128::from(*a) * i128::from(*c);
            return Self::from_wide(numerator, i128::from(*b) * i128::from(*d));
        }
        Self::from_rational(&(self.to_rational() * other.to_rational()))
    }

    pub(super) fn neg(&self) -> Self {
        match self {
            Self::Small(n, d) => match n.checked_neg() {
                Some(n) => Self::Small(n, *d),
                None => Self::from_wide(-i128::from(*n), i128::from(*d)),
            },
            Self::Big(value) => Self::from_rational(&-(**value).clone()),
        }
    }

    /// 1/self; `None` for zero.
    pub(super) fn recip(&self) -> Option<Self> {
        match self {
            Self::Small(0, _) => None,
            Self::Small(n, d) if *n > 0 => Some(Self::Small(*d, *n)),
            Self::Small(n, d) => Some(Self::from_wide(-i128::from(*d), -i128::from(*n))),
            Self::Big(value) => Some(Self::from_rational(&value.recip())),
        }
    }

    /// What arithmetic with it takes, that of a small one being 1: of long numbers it is the
    /// cancelling of common factors, whose time grows with the square of their length.
    fn work(&self) -> usize {
        match self {
            Self::Small(..) => 1,
            Self::Big(value) => {
                let bits = (value.numer().bits() + value.denom().bits()) as usize;
                8 + bits / 3 + bits.saturating_mul(bits) / 4_096
            }
        }
    }

    /// The integer, if it is one that fits.
    pub(super) fn as_integer(&self) -> Option<i64> {
        match self {
            Self::Small(n, 1) => Some(*n),
            _ => None,
        }
    }

    /// The positive "greatest common divisor" of two rationals: gcd of the numerators over lcm
    /// of the denominators.
    pub(super) fn gcd(&self, other: &Self) -> Self {
        let (a, b) = (self.to_rational(), other.to_rational());
        let numerator = a.numer().gcd(b.numer());
        let denominator = a.denom().lcm(b.denom());
        if numerator.is_zero() {
            return Self::ONE;
        }
        Self::from_rational(&Rational::new(numerator, denominator))
    }
}

/// A Gaussian rational re + im·i.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Coefficient {
    pub(super) re: Number,
    pub(super) im: Number,
}

impl Coefficient {
    pub(super) const ONE: Self = Self {
        re: Number::ONE,
        im: Number::ZERO,
    };
    pub(super) const I: Self = Self {
        re: Number::ZERO,
        im: Number::ONE,
    };

    pub(super) fn real(re: Number) -> Self {
        Self {
            re,
            im: Number::ZERO,
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }

    pub(super) fn is_one(&self) -> bool {
        self.re.is_one() && self.im.is_zero()
    }

    pub(super) fn is_real(&self) -> bool {
        self.im.is_zero()
    }

    /// What arithmetic with it takes, that of a small real one being 1.
    pub(super) fn work(&self) -> usize {
        if self.is_real() {
            self.re.work()
        } else {
            self.re.work() + self.im.work()
        }
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        let im = if self.is_real() && other.is_real() {
            Number::ZERO
        } else {
            self.im.add(&other.im)
        };
        Self {
            re: self.re.add(&other.re),
            im,
        }
    }

    pub(super) fn mul(&self, other: &Self) -> Self {
        if self.is_real() && other.is_real() {
            Self::real(self.re.mul(&other.re))
        } else if self.is_real() {
            other.scaled(&self.re)
        } else if other.is_real() {
            self.scaled(&other.re)
        } else {
            Self {
                re: self.re.mul(&other.re).add(&self.im.mul(&other.im).neg()),
                im: self.re.mul(&other.im).add(&self.im.mul(&other.re)),
            }
        }
    }

    fn scaled(&self, factor: &Number) -> Self {
        Self {
            re: self.re.mul(factor),
            im: self.im.mul(factor),
        }
    }

    pub(super) fn neg(&self) -> Self {
        Self {
            re: self.re.neg(),
            im: self.im.neg(),
        }
    }

    pub(super) fn conjugate(&self) -> Self {
        Self {
            re: self.re.clone(),
            im: self.im.neg(),
        }
    }

    /// 1/self; `None` for zero.
    pub(super) fn recip(&self) -> Option<Self> {
        if self.is_real() {
            return self.re.recip().map(Self::real);
        }
        let square = self.re.mul(&self.re).add(&self.im.mul(&self.im));
        Some(self.conjugate().scaled(&square.recip()?))
    }
}
