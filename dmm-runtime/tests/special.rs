//! The divided differences against arbitrary precision, their symmetries and their limits.

mod accuracy;

use dmm_runtime::special::*;

const INFINITY: f64 = f64::INFINITY;

/// The bounds are those of the module's documentation; `benches/special_accuracy.rs` measures the
/// same cases at as many samples as one likes.
fn assert_errors_within_bounds(functions: &[&str]) {
    let cases = accuracy::cases();
    let cases = cases.iter().filter(|case| functions.contains(&case.name));
    for case in cases {
        let measured = case.measure(100);
        assert!(measured.samples >= 60, "{} for {}", case.name, case.range);
        assert!(
            measured.max <= case.bound,
            "{} for {}: {} ulp at {:e}, {:e}",
            case.name,
            case.range,
            measured.max,
            measured.worst.0,
            measured.worst.1,
        );
    }
}

#[test]
fn errors_of_sinc() {
    assert_errors_within_bounds(&["sinc", "sinc_prime"]);
}

#[test]
fn errors_of_sinhc() {
    assert_errors_within_bounds(&["sinhc", "sinhc_prime"]);
}

#[test]
fn errors_of_ln() {
    assert_errors_within_bounds(&["ln_dd", "ln_dd_prime"]);
}

#[test]
fn errors_of_asin() {
    assert_errors_within_bounds(&["asin_dd", "asin_dd_prime"]);
}

#[test]
fn errors_of_atan() {
    assert_errors_within_bounds(&["atan_dd", "atan_dd_prime"]);
}

#[test]
fn errors_of_exp_product() {
    assert_errors_within_bounds(&["exp_product"]);
}

/// Where it overflows, underflows, and at the limits.
#[test]
fn exp_product_is_defined_everywhere() {
    assert_eq!(exp_product(1e200, 1e200), INFINITY);
    assert_eq!(exp_product(-1e200, 1e200), 0.0);
    assert_eq!(exp_product(1.0, 709.8), INFINITY);
    assert_eq!(exp_product(1.0, -746.0), 0.0);
    assert_eq!(exp_product(0.0, 1e308), 1.0);
    assert_eq!(exp_product(INFINITY, 1.0), INFINITY);
    assert_eq!(exp_product(INFINITY, -1.0), 0.0);
    assert!(exp_product(INFINITY, 0.0).is_nan());
    assert!(exp_product(f64::NAN, 0.0).is_nan() && exp_product(0.0, f64::NAN).is_nan());
    // 1e305 cannot be split into halves; the product is 1.0000000000000000052…
    assert_eq!(exp_product(1e305, 1e-305), std::f64::consts::E);
}

/// Magnitudes and their neighbours on both sides of every change of form.
fn arguments() -> Vec<f64> {
    let sizes = [
        0.0, 5e-324, 1e-310, 1e-200, 1e-9, 0.1, 0.249, 0.25, 0.26, 0.5, 0.7, 0.999_999, 1.0, 1.001,
        1.5, 2.0, 2.1, 4.0, 4.493_4, 16.0, 300.0, 709.0, 717.0, 1e9, 1e139, 1e141, 1e155, 1e299,
        1e301, 1.7e308, INFINITY,
    ];
    sizes.iter().flat_map(|&size| [size, -size]).collect()
}

#[test]
fn divided_differences_are_symmetric_to_the_last_bit() {
    for function in [ln_dd, asin_dd, atan_dd] {
        for a in arguments() {
            for b in arguments() {
                let (forth, back) = (function(a, b), function(b, a));
                assert!(
                    forth == back || forth.is_nan() && back.is_nan(),
                    "{a:e}, {b:e}: {forth:e}, {back:e}"
                );
            }
        }
    }
}

#[test]
fn cardinal_functions_are_even_and_their_derivatives_odd() {
    for u in arguments() {
        assert_eq!(sinc(u), sinc(-u));
        assert_eq!(sinhc(u), sinhc(-u));
        assert_eq!(sinc_prime(u), -sinc_prime(-u));
        assert_eq!(sinhc_prime(u), -sinhc_prime(-u));
    }
}

