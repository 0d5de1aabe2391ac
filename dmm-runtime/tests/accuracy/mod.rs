//! Errors of `dmm_runtime::special` in units in the last place, against arbitrary precision.
//!
//! Shared by the test and by the example that prints the table.

mod reference;
mod samples;

use dmm_runtime::special;
use reference::{Big, distance, exact, is_representable};
use samples::{Random, Sampler};

/// The error admitted everywhere, in ulp of the exact value.
pub(crate) const BOUND: f64 = 2.0;

/// A function on a range of arguments.
pub(crate) struct Case {
    /// The function's name.
    pub(crate) name: &'static str,
    /// The range, in words.
    pub(crate) range: &'static str,
    function: fn(f64, f64) -> f64,
    reference: fn(f64, f64) -> Big,
    sampler: Sampler,
}

/// What was measured.
pub(crate) struct Measurement {
    /// How many samples have an exact value that is a number or rounds to one.
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
            if !is_representable(&expected) {
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
    ($($name:ident($call:expr): $($range:literal, $sampler:ident;)+)+) => {
        vec![$($(Case {
            name: stringify!($name),
            range: $range,
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
            "|u| < 1/4", small;
            "1/4 < |u| < 4", moderate;
            "4 < |u| < 1e300", large;
            "next to k pi", sinc_zeros;
            "changes of form", seams;
            "subnormal", least;
        sinc_prime(|u, _| special::sinc_prime(u)):
            "|u| < 1/4", small;
            "1/4 < |u| < 4", moderate;
            "4 < |u| < 1e300", large;
            "next to tan u = u", sinc_prime_zeros;
            "near tan u = u", sinc_prime_neighbourhoods;
            "changes of form", seams;
            "subnormal", least;
        sinhc(|u, _| special::sinhc(u)):
            "|u| < 1/4", small;
            "1/4 < |u| < 4", moderate;
            "4 < |u| < 717", hyperbolic;
            "changes of form", seams;
            "subnormal", least;
        sinhc_prime(|u, _| special::sinhc_prime(u)):
            "|u| < 1/4", small;
            "1/4 < |u| < 4", moderate;
            "4 < |u| < 717", hyperbolic;
            "changes of form", seams;
            "subnormal", least;
        exp_product(special::exp_product):
            "ab from -745 to 709", exponents;
            "overflow, subnormal, large a", extreme_exponents;
        ln_dd(special::ln_dd):
            "a = b", positive_coincident;
            "|ln b/a| from 1e-17 to 0.1", positive_nearby;
            "|ln b/a| from 0.1 to 4", positive_moderate;
            "a, b from 1e-300 to 1e300", positive_apart;
            "changes of form", positive_seams;
            "largest and least", positive_extreme;
        ln_dd_prime(special::ln_dd_prime):
            "a = b", positive_coincident;
            "|ln b/a| from 1e-17 to 0.1", positive_nearby;
            "|ln b/a| from 0.1 to 4", positive_moderate;
            "a, b from 1e-300 to 1e300", positive_apart;
            "changes of form", positive_seams;
            "largest and least", positive_extreme;
        asin_dd(special::asin_dd):
            "a = b", unit_coincident;
            "b - a from 1e-17 a to 0.1 a", unit_nearby;
            "uniform", unit_uniform;
            "a, b next to +-1 or 0", unit_ends;
            "b = -a", unit_opposite;
            "changes of form", unit_seams;
            "subnormal", least;
        asin_dd_prime(special::asin_dd_prime):
            "a = b", unit_coincident;
            "b - a from 1e-17 a to 0.1 a", unit_nearby;
            "uniform", unit_uniform;
            "a, b next to +-1 or 0", unit_ends;
            "b = -a", unit_opposite;
            "changes of form", unit_seams;
            "subnormal", least;
            "next to the zero", asin_dd_prime_zeros;
            "b = -a/2", half_opposite;
        atan_dd(special::atan_dd):
            "a = b", real_coincident;
            "b - a from 1e-17 a to 0.1 a", real_nearby;
            "a, b from 0.01 to 100", real_moderate;
            "a, b from 1e-300 to 1e300", real_apart;
            "b = -a", real_opposite;
            "1 + ab near 0", real_orthogonal;
            "changes of form", real_seams;
            "largest", largest;
            "subnormal", least;
        atan_dd_prime(special::atan_dd_prime):
            "a = b", real_coincident;
            "b - a from 1e-17 a to 0.1 a", real_nearby;
            "a, b from 0.01 to 100", real_moderate;
            "a, b from 1e-300 to 1e300", real_apart;
            "b = -a", real_opposite;
            "1 + ab near 0", real_orthogonal;
            "changes of form", real_seams;
            "largest", largest;
            "subnormal", least;
            "next to the zero", atan_dd_prime_zeros;
            "b = -a/2", half_opposite;
    }
}
