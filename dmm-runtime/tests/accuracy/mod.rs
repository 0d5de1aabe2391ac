//! Errors of `dmm_runtime::special` in units in the last place, against arbitrary precision.
//!
//! Shared by the test and by the example that prints the table.

mod reference;
mod samples;

use dmm_runtime::special;
use reference::{Big, distance, exact};
use samples::{Random, Sampler};

/// A function on a range of arguments, and the error that is admitted there.
pub(crate) struct Case {
    /// The function's name.
    pub(crate) name: &'static str,
    /// The range, in words.
    pub(crate) range: &'static str,
    /// The error admitted, in ulp of the exact value.
    pub(crate) bound: f64,
    function: fn(f64, f64) -> f64,
    reference: fn(f64, f64) -> Big,
    sampler: Sampler,
}

/// What was measured.
pub(crate) struct Measurement {
    /// How many samples have a normal number as exact value.
    pub(crate) samples: usize,
    /// The greatest error, in ulp.
    pub(crate) max: f64,
    /// The mean error, in ulp.
    pub(crate) mean: f64,
    /// The argument of the greatest error.
    pub(crate) worst: (f64, f64),
}

impl Case {
    /// Measures the errors at `count` samples, the same ones at every call.
    pub(crate) fn measure(&self, count: usize) -> Measurement {
        let mut random = Random::new(self.name, self.range);
        let mut result = Measurement {
            samples: 0,
            max: 0.0,
            mean: 0.0,
            worst: (0.0, 0.0),
        };
        for index in 0..count {
            let (a, b) = (self.sampler)(&mut random, index);
            let expected = (self.reference)(a, b);
            let size = expected.to_f64().value().abs();
            if size != 0.0 && !size.is_normal() {
                continue;
            }
            let value = (self.function)(a, b);
            let error = distance(value, &expected);
            result.samples += 1;
            result.mean += error;
            if error.is_nan() || error > result.max {
                result.max = if error.is_nan() { f64::INFINITY } else { error };
                result.worst = (a, b);
            }
        }
        result.mean /= result.samples as f64;
        result
    }
}

/// The table of cases; what is written for a function is how it is called with (a, b).
macro_rules! cases {
    ($($name:ident($call:expr): $($range:literal, $sampler:ident, $bound:literal;)+)+) => {
        vec![$($(Case {
            name: stringify!($name),
            range: $range,
            bound: $bound,
            function: $call,
            reference: exact::$name,
            sampler: samples::$sampler,
        },)+)+]
    };
}

/// Every function on every range.
pub(crate) fn cases() -> Vec<Case> {
    cases! {
        sinc(|u, _| special::sinc(u)):
            "|u| < 1/4", small, 2.0;
            "1/4 < |u| < 4", moderate, 2.0;
            "4 < |u| < 1e300", large, 2.0;
            "next to k pi", sinc_zeros, 2.0;
        sinc_prime(|u, _| special::sinc_prime(u)):
            "|u| < 1/4", small, 4.0;
            "1/4 < |u| < 4", moderate, 4.0;
            "4 < |u| < 1e300", large, 4.0;
            "next to tan u = u", sinc_prime_zeros, 4.0;
            "near tan u = u", sinc_prime_neighbourhoods, 4.0;
        sinhc(|u, _| special::sinhc(u)):
            "|u| < 1/4", small, 2.0;
            "1/4 < |u| < 4", moderate, 2.0;
            "4 < |u| < 717", hyperbolic, 2.0;
        sinhc_prime(|u, _| special::sinhc_prime(u)):
            "|u| < 1/4", small, 4.0;
            "1/4 < |u| < 4", moderate, 4.0;
            "4 < |u| < 717", hyperbolic, 4.0;
        ln_dd(special::ln_dd):
            "a = b", positive_coincident, 2.0;
            "|ln b/a| from 1e-17 to 0.1", positive_nearby, 2.0;
            "|ln b/a| from 0.1 to 4", positive_moderate, 2.0;
            "a, b from 1e-300 to 1e300", positive_apart, 2.0;
            "largest and subnormal", positive_extreme, 2.0;
        ln_dd_prime(special::ln_dd_prime):
            "a = b", positive_coincident, 4.0;
            "|ln b/a| from 1e-17 to 0.1", positive_nearby, 4.0;
            "|ln b/a| from 0.1 to 4", positive_moderate, 4.0;
            "a, b from 1e-300 to 1e300", positive_apart, 4.0;
        asin_dd(special::asin_dd):
            "a = b", unit_coincident, 2.0;
            "b - a from 1e-17 a to 0.1 a", unit_nearby, 2.0;
            "uniform", unit_uniform, 2.0;
            "a, b next to +-1 or 0", unit_ends, 2.0;
            "b = -a", unit_opposite, 2.0;
        asin_dd_prime(special::asin_dd_prime):
            "a = b", unit_coincident, 4.0;
            "b - a from 1e-17 a to 0.1 a", unit_nearby, 4.0;
            "uniform", unit_uniform, 4.0;
            "a, b next to +-1 or 0", unit_ends, 4.0;
            "b = -a", unit_opposite, 4.0;
            "near the zero", asin_dd_prime_zeros, 4.0;
        atan_dd(special::atan_dd):
            "a = b", real_coincident, 2.0;
            "b - a from 1e-17 a to 0.1 a", real_nearby, 2.0;
            "a, b from 0.01 to 100", real_moderate, 2.0;
            "a, b from 1e-300 to 1e300", real_apart, 2.0;
            "b = -a", real_opposite, 2.0;
            "1 + ab near 0", real_orthogonal, 2.0;
        atan_dd_prime(special::atan_dd_prime):
            "a = b", real_coincident, 4.0;
            "b - a from 1e-17 a to 0.1 a", real_nearby, 4.0;
            "a, b from 0.01 to 100", real_moderate, 4.0;
            "a, b from 1e-300 to 1e300", real_apart, 4.0;
            "b = -a", real_opposite, 4.0;
            "1 + ab near 0", real_orthogonal, 4.0;
            "near the zero", atan_dd_prime_zeros, 4.0;
    }
}