/// NaN and nothing else where a function is not defined.
#[test]
fn values_are_numbers_exactly_in_the_domain() {
    for a in arguments() {
        for b in arguments() {
            let is_positive = a >= 0.0 && b >= 0.0;
            let is_indefinite = (a == 0.0 && b == INFINITY) || (a == INFINITY && b == 0.0);
            let is_logarithmic = is_positive && !is_indefinite;
            assert_eq!(ln_dd(a, b).is_nan(), !is_logarithmic, "{a:e}, {b:e}");
            assert_eq!(ln_dd_prime(a, b).is_nan(), !is_logarithmic, "{a:e}, {b:e}");
            let is_unit = a.abs() <= 1.0 && b.abs() <= 1.0;
            assert_eq!(asin_dd(a, b).is_nan(), !is_unit, "{a:e}, {b:e}");
            assert_eq!(asin_dd_prime(a, b).is_nan(), !is_unit, "{a:e}, {b:e}");
            assert!(!atan_dd(a, b).is_nan(), "{a:e}, {b:e}");
            assert!(!atan_dd_prime(a, b).is_nan(), "{a:e}, {b:e}");
        }
        for function in [sinc, sinc_prime, sinhc, sinhc_prime] {
            assert!(!function(a).is_nan(), "{a:e}");
            assert!(function(f64::NAN).is_nan());
        }
        for function in [
            ln_dd,
            ln_dd_prime,
            asin_dd,
            asin_dd_prime,
            atan_dd,
            atan_dd_prime,
        ] {
            assert!(function(a, f64::NAN).is_nan(), "{a:e}");
            assert!(function(f64::NAN, a).is_nan(), "{a:e}");
        }
    }
}

#[test]
fn limits_are_those_documented() {
    assert_eq!([sinc(0.0), sinc(INFINITY), sinhc(0.0)], [1.0, 0.0, 1.0]);
    assert_eq!([sinc_prime(0.0), sinc_prime(INFINITY)], [0.0, 0.0]);
    assert_eq!([sinhc(-INFINITY), sinhc(717.0 + 1.0)], [INFINITY; 2]);
    assert!(sinhc(717.0).is_finite() && sinhc_prime(717.0).is_finite());
    assert_eq!([sinhc_prime(0.0), sinhc_prime(-INFINITY)], [0.0, -INFINITY]);

    assert_eq!([ln_dd(0.0, 1.0), ln_dd(0.0, 0.0)], [INFINITY; 2]);
    assert_eq!([ln_dd(INFINITY, 1.0), ln_dd(INFINITY, INFINITY)], [0.0; 2]);
    assert_eq!(
        [ln_dd_prime(0.0, 1.0), ln_dd_prime(1.0, 0.0)],
        [-INFINITY; 2]
    );
    assert_eq!(
        [ln_dd_prime(INFINITY, 1.0), ln_dd_prime(1.0, INFINITY)],
        [0.0; 2]
    );

    assert_eq!([asin_dd(1.0, 1.0), asin_dd(-1.0, -1.0)], [INFINITY; 2]);
    assert_eq!(asin_dd(-1.0, 1.0), std::f64::consts::FRAC_PI_2);
    assert_eq!(
        [asin_dd_prime(0.5, 1.0), asin_dd_prime(1.0, 1.0)],
        [INFINITY; 2]
    );
    assert_eq!(
        [asin_dd_prime(1.0, -1.0), asin_dd_prime(-1.0, -1.0)],
        [-INFINITY; 2]
    );

    assert_eq!(
        [atan_dd(1.0, INFINITY), atan_dd(-INFINITY, INFINITY)],
        [0.0; 2]
    );
    assert_eq!(
        [atan_dd_prime(1.0, INFINITY), atan_dd_prime(INFINITY, 1.0)],
        [0.0; 2]
    );
    // Opposite, where neither b − a nor ab is representable.
    let half_turn = std::f64::consts::PI / 1.7e308 / 2.0;
    assert!((atan_dd(-1.7e308, 1.7e308) / half_turn - 1.0).abs() < 1e-12);
}

/// The derivative with respect to b against the difference quotient in b, at a distance at which
/// the quotient is accurate to about 1e-9.
#[test]
fn derivatives_are_those_of_the_functions() {
    type Function = fn(f64, f64) -> f64;
    let pairs: [[Function; 2]; 3] = [
        [ln_dd, ln_dd_prime],
        [asin_dd, asin_dd_prime],
        [atan_dd, atan_dd_prime],
    ];
    for [function, derivative] in pairs {
        for (a, b) in [(0.3, 0.3), (0.3, 0.301), (0.8, 0.2), (0.05, 0.9)] {
            let step = 1e-4;
            let at = |steps: f64| function(a, b + steps * step);
            let quotient = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
            let error = (quotient / derivative(a, b) - 1.0).abs();
            assert!(error < 1e-7, "{a}, {b}: {error:e}");
        }
    }
}
