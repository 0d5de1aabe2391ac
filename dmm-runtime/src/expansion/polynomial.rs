//! Polynomials given by their coefficients: values, the step that a series allows, real roots.

use crate::arithmetic::Scalar;
use crate::arithmetic::masked::Masked;

/// Σ cⱼ hʲ over j ≥ 1, added to `rest`.
///
/// In blocks of four coefficients by powers of h⁴, from the lowest on: the newest coefficients
/// enter last, with one product.
#[inline(always)]
pub(crate) fn increment<S: Scalar, const P: usize>(c: &[S; P], h: S, rest: S) -> S {
    let h2 = h * h;
    let h4 = h2 * h2;
    let powers = [h, h2];
    let mut sums = [block(c, 1, powers), S::from_f64(0.0)];
    let mut power = S::from_f64(1.0);
    let mut number = 1;
    while 4 * number + 1 < P {
        power *= h4;
        let which = number % 2;
        sums[which] = block(c, 4 * number + 1, powers).fused(power, sums[which]);
        number += 1;
    }
    (sums[0] + sums[1]).fused(h, rest)
}

/// Σ c₍f₊ⱼ₎ hʲ over j < 4, with f the `first`, by the powers h and h².
// a function, as closures are not inlined for certain, and what is not does not compute in lanes
#[inline(always)]
fn block<S: Scalar, const P: usize>(c: &[S; P], first: usize, [h, h2]: [S; 2]) -> S {
    match &c[first..] {
        [c0] => *c0,
        [c0, c1] => c1.fused(h, *c0),
        [c0, c1, c2] => c2.fused(h2, c1.fused(h, *c0)),
        [c0, c1, c2, c3, ..] => c3.fused(h, *c2).fused(h2, c1.fused(h, *c0)),
        [] => S::from_f64(0.0),
    }
}

/// (p(h), p′(h))
pub(crate) fn value_and_slope(coefficients: &[f64], h: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for &c in coefficients.iter().rev() {
        slope = slope * h + value;
        value = value * h + c;
    }
    (value, slope)
}

/// m^(−1/k) for m > 0, at most 7 % too large, by integer arithmetic on the exponent: the bits
/// of a double are, but for a constant, its logarithm. Half of them are enough for a step, and
/// are multiplied by one instruction in lanes too.
#[inline(always)]
pub(crate) fn inverse_root<S: Masked>(m: S, k: usize) -> S {
    const ONE: i64 = 1023 << 52;
    let inverse = (1i64 << 31) / k as i64;
    let mut root = m;
    for lane in 0..S::LANES {
        let logarithm = (ONE - m.lane(lane).to_bits() as i64) >> 32;
        root.set_lane(
            lane,
            f64::from_bits((ONE + ((logarithm * inverse) << 1)) as u64),
        );
    }
    root
}

/// The first root of a polynomial in an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Roots {
    /// A part of the interval with exactly this one root, in which the sign changes.
    pub(crate) first: Option<(f64, f64)>,
    /// How many times zero was touched before, within rounding errors.
    pub(crate) touches: u32,
}

/// The first root in (0, `h`] at which p, positive at 0, becomes negative.
///
/// By Descartes' rule of signs for the Bernstein coefficients and bisection (Lane & Riesenfeld,
/// BIT 21, 1981): without a change of sign there is no root, with one there is one. What lies
/// less than `rounding` below zero counts as a touch, and as a root where it is the end of a fall.
pub(crate) fn first_root(coefficients: &[f64], h: f64, rounding: f64) -> Roots {
    let mut search = Search {
        rounding,
        touches: 0,
    };
    let mut bernstein = bernstein(coefficients, h);
    let (values, count) = &mut bernstein;
    if let [.., before, end] = &mut values[..*count]
        && end.abs() <= rounding
        && *end < *before
    {
        *end = 0.0;
    }
    let first = search.first(&bernstein, (0.0, h), DEEPEST);
    Roots {
        first,
        touches: search.touches,
    }
}

/// Whether p, positive at 0, comes closer to zero than `band` in (0, `h`] without falling through
/// all of the band: it returns from there, or may have been elsewhere.
pub(crate) fn dips(coefficients: &[f64], h: f64, band: f64) -> bool {
    let mut shifted = [0.0; MOST];
    let count = coefficients.len().min(MOST);
    let shifted = &mut shifted[..count];
    let mut falls_below = |level: f64| {
        shifted.copy_from_slice(&coefficients[..count]);
        shifted[0] -= level;
        shifted[0] <= 0.0 || first_root(shifted, h, 0.0).first.is_some()
    };
    if !falls_below(band) || falls_below(-band) {
        return false;
    }
    let (end, slope) = value_and_slope(coefficients, h);
    // on its way through the band at the end
    !(end.abs() <= band && slope < 0.0)
}

