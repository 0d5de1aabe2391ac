//! Pairs of doubles: numbers of about 31 digits, as unevaluated sums of two doubles.
//!
//! Sums and products are those of Dekker (Numer. Math. 18, 1971) and Knuth. The elementary
//! functions are series after a reduction of the argument, or a Newton step on one of them. The
//! reference solution of a study needs them; nothing of the library is used, so that it cannot
//! be wrong in the same way.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// high + low, with |low| at most half a unit in the last place of high.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Pair {
    pub(super) high: f64,
    pub(super) low: f64,
}

/// a + b and its rounding error.
#[inline]
fn two_sum(a: f64, b: f64) -> Pair {
    let high = a + b;
    let moved = high - a;
    let low = (a - (high - moved)) + (b - moved);
    Pair { high, low }
}

/// The same where |a| ≥ |b|.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> Pair {
    let high = a + b;
    Pair {
        high,
        low: b - (high - a),
    }
}

/// a = high + low, with 26 bits each (Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    const FACTOR: f64 = 134_217_729.0;
    let scaled = FACTOR * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

/// ab and its rounding error.
#[inline]
fn two_product(a: f64, b: f64) -> Pair {
    let high = a * b;
    let (a1, a0) = split(a);
    let (b1, b0) = split(b);
    let low = ((a1 * b1 - high) + a1 * b0 + a0 * b1) + a0 * b0;
    Pair { high, low }
}

impl Pair {
    pub(super) const ONE: Self = Self::new(1.0);
    const LN_2: Self = Self {
        high: std::f64::consts::LN_2,
        low: 2.319_046_813_846_299_6e-17,
    };

    pub(super) const fn new(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    /// The nearest double.
    pub(super) fn to_double(self) -> f64 {
        self.high + self.low
    }

    /// −1 or 1; 0 where it is 0.
    pub(super) fn sign(self) -> f64 {
        match self.high {
            0.0 => 0.0,
            high => high.signum(),
        }
    }

    /// self · 2ⁿ
    fn times_power_of_two(self, n: i32) -> Self {
        // in two factors: 2ⁿ alone may leave the range
        let half = f64::from(n / 2).exp2();
        let rest = f64::from(n - n / 2).exp2();
        Self {
            high: self.high * half * rest,
            low: self.low * half * rest,
        }
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        let product = two_product(self.high, factor);
        quick_two_sum(product.high, product.low + self.low * factor)
    }

    pub(super) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::new(self.high.sqrt());
        }
        let root = self.high.sqrt();
        let rest = self - two_product(root, root);
        quick_two_sum(root, rest.high / (2.0 * root))
    }

    pub(super) fn exp(self) -> Self {
        if !(-700.0..=700.0).contains(&self.high) {
            return Self::new(self.high.exp());
        }
        /// exp x = exp(x/2ⁿ)^(2ⁿ)
        const HALVINGS: i32 = 8;
        let k = (self.high / Self::LN_2.high).round();
        let reduced = (self - Self::LN_2.times(k)).times_power_of_two(-HALVINGS);
        // exp − 1, which keeps its digits when it is squared
        let (mut sum, mut term) = (reduced, reduced);
        for n in 2..=10 {
            term = term * reduced / Self::new(f64::from(n));
            sum = sum + term;
        }
        for _ in 0..HALVINGS {
            sum = sum.times(2.0) + sum * sum;
        }
        (sum + Self::ONE).times_power_of_two(k as i32)
    }

    pub(super) fn ln(self) -> Self {
        if !(self.high > 0.0 && self.high.is_finite()) {
            return Self::new(self.high.ln());
        }
        // one Newton step for exp y = x
        let y = Self::new(self.high.ln());
        y + (self * (-y).exp() - Self::ONE)
    }

    /// (sin x, cos x); |x| below 10⁶.
    pub(super) fn sin_cos(self) -> (Self, Self) {
        /// π/2 but for 10⁻³⁷.
        const HALF_PI: [f64; 3] = [
            1.570_796_326_734_125_6,
            6.077_100_506_303_966e-11,
            2.022_266_248_795_950_6e-21,
        ];
        let k = (self.high * std::f64::consts::FRAC_2_PI).round();
        let mut x = self;
        for part in HALF_PI {
            x = x - two_product(k, part);
        }
        let square = x * x;
        let series = |mut term: Self, first: i32| {
            let mut sum = term;
            for n in (first..first + 28).step_by(2) {
                term = -(term * square) / Self::new(f64::from(n * (n + 1)));
                sum = sum + term;
            }
            sum
        };
        let (sin, cos) = (series(x, 2), series(Self::ONE, 1));
        match k.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    pub(super) fn atan(self) -> Self {
        // one Newton step for sin y = x cos y
        let y = Self::new(self.high.atan());
        let (sin, cos) = y.sin_cos();
        y + (self * cos - sin) / (cos + self * sin)
    }

    pub(super) fn tanh(self) -> Self {
        if self.high.abs() > 300.0 {
            return Self::new(self.high.signum());
        }
        let square = self.times(2.0).exp();
        (square - Self::ONE) / (square + Self::ONE)
    }
}

