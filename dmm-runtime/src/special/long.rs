//! Fours of doubles.
//!
//! The derivatives of the divided differences of arc sine and arc tangent vanish on a curve in
//! the plane of their two arguments. Of the 2¹⁰⁶ pairs of doubles with given exponents some lie
//! so close to it that the terms agree in about 106 bits; 53 more are wanted. There, and only
//! there, the terms are evaluated as unevaluated sums of four doubles, about 205 bits.
//!
//! Sums and products are collected exactly and distilled by repeated error-free vector sums
//! (Ogita, Rump & Oishi 2005, SIAM J. Sci. Comput. 26(6), algorithm 4.3), whose error after K
//! of them is 2⁻⁵³ᴷ of the terms.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::double::Double;
use super::extended::Extended;

/// An unevaluated sum of four doubles, in decreasing order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Long([f64; 4]);

impl Long {
    const PASSES: usize = 5;

    /// Terms of the series of C for |x| ≤ 2⁻⁸.
    const ARC_TERMS: usize = 26;

    /// The sum of `terms`.
    fn distil<const N: usize>(mut terms: [f64; N]) -> Self {
        for _ in 0..Self::PASSES {
            for index in (1..N).rev() {
                let Double { high, low } = Double::sum(terms[index - 1], terms[index]);
                (terms[index - 1], terms[index]) = (high, low);
            }
        }
        let mut leading = [0.0; 4];
        let nonzero = terms.into_iter().filter(|&term| term != 0.0);
        for (place, term) in leading.iter_mut().zip(nonzero) {
            *place = term;
        }
        Self(leading)
    }
}

impl From<f64> for Long {
    fn from(value: f64) -> Self {
        Self([value, 0.0, 0.0, 0.0])
    }
}

impl Neg for Long {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|term| -term))
    }
}

impl Add for Long {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let ([a, b, c, d], [p, q, r, s]) = (self.0, other.0);
        Self::distil([a, p, b, q, c, r, d, s])
    }
}

impl Sub for Long {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Long {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let ([a, b, c, d], [p, q, r, s]) = (self.0, other.0);
        let product = Double::product;
        let (ap, aq, bp) = (product(a, p), product(a, q), product(b, p));
        let (ar, bq, cp) = (product(a, r), product(b, q), product(c, p));
        Self::distil([
            ap.high,
            ap.low,
            aq.high,
            bp.high,
            aq.low,
            bp.low,
            ar.high,
            bq.high,
            cp.high,
            ar.low,
            bq.low,
            cp.low,
            a * s,
            b * r,
            c * q,
            d * p,
        ])
    }
}

impl Div for Long {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let mut remainder = self;
        let digits = [(); 5].map(|()| {
            let digit = remainder.high() / other.high();
            remainder = remainder - other * Self::from(digit);
            digit
        });
        Self::distil(digits)
    }
}

impl Extended for Long {
    const CERTAIN: f64 = 0.0;

    const TERMS: usize = 14;

    const FRAC_PI_2: Self = Self([
        std::f64::consts::FRAC_PI_2,
        super::double::FRAC_PI_2_LOW,
        -1.497_384_904_859_169_8e-33,
        5.562_271_104_316_826e-50,
    ]);

    fn high(self) -> f64 {
        self.0[0]
    }

    fn sqrt(self) -> Self {
        let mut root = Self::from(self.high().sqrt());
        if root.high() == 0.0 {
            return root;
        }
        // The digits double with each of Newton's steps.
        for _ in 0..2 {
            let twice = root + root;
            root = root + (self - root * root) / twice;
        }
        root
    }

    fn arc_remainder(self) -> Self {
        if self.high().abs() > 1.0 / 256.0 {
            return self.arc_remainder_by_halving();
        }
        let one = Self::from(1.0);
        (0..Self::ARC_TERMS).rev().fold(Self::from(0.0), |sum, k| {
            one / Self::from((2 * k + 3) as f64) - self * sum
        })
    }
}