/// The root in an interval in which p changes its sign from positive to negative, by Newton's
/// method safeguarded by bisection.
pub(crate) fn root(coefficients: &[f64], lower: f64, upper: f64) -> f64 {
    const MOST: u32 = 100;
    let (mut lower, mut upper) = (lower, upper);
    let mut h = f64::midpoint(lower, upper);
    for _ in 0..MOST {
        let (value, slope) = value_and_slope(coefficients, h);
        if value > 0.0 {
            lower = h;
        } else {
            upper = h;
        }
        let newton = h - value / slope;
        let next = if newton > lower && newton < upper {
            newton
        } else {
            f64::midpoint(lower, upper)
        };
        if (next - h).abs() <= 2.0 * f64::EPSILON * upper {
            return next;
        }
        h = next;
    }
    h
}

/// Bisections of a step.
const DEEPEST: u32 = 40;

/// The most coefficients.
const MOST: usize = crate::series::MOST_COEFFICIENTS;

type Bernstein = ([f64; MOST], usize);

/// The Bernstein coefficients of p on [0, h].
fn bernstein(coefficients: &[f64], h: f64) -> Bernstein {
    let count = coefficients.len().min(MOST);
    let degree = (count - 1) as f64;
    // cⱼ hʲ / binomial(n, j), then sums as in Pascal's triangle
    let mut values = [0.0; MOST];
    let mut factor = 1.0;
    for (j, (value, &c)) in values.iter_mut().zip(coefficients).enumerate() {
        // the power may have overflowed where there is no coefficient
        *value = if c == 0.0 { 0.0 } else { c * factor };
        let j = j as f64;
        factor *= h * (j + 1.0) / (degree - j).max(1.0);
    }
    for round in 1..count {
        for j in (round..count).rev() {
            values[j] += values[j - 1];
        }
    }
    (values, count)
}

/// A search under way.
struct Search {
    rounding: f64,
    touches: u32,
}

impl Search {
    /// The coefficients on two parts of an interval, and where it is split: in the middle, or
    /// beside it where p is zero within rounding errors there, so that what lies below zero by
    /// less than those is not cut in two, each with a change of sign. Nothing if p is zero within
    /// rounding errors at all of these places.
    fn split(&self, values: &[f64]) -> Option<(f64, [Bernstein; 2])> {
        const PLACES: [f64; 5] = [0.5, 0.375, 0.625, 0.25, 0.75];
        let split = |at: f64| (at, parts(values, at));
        let is_clear =
            |(_, [_, (right, _)]): &(f64, [Bernstein; 2])| right[0].abs() > self.rounding;
        PLACES.into_iter().map(split).find(is_clear)
    }

    fn first(
        &mut self,
        (values, count): &Bernstein,
        (lower, upper): (f64, f64),
        depth: u32,
    ) -> Option<(f64, f64)> {
        let values = &values[..*count];
        let (start, end) = (values[0], values[*count - 1]);
        let signs = values.iter().map(|&value| value > 0.0);
        let changes = signs
            .clone()
            .zip(signs.skip(1))
            .filter(|(a, b)| a != b)
            .count();
        if changes == 0 && start > 0.0 {
            return None;
        }
        if changes == 1 && start > 0.0 && end <= 0.0 {
            return Some((lower, upper));
        }
        if values.iter().all(|value| value.abs() <= self.rounding) && end > 0.0 {
            self.touches += 1;
            return None;
        }
        let halves = self.split(values).filter(|_| depth > 0);
        let halves = halves.map(|(at, halves)| (lower + at * (upper - lower), halves));
        let Some((middle, [left, right])) =
            halves.filter(|&(middle, _)| middle > lower && middle < upper)
        else {
            if end <= 0.0 {
                return Some((lower, upper));
            }
            self.touches += 1;
            return None;
        };
        if let Some(found) = self.first(&left, (lower, middle), depth - 1) {
            return Some(found);
        }
        self.first(&right, (middle, upper), depth - 1)
    }
}

