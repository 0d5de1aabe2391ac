//! Generated functions in pairs of doubles.
//!
//! ψ and g evaluated at the unevaluated sum of a state and its remainder: what a level is pinned
//! by at a transition, and where ψ has so little slope that its rounding error matters. Sums and
//! products have about 104 bits, the elementary functions about 100. A divided difference has
//! those of a double: it is no part of ψ or g.
//!
//! The functions of an argument that is not small are reduced: eᵘ = 2^(k/8) eʳ, sin and cos by
//! multiples of π/2 (up to |u| of 2²⁰ or so; beyond it digits of u are lost like those of π).
//! Inverse functions take one step of Newton's method from that of a double, whose error is
//! squared by it.

use std::f64::consts::{FRAC_2_PI, LN_2, LOG2_E, SQRT_2};

use super::series::power_series;
use crate::arithmetic::Scalar;
use crate::arithmetic::double::{Double, Pair};
use crate::arithmetic::masked::{Mask, Masked};

/// What ln 2 as a double lacks: the next 53 bits.
const LN_2_LOW: f64 = 2.319_046_813_846_299_6e-17;

/// 2^(j/8) for j from 0 to 7.
const EIGHTHS: [Double; 8] = [
    Double::new(1.0, 0.0),
    Double::new(1.090_507_732_665_257_7, -3.046_782_079_812_471e-17),
    Double::new(1.189_207_115_002_721, 3.982_015_231_465_646e-17),
    Double::new(1.296_839_554_651_009_6, 2.538_250_279_488_831_5e-17),
    Double::new(SQRT_2, -9.667_293_313_452_913e-17),
    Double::new(1.542_210_825_407_940_7, 7.949_834_809_697_621e-17),
    Double::new(1.681_792_830_507_429, 8.199_010_020_581_497e-17),
    Double::new(1.834_008_086_409_342_4, 3.283_107_224_245_627e-17),
];

/// The coefficients of a power series: |u| ≤ π/4 to the 29th over 29! is 10⁻³⁴.
const TERMS: usize = 29;

/// 1/n!, with what the double lacks. (n! is a double up to 22!.)
const INVERSE_FACTORIALS: [Double; TERMS] = {
    let mut table = [Double::ONE; TERMS];
    let mut factorial = 1.0;
    let mut n = 1;
    while n < TERMS {
        factorial *= n as f64;
        table[n] = Double::inverse_of(factorial);
        n += 1;
    }
    table
};

/// COUNT of every other 1/n! as doubles, from `first` on.
const fn every_other<const COUNT: usize>(first: usize) -> [f64; COUNT] {
    let mut coefficients = [0.0; COUNT];
    let mut k = 0;
    while k < COUNT {
        coefficients[k] = INVERSE_FACTORIALS[first + 2 * k].high;
        k += 1;
    }
    coefficients
}

/// Σ xᵏ/(FIRST + 2k)!, FIRST being 0 or 1.
struct EveryOther<const FIRST: usize>;

impl<const FIRST: usize> EveryOther<FIRST> {
    /// The sum for |x| ≤ 1, with as many terms as count.
    fn sum(x: Double) -> Double {
        /// A quarter of ln 2/4, squared, is below it.
        const SMALL: f64 = 2e-3;
        /// The square of it is no part of the sum.
        const SMALLEST: f64 = 1e-17;
        let size = x.high.abs();
        if size <= SMALLEST {
            Self::by_pairs::<1, 1>(x)
        } else if size <= SMALL {
            Self::by_pairs::<5, 4>(x)
        } else {
            Self::by_pairs::<8, 6>(x)
        }
    }

    /// Over so many coefficients that are pairs and then so many doubles.
    ///
    /// By Horner's scheme in doubles, whose rounding errors make a polynomial that is evaluated
    /// beside it (Graillat, Langlois & Louvet, Compensated Horner scheme, 2005, algorithm 8): no sum
    /// waits for another one to be put in order.
    #[inline]
    fn by_pairs<const PAIRS: usize, const DOUBLES: usize>(x: Double) -> Double {
        let doubles = const { &every_other::<DOUBLES>(FIRST + 2 * PAIRS) };
        let mut sum = Double::from(power_series(x.high, doubles));
        for k in (0..PAIRS).rev() {
            let Double { high, low } = INVERSE_FACTORIALS[FIRST + 2 * k];
            let product = Double::product(sum.high, x.high);
            let cross = sum.high.fused(x.low, sum.low * x.high);
            // the coefficient is at least twice as large as the product
            let next = Double::fast_sum(high, product.high);
            sum = Double::new(next.high, (product.low + cross) + (next.low + low));
        }
        Double::fast_sum(sum.high, sum.low)
    }
}

