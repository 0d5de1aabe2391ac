//! The simplest walker: fixed point, multipliers and period doubling of its step map.
//!
//! Numbers: exact to the digits given, computed with 30 digits; they agree with Garcia, Chatterjee,
//! Ruina & Coleman (1998) where those give fewer.

use dmm_runtime::Model;

use super::maps::{derivative, fixed_point, invariants, zero};
use super::{Failure, Passage, Scheme, assert_close, model, to_event};

const WALKER: &str = include_str!("../../../problems/hybrid/walker.pws");
/// Steps of the differences: a walker that is slower by 0.0085 falls backwards.
const STEPS: [f64; 2] = [1.5e-3, 1.5e-3];
/// The fixed point just after contact, (θ, θ̇), at γ = 0.009, and the time of a step.
const FIXED_POINT: [f64; 2] = [0.20031090054424709, -0.19983247300495235];
const STEP_TIME: f64 = 3.88246375285137;

/// A step from (θ, θ̇) just after contact.
fn step(walker: &Model, [theta, omega]: [f64; 2]) -> Result<Passage, Failure> {
    let phi_dot = (1.0 - (2.0 * theta).cos()) * omega;
    to_event(
        walker,
        Scheme::Taylor,
        &[theta, 2.0 * theta, omega, phi_dot],
        8.0,
    )
}

fn stride(walker: &Model, x: [f64; 2]) -> Result<[f64; 2], Failure> {
    let contact = step(walker, x)?;
    Ok([contact.after[0], contact.after[2]])
}

#[test]
fn it_walks_with_the_published_step() -> Result<(), Failure> {
    let walker = model(WALKER, &[])?;
    let x = fixed_point(&|x| stride(&walker, x), [0.2, -0.2], STEPS)?;
    assert_close("fixed point", &x, &FIXED_POINT, 1e-12);
    let contact = step(&walker, x)?;
    assert_close("step time", &[contact.t], &[STEP_TIME], 1e-12);
    // φ = 2θ before and after
    assert_close(
        "contact",
        &[contact.before[1]],
        &[2.0 * contact.before[0]],
        1e-15,
    );
    assert_close("legs", &[contact.after[1]], &[2.0 * contact.after[0]], 0.0);
    Ok(())
}

#[test]
fn its_multipliers_are_the_published_ones() -> Result<(), Failure> {
    let walker = model(WALKER, &[])?;
    let map = derivative(&|x| stride(&walker, x), FIXED_POINT, STEPS)?;
    let (trace, determinant) = invariants(map);
    let real = trace / 2.0;
    let imaginary = (determinant - real * real).sqrt();
    let expected = [-0.190099841065888, 0.557598776682068];
    // the differences reach 2·10⁻¹³
    assert_close("multiplier", &[real, imaginary], &expected, 1e-11);
    Ok(())
}

#[test]
fn its_period_doubles_at_the_published_slope() -> Result<(), Failure> {
    // a multiplier is −1 where 1 + tr + det = 0
    let defect = |gamma: f64| {
        let walker = model(WALKER, &[("gamma", gamma)])?;
        let stride = |x| stride(&walker, x);
        let x = fixed_point(&stride, [0.237, -0.235], STEPS)?;
        let (trace, determinant) = invariants(derivative(&stride, x, STEPS)?);
        Ok(1.0 + trace + determinant)
    };
    let gamma = zero(defect, 0.015, 0.0151)?;
    // nine decimals are given
    assert_close("slope", &[gamma], &[0.015088438], 5e-10);
    Ok(())
}
