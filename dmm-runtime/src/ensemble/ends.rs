//! Whether the lanes reach an interface in a step, from the values and the slopes of g at both
//! ends and its first coefficients; the mathematics is that of [`crate::events::ends`].

use super::register::{WIDTH, Wide};
use crate::arithmetic::Scalar;
use crate::arithmetic::lanes::Mask;
use crate::events::ends::Decay;
use crate::expansion::jet::FIRST;

/// g this many rounding errors of its terms away from zero is not distinguished from it.
const NOISE: f64 = 16.0;

/// What the ends of a step tell of an interface.
pub(super) struct Course {
    /// Where it is not reached.
    pub(super) free: Mask<WIDTH>,
    /// Where it is crossed once …
    pub(super) falls: Mask<WIDTH>,
    /// … and about how long after the start.
    pub(super) elapsed: Wide,
}

/// What is certain about steps `tau`, with the first coefficients of g, its value and
/// slope at the end, all positive in the region. The root at the start does not count if the
/// lanes are `active` from it.
#[inline(always)]
pub(super) fn course(
    c: &[Wide; FIRST],
    (b3, slope): (Wide, Wide),
    tau: Wide,
    decay: Decay,
    active: bool,
) -> Course {
    let n = Wide::from_f64;
    let (third, square) = (tau * n(1.0 / 3.0), tau * tau);
    let b0 = c[0];
    let b1 = c[1].fused(third, b0);
    let b2 = (-slope).fused(third, b3);
    let bend = n(3.0) * (b0 - (b1 + b1) + b2) - c[2] * square;
    let fourth = square * square;
    let (fourth_term, fifth_term) = (c[4].abs() * fourth, c[5].abs() * (fourth * tau));
    let others = fourth_term
        .max(fifth_term * n(decay.inverse))
        .max(bend.abs());
    let known = n(3.0).fused(fifth_term, fourth_term);
    let noise = n(NOISE * f64::ROUNDING) * (b0.abs() + b3.abs());
    let rest = n(decay.rest)
        .fused(others, known)
        .fused(n(1.0 / 12.0), noise);
    let zero = n(0.0);
    let inside = match active {
        true => Mask::all(true),
        false => b0.above(zero),
    };
    let free = b1
        .above(rest)
        .and(b2.above(rest))
        .and(b3.above(zero))
        .and(inside);
    let falls = (b0 - b1)
        .above(rest)
        .and((b1 - b2).above(rest + rest))
        .and((b2 - b3).above(rest));
    let once = falls.and(b0.above(zero)).and(b3.above(zero).not());
    Course {
        free,
        falls: once,
        elapsed: inverse(tau, (b0, c[1]), (b3, slope)),
    }
}

/// About where a function falls through zero, from its values and slopes at 0 and `tau`: the
/// cubic of the inverse function, or where that leaves the step, the chord.
#[inline(always)]
fn inverse(tau: Wide, (b0, d0): (Wide, Wide), (b3, d3): (Wide, Wide)) -> Wide {
    let n = Wide::from_f64;
    let change = b3 - b0;
    let u = -b0 / change;
    let v = n(1.0) - u;
    let cubic =
        tau * (u * u * (n(3.0) - u - u)) + change * (u * v) * ((v * d3 - u * d0) / (d0 * d3));
    let within = cubic.above(n(0.0)).and(tau.above(cubic));
    within.select(cubic, tau * u)
}