impl Double {
    /// cosh r and sinh r, for |r| ≤ 1
    fn hyperbolic(self) -> (Self, Self) {
        let square = self * self;
        (
            EveryOther::<0>::sum(square),
            self * EveryOther::<1>::sum(square),
        )
    }

    /// cos u and sin u
    fn circular(self) -> (Self, Self) {
        let turns = (self.high * FRAC_2_PI).round();
        let r = if turns == 0.0 {
            self
        } else {
            self - Self::from(turns) * Self::FRAC_PI_2
        };
        let square = -(r * r);
        let (c, s) = (
            EveryOther::<0>::sum(square),
            r * EveryOther::<1>::sum(square),
        );
        match turns.rem_euclid(4.0) {
            1.0 => (-s, c),
            2.0 => (-c, -s),
            3.0 => (s, -c),
            _ => (c, s),
        }
    }

    /// u·2ᵏ for |k| ≤ 1022
    fn times_power_of_two(self, k: i32) -> Self {
        const BIAS: i32 = 1023;
        const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;
        let power = f64::from_bits(((k + BIAS) as u64) << MANTISSA);
        Self::new(self.high * power, self.low * power)
    }
}

/// The elementary functions, for some of which others are named.
impl Double {
    fn exp(self) -> Self {
        const EIGHTH: Double = Double::new(0.125 * LN_2, 0.125 * LN_2_LOW);
        let eighths = (self.high * (8.0 * LOG2_E)).round();
        if eighths.is_nan() || eighths.abs() >= 8.0 * 1020.0 {
            return Self::from(self.high.exp());
        }
        let r = self - Self::from(eighths) * EIGHTH;
        let (c, s) = r.hyperbolic();
        let whole = eighths as i32;
        let part = EIGHTHS[whole.rem_euclid(8) as usize];
        ((c + s) * part).times_power_of_two(whole.div_euclid(8))
    }

    fn ln(self) -> Self {
        let y = self.high.ln();
        if !y.is_finite() {
            return Self::from(y);
        }
        let ratio = self * Self::exp(Self::from(-y));
        Self::from(y) + (ratio - Self::from(1.0))
    }

    fn sin(self) -> Self {
        self.circular().1
    }

    fn cos(self) -> Self {
        self.circular().0
    }

    fn tan(self) -> Self {
        let (c, s) = self.circular();
        s / c
    }

    fn sinh(self) -> Self {
        if self.high.abs() <= 1.0 {
            return self.hyperbolic().1;
        }
        let e = Self::exp(self);
        Self::from(0.5) * (e - Self::from(1.0) / e)
    }

    fn cosh(self) -> Self {
        let e = Self::exp(self);
        Self::from(0.5) * (e + Self::from(1.0) / e)
    }

    fn tanh(self) -> Self {
        // beyond it 1 to the last digit, and e²ᵘ too large
        if self.high.abs() > 40.0 {
            return Self::from(1.0_f64.copysign(self.high));
        }
        Self::sinh(self) / Self::cosh(self)
    }

    fn asin(self) -> Self {
        let y = self.high.asin();
        let (c, s) = Self::from(y).circular();
        if c.high > 0.0 && y.is_finite() {
            Self::from(y) + (self - s) / c
        } else {
            Self::from(y)
        }
    }

    fn acos(self) -> Self {
        Self::FRAC_PI_2 - Self::asin(self)
    }

    fn atan(self) -> Self {
        let y = self.high.atan();
        if !self.high.is_finite() {
            return Self::from(y);
        }
        let (c, s) = Self::from(y).circular();
        Self::from(y) + (self * c - s) / (c + self * s)
    }
}

/// The functions of [`Double`], by lane; behind the semicolon those of a double, by lane.
macro_rules! by_lane {
    ($($function:ident)*; $($of_double:ident($($other:ident)?))*) => {
        $(
            #[inline]
            fn $function(self) -> Self {
                self.each(Double::$function)
            }
        )*
        $(
            fn $of_double(self $(, $other: Self)?) -> Self {
                Self::from(self.high.$of_double($($other.high)?))
            }
        )*
    };
}

