//! Whether an interface is reached in a step, from the values and the slopes of g at both ends.
//!
//! The cubic H with these values and slopes differs from g = Σ gⱼ tʲ on a step over h by
//!
//! |g − H| ≤ s² (1 − s)² Σ (j − 3)(j − 2)/2 · |gⱼ| hʲ over j ≥ 4, s = t/h.
//!
//! Of the sum C the first two terms, |g₄| h⁴ + 3 |g₅| h⁵, are known. With coefficients that fall
//! off like φʲ, where φ is the step as a part of the radius of convergence, the others are at
//! most (1/(1 − φ)³ − 1 − 3φ) a with a = |g₄| h⁴. So that a coefficient that happens to vanish
//! does no harm, a is the largest of three: |g₄| h⁴, |g₅| h⁵/φ, and the difference of the
//! coefficients of order 2 of g and H, which is Σ (j − 3) gⱼ hʲ.
//!
//! As s (1 − s) ≤ 1/4, to be off by s² (1 − s)² C is less than to have the two inner Bernstein
//! coefficients of H off by C/12. Where all four are positive in spite of that, g is positive
//! throughout; where they fall in spite of it, g has one root at most, and a slope there.

use crate::scalar::Scalar;
use crate::series::jet::FIRST;

/// The estimate of the terms that are not known counts so many times.
const MARGIN: f64 = 1.5;
/// g this many rounding errors of its terms away from zero is not distinguished from it.
pub(super) const NOISE: f64 = 16.0;

/// What the ends of a step tell of an interface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Glance {
    /// It is not reached.
    Out,
    /// It is crossed once, about so long after the start.
    Once(f64),
    /// It may be reached.
    Near,
}

/// A step as the interfaces see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glimpse {
    /// The size of the step.
    pub(super) tau: f64,
    /// How the coefficients fall off.
    pub(super) decay: Decay,
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

impl Glimpse {
    /// A glance at an interface: from the first coefficients of g, its value and its slope at
    /// the end, and the sign of g in the region. It is `fresh` if the step starts on it; that
    /// root does not count.
    #[inline(always)]
    pub(super) fn at(
        self,
        c: &[f64; FIRST],
        (value, slope): (f64, f64),
        sign: f64,
        fresh: bool,
    ) -> Glance {
        let Self { tau, decay } = self;
        let (third, square) = (tau * (1.0 / 3.0), tau * tau);
        let (b0, b3) = (sign * c[0], sign * value);
        let b1 = (sign * c[1]).fused(third, b0);
        let b2 = (-sign * slope).fused(third, b3);
        // b₀ − 2b₁ + b₂ is a third of H's coefficient of order 2
        let bend = 3.0 * (b0 - (b1 + b1) + b2) - sign * c[2] * square;
        let fourth = square * square;
        let (fourth_term, fifth_term) = (c[4].abs() * fourth, c[5].abs() * (fourth * tau));
        let others = fourth_term.max(fifth_term * decay.inverse).max(bend.abs());
        let sum = decay
            .rest
            .fused(others, 3.0f64.fused(fifth_term, fourth_term));
        let noise = NOISE * f64::ROUNDING * (b0.abs() + b3.abs());
        let rest = sum.fused(1.0 / 12.0, noise);
        if b1 > rest && b2 > rest && b3 > 0.0 && (b0 > 0.0 || fresh) {
            return Glance::Out;
        }
        let falls = b0 - b1 > rest && b1 - b2 > rest + rest && b2 - b3 > rest;
        match b0 > 0.0 && b3 <= 0.0 && falls {
            true => Glance::Once(inverse(tau, (b0, sign * c[1]), (b3, sign * slope))),
            false => Glance::Near,
        }
    }
}

/// About where a function falls through zero, from its values and slopes at 0 and `tau`: the
/// cubic of the inverse function, or where that leaves the step, the chord.
#[inline]
fn inverse(tau: f64, (b0, d0): (f64, f64), (b3, d3): (f64, f64)) -> f64 {
    let change = b3 - b0;
    let u = -b0 / change;
    let v = 1.0 - u;
    let cubic = tau * (u * u * (3.0 - 2.0 * u)) + change * (u * v) * (v / d0 - u / d3);
    match cubic > 0.0 && cubic <= tau {
        true => cubic,
        false => tau * u,
    }
}
