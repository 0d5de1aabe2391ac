//! The buck converter: multipliers and period doublings of its stroboscopic map.
//!
//! Numbers: from exact flows; they agree with Fossas & Olivar (1996), who give fewer digits. The
//! field is continuous in v̇ across the switch, so that a switching has determinant 1 and the
//! determinant over a time T is exp(−T/(RC)).

use dmm_runtime::Model;

use super::maps::{derivative, fixed_point, invariants, zero};
use super::{BOTH, Failure, Scheme, assert_close, model, run};

const CONVERTER: &str = include_str!("../../../problems/hybrid/buck_converter.pws");
const PERIOD: f64 = 400e-6;
/// The map is affine but for the time of the switching.
const STEPS: [f64; 2] = [4e-3, 2e-3];
/// A point near the orbit of period 2 at 31.1 V.
const ORBIT: [f64; 2] = [12.0515, 0.6847];

/// The state (v, i) after a number of periods.
fn strobe(
    converter: &Model,
    scheme: Scheme,
    [v, i]: [f64; 2],
    periods: f64,
) -> Result<[f64; 2], Failure> {
    let end = run(converter, scheme, &[v, i, 0.0], periods * PERIOD)?;
    assert_eq!(end.x[2], 0.0, "the ramp has not begun anew");
    Ok([end.x[0], end.x[1]])
}

/// Trace and determinant of the map over some periods, at its fixed point.
fn multipliers(
    v_in: f64,
    scheme: Scheme,
    near: [f64; 2],
    periods: f64,
) -> Result<(f64, f64), Failure> {
    let converter = model(CONVERTER, &[("v_in", v_in)])?;
    let strobe = |x| strobe(&converter, scheme, x, periods);
    let x = fixed_point(&strobe, near, STEPS)?;
    Ok(invariants(derivative(&strobe, x, STEPS)?))
}

#[test]
fn its_multipliers_are_the_published_ones() -> Result<(), Failure> {
    for scheme in BOTH {
        let (trace, determinant) = multipliers(24.0, scheme, [12.0, 0.55], 1.0)?;
        let decay = (-PERIOD / (22.0 * 47e-6)).exp();
        // the differences reach 6·10⁻¹²
        assert_close("determinant", &[determinant], &[decay], 1e-10);
        let real = trace / 2.0;
        let imaginary = (determinant - real * real).sqrt();
        // seven decimals are given
        assert_close(
            "multiplier",
            &[real, imaginary],
            &[-0.8210865, 0.0707943],
            5e-8,
        );
    }
    Ok(())
}

/// The voltage near two others at which a multiplier of the map is −1: 1 + tr + det = 0.
fn doubling(voltages: [f64; 2], near: [f64; 2], periods: f64) -> Result<f64, Failure> {
    let defect = |v_in: f64| {
        let (trace, determinant) = multipliers(v_in, Scheme::Best, near, periods)?;
        Ok(1.0 + trace + determinant)
    };
    zero(defect, voltages[0], voltages[1])
}

#[test]
fn its_period_doubles_at_the_published_voltages() -> Result<(), Failure> {
    let first = doubling([24.4, 24.5], [12.0, 0.6], 1.0)?;
    assert_close("first", &[first], &[24.5165728286], 1e-10);
    // six decimals are given
    let second = doubling([31.0, 31.1], ORBIT, 2.0)?;
    assert_close("second", &[second], &[31.117902], 5e-7);
    Ok(())
}