impl<S: Masked> Scalar for Pair<S> {
    const ROUNDING: f64 = 1.0 / (1_u128 << 104) as f64;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::from(S::from_f64(value))
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self.high.to_f64()
    }

    #[inline]
    fn lane(self, lane: usize) -> f64 {
        self.high.lane(lane)
    }

    #[inline]
    fn by_lane(value: impl Fn(usize) -> f64) -> Self {
        Self::from(S::by_lane(value))
    }

    #[inline]
    fn fused(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    #[inline]
    fn abs(self) -> Self {
        let negative = S::from_f64(0.0).above(self.high);
        Self::new(
            negative.select(-self.high, self.high),
            negative.select(-self.low, self.low),
        )
    }

    fn sqrt(self) -> Self {
        self.each(Double::root)
    }

    fn powi(self, n: i32) -> Self {
        let one = Self::from_f64(1.0);
        let mut power = one;
        let (mut base, mut left) = (self, n.unsigned_abs());
        while left > 0 {
            if left % 2 == 1 {
                power *= base;
            }
            base *= base;
            left /= 2;
        }
        if n < 0 { one / power } else { power }
    }

    fn powf(self, v: Self) -> Self {
        (v * self.ln()).exp()
    }

    fn exp_product(self, b: Self) -> Self {
        (self * b).exp()
    }

    by_lane! {
        exp ln sin cos tan sinh cosh tanh asin acos atan;
        sinc() sinc_prime() sinhc() sinhc_prime()
        ln_dd(b) ln_dd_prime(b) asin_dd(b) asin_dd_prime(b) atan_dd(b) atan_dd_prime(b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two numbers agree to some thirty digits.
    fn assert_close(a: Double, b: Double, what: &str) {
        let difference = (a - b).high.abs();
        let size = a.high.abs().max(b.high.abs());
        assert!(difference <= 1e-29 * size, "{what}: {a:?} {b:?}");
    }

    /// Arguments that are no doubles, up to a few times a size.
    fn samples(size: f64) -> impl Iterator<Item = Double> {
        let thirds = (-20..=20).filter(|&k| k != 0);
        thirds.map(move |k| Double::from(0.37 * size * f64::from(k)) / Double::from(3.0))
    }

    #[test]
    fn known_digits() {
        // e, ln 2, sin 1, cos 1 and atan 1 = π/4 to 32 digits, as pairs
        let one = Double::from(1.0);
        let known = [
            (
                Scalar::exp(one),
                std::f64::consts::E,
                1.445_646_891_729_250_2e-16,
            ),
            (Scalar::ln(Double::from(2.0)), LN_2, LN_2_LOW),
            (
                Scalar::atan(one),
                std::f64::consts::FRAC_PI_4,
                3.061_616_997_868_383e-17,
            ),
        ];
        for (value, high, low) in known {
            assert_close(value, Double::new(high, low), "a constant");
        }
    }

    #[test]
    fn identities_hold_to_thirty_digits() {
        let one = Double::from(1.0);
        let sizes = [1.0, 0.1, 1e-3, 1e-9, 1e-20];
        for u in sizes.into_iter().flat_map(samples) {
            let (s, c) = (Scalar::sin(u), Scalar::cos(u));
            assert_close(s * s + c * c, one, "sin² + cos²");
            let (sh, ch) = (Scalar::sinh(u), Scalar::cosh(u));
            assert_close(ch * ch, one + sh * sh, "cosh² − sinh²");
            assert_close(Scalar::exp(u), ch + sh, "cosh + sinh");
            assert_close(Scalar::tanh(u) * ch, sh, "tanh");
            assert_close(Scalar::ln(Scalar::exp(u)) + one, u + one, "ln exp");
            assert_close(Scalar::exp(u) * Scalar::exp(-u), one, "exp u exp −u");
            // double angles reach other parts of the reductions
            let two = u + u;
            assert_close(Scalar::sin(two), Double::from(2.0) * (s * c), "sin 2u");
            assert_close(Scalar::tan(u) * c, s, "tan");
        }
    }

    #[test]
    fn inverse_functions_are_inverse() {
        for u in samples(1.0) {
            assert_close(Scalar::tan(Scalar::atan(u)), u, "tan atan");
            let v = Double::from(0.3) * u;
            if v.high.abs() < 0.9 {
                assert_close(Scalar::sin(Scalar::asin(v)), v, "sin asin");
                assert_close(Scalar::cos(Scalar::acos(v)), v, "cos acos");
            }
            let root = Scalar::sqrt(Scalar::abs(u));
            assert_close(root * root, Scalar::abs(u), "√u²");
            assert_close(Scalar::powi(u, 3), u * u * u, "u³");
            assert_close(Scalar::powi(u, -2) * (u * u), Double::from(1.0), "u⁻²");
            let power = Scalar::powf(Scalar::abs(u), Double::from(1.5));
            assert_close(power, Scalar::abs(u) * root, "u^(3/2)");
        }
    }
}
