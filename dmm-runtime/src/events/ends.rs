//! Whether an interface is reached in a Taylor step.
//!
//! Along the step g = Σ gⱼ tʲ differs from the [`Cubic`] H through its ends by
//!
//! |g − H| ≤ s² (1 − s)² Σ (j − 3)(j − 2)/2 · |gⱼ| hʲ over j ≥ 4, s = t/h.
//!
//! Of the sum C the first two terms, |g₄| h⁴ + 3 |g₅| h⁵, are known. With coefficients that fall
//! off like φʲ, where φ is the step as a part of the radius of convergence, the others are at
//! most (1/(1 − φ)³ − 1 − 3φ) a with a = |g₄| h⁴. So that a coefficient that happens to vanish
//! does no harm, a is the largest of three: |g₄| h⁴, |g₅| h⁵/φ, and the difference of the
//! coefficients of order 2 of g and H, which is Σ (j − 3) gⱼ hʲ.

use crate::arithmetic::masked::Masked;
use crate::arithmetic::noise;
use crate::events::cubic::{Bounds, Course, Cubic, Reading};
use crate::expansion::jet::FIRST;

/// The estimate of the terms that are not known counts so many times.
const MARGIN: f64 = 1.5;

/// A step as the interfaces see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ends<S = f64> {
    /// The size of the step.
    pub(crate) tau: S,
    /// How the coefficients fall off.
    pub(crate) decay: Decay,
}

/// How coefficients fall off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decay {
    /// 1/φ
    pub(crate) inverse: f64,
    /// 1/(1 − φ)³ − 1 − 3φ, with its margin
    pub(crate) rest: f64,
}

impl Decay {
    /// With steps of this part φ of the radius of convergence.
    pub(crate) fn new(fraction: f64) -> Self {
        let tail = 1.0 - fraction;
        Self {
            inverse: 1.0 / fraction,
            rest: MARGIN * (1.0 / (tail * tail * tail) - 1.0 - 3.0 * fraction),
        }
    }
}

impl<S: Masked> Ends<S> {
    /// The cubic of an interface, positive in the region where g has this sign, and how far g may
    /// be from it: from the first coefficients of g, its value and its slope at the end.
    #[inline(always)]
    pub(crate) fn cubic(
        self,
        c: &[S; FIRST],
        (value, slope): (S, S),
        sign: f64,
    ) -> (Cubic<S>, Bounds<S>) {
        let Self { tau, decay } = self;
        let n = S::from_f64;
        let sign = n(sign);
        let reading = |value: S, rate: S| Reading {
            value: sign * value,
            rate: sign * rate,
        };
        let cubic = Cubic::new(reading(c[0], c[1]), reading(value, slope), tau);
        let [b0, b1, b2, b3] = cubic.coefficients;
        let square = tau * tau;
        // b₀ − 2b₁ + b₂ is a third of H's coefficient of order 2
        let bend = n(3.0) * (b0 - (b1 + b1) + b2) - sign * c[2] * square;
        let fourth = square * square;
        let (fourth_term, fifth_term) = (c[4].abs() * fourth, c[5].abs() * (fourth * tau));
        let others = fourth_term
            .max(fifth_term * n(decay.inverse))
            .max(bend.abs());
        let known = n(3.0).fused(fifth_term, fourth_term);
        let bounds = Bounds {
            truncation: n(decay.rest).fused(others, known),
            noise: noise(b0.abs() + b3.abs()),
            ends: n(0.0),
        };
        (cubic, bounds)
    }
}

impl Ends {
    /// What is certain about an interface. The guard `is_active` if the step starts on it; that
    /// root does not count.
    #[inline(always)]
    pub(crate) fn course(
        self,
        c: &[f64; FIRST],
        end: (f64, f64),
        sign: f64,
        is_active: bool,
    ) -> Course {
        let (cubic, bounds) = self.cubic(c, end, sign);
        cubic.course(bounds, is_active)
    }
}