impl Add for Pair {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let high = two_sum(self.high, other.high);
        let low = two_sum(self.low, other.low);
        let sum = quick_two_sum(high.high, high.low + low.high);
        quick_two_sum(sum.high, sum.low + low.low)
    }
}

impl Neg for Pair {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for Pair {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Pair {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        let rest = self.high * other.low + self.low * other.high;
        quick_two_sum(product.high, product.low + rest)
    }
}

impl Div for Pair {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        if !first.is_finite() {
            return Self::new(first);
        }
        let rest = self - other.times(first);
        let second = rest.high / other.high;
        let rest = rest - other.times(second);
        quick_two_sum(first, second) + Self::new(rest.high / other.high)
    }
}

impl PartialOrd for Pair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            order => order,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some units in the last place of a pair.
    const ACCURACY: f64 = 3e-31;

    fn close(a: Pair, b: Pair) {
        let error = (a - b).to_double().abs();
        let size = b.to_double().abs().max(1.0);
        assert!(error <= ACCURACY * size, "{a:?} {b:?}: {error:e}");
    }

    #[test]
    fn functions_are_known_to_31_digits() {
        // the second double of each constant: mpmath, 50 digits
        let e = Pair {
            high: std::f64::consts::E,
            low: 1.445_646_891_729_250_2e-16,
        };
        let pi = Pair {
            high: std::f64::consts::PI,
            low: 1.224_646_799_147_353_2e-16,
        };
        close(Pair::ONE.exp(), e);
        close(Pair::new(2.0).ln(), Pair::LN_2);
        close(Pair::ONE.atan().times(4.0), pi);
        close(pi.times(7.0 / 2.0).sin_cos().0, Pair::new(-1.0));
        close(pi.times(9.0).sin_cos().0, Pair::new(0.0));
        close(
            Pair::new(2.0).sqrt() * Pair::new(2.0).sqrt(),
            Pair::new(2.0),
        );
    }

    #[test]
    fn functions_satisfy_their_identities() {
        for k in -40_i32..=40 {
            let x = Pair::new(f64::from(k) * 0.37) / Pair::new(3.0);
            let (sin, cos) = x.sin_cos();
            close(sin * sin + cos * cos, Pair::ONE);
            let (double, _) = x.times(2.0).sin_cos();
            close(double, (sin * cos).times(2.0));
            close(x.exp() * (-x).exp(), Pair::ONE);
            close(x.exp().ln(), x);
            let (sin, cos) = x.atan().sin_cos();
            close(sin / cos, x);
            let inverse = ((Pair::ONE + x.tanh()) / (Pair::ONE - x.tanh())).ln();
            if k.abs() < 20 {
                close(inverse.times(0.5), x);
            }
        }
    }
}
