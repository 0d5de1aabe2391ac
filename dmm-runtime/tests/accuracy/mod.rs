//! Errors of `dmm_runtime::special` in units in the last place, against arbitrary precision.
//!
//! Shared by the test and by the example that prints the table.

mod reference;
mod samples;

use dmm_runtime::special;
use reference::{Big, distance, exact, is_representable, terms};
use samples::*;

/// The error admitted of a function, in ulp of the exact value.
const FUNCTION: f64 = 2.0;

/// The error admitted of a derivative, in ulp of the exact value or of the terms that cancel
/// where the derivative changes its sign: 32 ulp are at most 7.1e-15 of either.
const DERIVATIVE: f64 = 32.0;

/// A function on a range of arguments.
pub(crate) struct Case {
    /// The function's name.
    pub(crate) name: &'static str,
    /// The range, in words.
    pub(crate) range: &'static str,
    function: fn(f64, f64) -> f64,
    reference: fn(f64, f64) -> Big,
    /// The size of the terms of a derivative that changes its sign.
    terms: fn(f64, f64) -> Big,
    /// The error admitted, in ulp.
    pub(crate) bound: f64,
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
            let error = distance(value, &expected, (self.terms)(a, b));
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

/// Ranges of arguments: in words, and how they are sampled.
type Ranges = &'static [(&'static str, Sampler)];

const SMALL: Ranges = &[("|u| < 1/4", small), ("1/4 < |u| < 4", moderate)];
const LARGE: Ranges = &[("4 < |u| < 1e300", large)];
const HYPERBOLIC: Ranges = &[("4 < |u| < 717", hyperbolic)];
const SINC_ZEROS: Ranges = &[("next to k pi", sinc_zeros)];
const SINC_PRIME_ZEROS: Ranges = &[
    ("next to tan u = u", sinc_prime_zeros),
    ("near tan u = u", sinc_prime_neighbourhoods),
];
const SEAMS: Ranges = &[("changes of form", seams), ("subnormal", least)];
const EXPONENTS: Ranges = &[
    ("ab from -745 to 709", exponents),
    ("overflow, subnormal, large a", extreme_exponents),
];
const POSITIVE: Ranges = &[
    ("a = b", positive_coincident),
    ("|ln b/a| from 1e-17 to 0.1", positive_nearby),
    ("|ln b/a| from 0.1 to 4", positive_moderate),
    ("a, b from 1e-300 to 1e300", positive_apart),
    ("changes of form", positive_seams),
    ("largest and least", positive_extreme),
];
const UNIT: Ranges = &[
    ("a = b", unit_coincident),
    ("b - a from 1e-17 a to 0.1 a", unit_nearby),
    ("uniform", unit_uniform),
    ("a, b next to +-1 or 0", unit_ends),
    ("b = -a", unit_opposite),
    ("changes of form", unit_seams),
    ("subnormal", least),
];
const ASIN_PRIME_ZEROS: Ranges = &[
    ("next to the zero", asin_dd_prime_zeros),
    ("b = -a/2", half_opposite),
];
const REAL: Ranges = &[
    ("a = b", real_coincident),
    ("b - a from 1e-17 a to 0.1 a", real_nearby),
    ("a, b from 0.01 to 100", real_moderate),
    ("a, b from 1e-300 to 1e300", real_apart),
    ("b = -a", real_opposite),
    ("1 + ab near 0", real_orthogonal),
    ("changes of form", real_seams),
    ("largest", largest),
    ("subnormal", least),
];
const ATAN_PRIME_ZEROS: Ranges = &[
    ("next to the zero", atan_dd_prime_zeros),
    ("b = -a/2", half_opposite),
];

/// The table of cases; what is written for a function is how it is called with (a, b). A
/// derivative says whether it changes its sign.
macro_rules! cases {
    ($($name:ident($call:expr) $bound:ident $($terms:ident)?: $($ranges:ident)+;)+) => {{
        let mut cases = Vec::new();
        $(for &(range, sampler) in [$($ranges),+].into_iter().flatten() {
            cases.push(Case {
                name: stringify!($name),
                range,
                function: $call,
                reference: exact::$name,
                terms: cases!(terms $($terms)?),
                bound: $bound,
                sampler,
            });
        })+
        cases
    }};
    (terms) => { |_, _| Big::ZERO };
    (terms $terms:ident) => { terms::$terms };
}

/// Every function on every range.
pub(crate) fn cases() -> Vec<Case> {
    cases! {
        sinc(|u, _| special::sinc(u)) FUNCTION: SMALL LARGE SINC_ZEROS SEAMS;
        sinc_prime(|u, _| special::sinc_prime(u)) DERIVATIVE sinc_prime:
            SMALL LARGE SINC_PRIME_ZEROS SEAMS;
        sinhc(|u, _| special::sinhc(u)) FUNCTION: SMALL HYPERBOLIC SEAMS;
        sinhc_prime(|u, _| special::sinhc_prime(u)) DERIVATIVE: SMALL HYPERBOLIC SEAMS;
        exp_product(special::exp_product) FUNCTION: EXPONENTS;
        ln_dd(special::ln_dd) FUNCTION: POSITIVE;
        ln_dd_prime(special::ln_dd_prime) DERIVATIVE: POSITIVE;
        asin_dd(special::asin_dd) FUNCTION: UNIT;
        asin_dd_prime(special::asin_dd_prime) DERIVATIVE asin_dd_prime: UNIT ASIN_PRIME_ZEROS;
        atan_dd(special::atan_dd) FUNCTION: REAL;
        atan_dd_prime(special::atan_dd_prime) DERIVATIVE atan_dd_prime: REAL ATAN_PRIME_ZEROS;
    }
}