/// The coefficients on the two parts of an interval that is split `at` a part of it (de
/// Casteljau).
fn parts(values: &[f64], at: f64) -> [Bernstein; 2] {
    let count = values.len();
    let (mut left, mut right) = ([0.0; MOST], [0.0; MOST]);
    right[..count].copy_from_slice(values);
    for (round, left) in left.iter_mut().take(count).enumerate() {
        *left = right[0];
        for j in 0..count - 1 - round {
            right[j] += at * (right[j + 1] - right[j]);
        }
    }
    [(left, count), (right, count)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// c·Π(1 − h/r)
    fn with_roots(roots: &[f64]) -> Vec<f64> {
        let mut coefficients = vec![1.0];
        for root in roots {
            coefficients.push(0.0);
            for k in (1..coefficients.len()).rev() {
                coefficients[k] -= coefficients[k - 1] / root;
            }
        }
        coefficients
    }

    #[test]
    fn blocks_of_four_are_the_polynomial() {
        let c: [f64; 13] = std::array::from_fn(|k| 1.0 / (k as f64 + 1.0));
        let (value, _) = value_and_slope(&c, 0.7);
        assert!((increment(&c, 0.7, c[0]) - value).abs() < 1e-15);
        let c = [2.0, 3.0, 5.0];
        assert_eq!(increment(&c, 2.0, 0.5), 26.5);
    }

    #[test]
    fn roots_by_the_exponent_are_hardly_too_large() {
        for k in [7, 8, 15, 24] {
            for exponent in -300..300 {
                let m = 1.7 * 10f64.powi(exponent);
                let exact = m.powf(-1.0 / f64::from(k));
                let ratio = inverse_root(m, k as usize) / exact;
                assert!((1.0 - 1e-6..1.07).contains(&ratio), "{k} {m:e}: {ratio}");
            }
        }
    }

    #[test]
    fn the_first_of_many_roots_is_isolated() {
        for roots in [
            &[0.3][..],
            &[0.1, 0.11, 0.5, 0.9],
            &[0.999, 2.0],
            &[1.0],
            &[0.4, 0.4000001, 0.7],
            &[1e-9, 0.2],
            &[-0.5, 0.25, -3.0, 7.0],
        ] {
            let coefficients = with_roots(roots);
            let found = first_root(&coefficients, 1.0, 1e-15);
            let (lower, upper) = found.first.unwrap();
            let exact = roots.iter().copied().filter(|root| *root > 0.0);
            let exact = exact.fold(f64::INFINITY, f64::min);
            assert!(
                lower < exact && exact <= upper,
                "{roots:?}: {lower} {upper}"
            );
            let found = root(&coefficients, lower, upper);
            assert!((found - exact).abs() < 1e-8 * exact, "{roots:?}: {found}");
        }
    }

    #[test]
    fn without_a_root_there_is_none() {
        for roots in [&[1.0 + 1e-12][..], &[-0.1, -0.2], &[1.5, 1.6, -0.1]] {
            let found = first_root(&with_roots(roots), 1.0, 1e-15);
            assert_eq!((found.first, found.touches), (None, 0), "{roots:?}");
        }
        // 1 + h² − h, with complex roots near the interval
        assert_eq!(first_root(&[1.0, -1.0, 1.0], 1.0, 1e-15).first, None);
    }

    #[test]
    fn what_is_less_than_rounding_below_zero_is_a_touch() {
        for middle in [0.5, 0.25, 0.75, 0.3, 0.2] {
            for rounding in [1e-14, 1e-15] {
                let mut coefficients = with_roots(&[middle, middle]);
                coefficients[0] -= 1e-16;
                let found = first_root(&coefficients, 1.0, rounding);
                assert_eq!(found.first, None, "{middle}");
                assert!(found.touches > 0);
            }
        }
    }

    #[test]
    fn what_returns_from_a_band_dips() {
        for (lowest, expected) in [(2e-3, false), (5e-4, true), (-5e-4, true), (-2e-3, false)] {
            let mut coefficients = with_roots(&[0.3, 0.3]);
            coefficients[0] += lowest;
            assert_eq!(dips(&coefficients, 1.0, 1e-3), expected, "{lowest}");
        }
        // straight through, and not yet there
        assert!(!dips(&with_roots(&[0.3]), 1.0, 1e-3));
        assert!(!dips(&with_roots(&[1.0001]), 1.0, 1e-3));
    }

    #[test]
    fn a_double_root_is_a_touch() {
        let found = first_root(&with_roots(&[0.3, 0.3]), 1.0, 1e-15);
        assert_eq!(found.first, None);
        assert!(found.touches > 0);
    }
}
