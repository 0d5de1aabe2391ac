//! Enclosures against values.

use super::*;

type Unary = (fn(f64) -> f64, fn(Interval) -> Interval);

impl Interval {
    fn has(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }
}

/// Points of an interval.
fn points(interval: Interval) -> impl Iterator<Item = f64> {
    (0..=200).map(move |k| {
        let part = f64::from(k) / 200.0;
        (interval.low + part * (interval.high - interval.low)).clamp(interval.low, interval.high)
    })
}

fn samples() -> impl Iterator<Item = Interval> {
    let ends = [
        -700.0, -20.0, -7.3, -3.2, -1.6, -1.0, -0.9, -0.3, -1e-9, 0.0, 1e-12, 0.4, 1.0, 1.5, 1.6,
        2.9, 3.3, 4.8, 6.4, 9.5, 30.0,
    ];
    (0..ends.len()).flat_map(move |i| (i..ends.len()).map(move |j| Interval::new(ends[i], ends[j])))
}

#[test]
fn every_function_encloses_its_values() {
    let functions: [Unary; 16] = [
        (f64::abs, Scalar::abs),
        (f64::sqrt, Scalar::sqrt),
        (f64::exp, Scalar::exp),
        (f64::ln, Scalar::ln),
        (f64::sin, Scalar::sin),
        (f64::cos, Scalar::cos),
        (f64::tan, Scalar::tan),
        (f64::sinh, Scalar::sinh),
        (f64::cosh, Scalar::cosh),
        (f64::tanh, Scalar::tanh),
        (f64::asin, Scalar::asin),
        (f64::acos, Scalar::acos),
        (f64::atan, Scalar::atan),
        (|u| u * u, Scalar::squared),
        (|u| u.powi(3), |u| Scalar::powi(u, 3)),
        (|u| u.powi(-4), |u| Scalar::powi(u, -4)),
    ];
    for (number, (function, enclosure)) in functions.iter().enumerate() {
        for interval in samples() {
            let image = enclosure(interval);
            for u in points(interval) {
                let value = function(u);
                assert!(
                    value.is_nan() || image.has(value),
                    "{number}: {interval:?} {u}: {value} not in {image:?}"
                );
            }
            // an argument outside of the domain leaves nothing known
            if points(interval).any(|u| function(u).is_nan()) {
                assert_eq!(image, Interval::WHOLE, "{number}: {interval:?}");
            }
        }
    }
}

#[test]
fn operators_enclose_their_values() {
    for (a, b) in samples()
        .zip(samples().skip(37))
        .chain(samples().zip(samples().skip(90)))
    {
        for (u, v) in points(a)
            .zip(points(b))
            .chain(points(a).zip(points(b).skip(80)))
        {
            assert!((a + b).has(u + v) && (a - b).has(u - v) && (a * b).has(u * v));
            assert!(v == 0.0 || (a / b).has(u / v), "{a:?} {b:?} {u} {v}");
        }
    }
}

#[test]
fn squares_and_their_roots_keep_their_sign() {
    let u = Interval::new(-2.0, 3.0);
    assert_eq!(Scalar::squared(u).low, 0.0);
    let size = Scalar::sqrt(Scalar::squared(u) + Scalar::squared(u));
    assert!(size.low >= 0.0 && size.high < 4.3);
    assert!(Scalar::sin(Interval::new(0.1, 0.2)).high < 0.2);
    assert_eq!(Scalar::sin(Interval::new(1.0, 2.0)).high, 1.0);
}
