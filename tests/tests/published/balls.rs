//! Impacts: the bouncing ball, a pendulum at a moving wall; and a crossing by its reference.

use dmm_problems::reference::Reference;
use dmm_runtime::ErrorKind;

use super::{BOTH, Failure, Scheme, assert_close, model, run};

const BALL: &str = include_str!("../../../problems/hybrid/bouncing_ball.pws");
const CROSSING: &str = include_str!("../../../problems/hybrid/crossing.pws");
const WALL: &str = include_str!("../../../problems/hybrid/moving_wall.pws");

#[test]
fn a_ball_bounces_as_in_its_reference() -> Result<(), Failure> {
    let reference = Reference::parse(include_str!(
        "../../../problems/reference/bouncing_ball.json"
    ))?;
    let ball = model(BALL, &[])?;
    let last = reference.crossings.last().ok_or("no impacts")?.t;
    for scheme in BOTH {
        let way = run(&ball, scheme, &[1.0, 0.0], last + 0.01)?;
        assert_eq!(way.passages.len(), 20);
        for (impact, expected) in way.passages.iter().zip(&reference.crossings) {
            assert_close("time", &[impact.t], &[expected.t], 1e-13);
            assert_close("impact", &impact.before, &expected.x, 1e-13);
            assert_close("after", &impact.after, &[0.0, -0.9 * expected.x[1]], 1e-13);
        }
        for sample in &reference.samples {
            let way = run(&ball, scheme, &[1.0, 0.0], sample.t)?;
            assert_eq!(way.passages.len() as u64, sample.crossings_before);
            assert_close("sample", &way.x, &sample.x, 1e-13);
        }
    }
    Ok(())
}

#[test]
fn its_impacts_accumulate() -> Result<(), Failure> {
    let ball = model(BALL, &[])?;
    // √(2/g) (1 + e)/(1 − e)
    let accumulation = (2.0_f64 / 9.81).sqrt() * 19.0;
    let error = run(&ball, Scheme::Best, &[1.0, 0.0], 10.0)
        .map(drop)
        .unwrap_err();
    let error = error.downcast::<dmm_runtime::Error>()?;
    assert!(matches!(error.kind, ErrorKind::Zeno { .. }), "{error}");
    let t = error.place().ok_or("no place")?.t;
    assert_close("accumulation", &[t], &[accumulation], 1e-12);
    Ok(())
}

#[test]
fn a_switch_of_the_velocity_is_crossed() -> Result<(), Failure> {
    let reference = Reference::parse(include_str!(
        "../../../problems/reference/fesd_crossing.json"
    ))?;
    let crossing = model(CROSSING, &[])?;
    for scheme in BOTH {
        for sample in &reference.samples {
            let way = run(&crossing, scheme, &[-1.0], sample.t)?;
            let passed = usize::try_from(sample.crossings_before)?;
            assert_eq!(way.passages.len(), passed);
            for (passage, expected) in way.passages.iter().zip(&reference.crossings) {
                assert_close("time", &[passage.t], &[expected.t], 1e-16);
            }
            assert_close("sample", &way.x, &sample.x, 2e-16);
        }
    }
    Ok(())
}

/// Impacts of the pendulum at the wall: t, and θ, ω before, ω after. Taylor series of 40 digits.
const IMPACTS: [[f64; 4]; 7] = [
    [
        1.7355975904833464116,
        0.0580743399458774945,
        0.957091274164864595,
        -0.590892851818831277,
    ],
    [
        5.2806973710076839146,
        0.13690006789218408,
        0.577766100912099114,
        0.0276834812093921839,
    ],
    [
        10.729960526215464578,
        0.0706721199536091546,
        0.120358968044014146,
        -0.3698468951133005,
    ],
    [
        14.228667711525852469,
        0.0525047154208932961,
        0.372857994444056357,
        -0.200016218446464353,
    ],
    [
        19.687880400948019641,
        0.184151739974604285,
        -0.0945857413997896943,
        -0.461308940114110982,
    ],
    [
        23.380228495244139053,
        0.059797697005498295,
        0.492998353044091784,
        -0.586360534077967475,
    ],
    [
        26.783394284793801958,
        0.0519090658828211089,
        0.587111087432332095,
        -0.383809797928138916,
    ],
];
/// θ and ω at t = 30.
const AT_END: [f64; 2] = [-0.034621045088179175275, 0.38575304284744190847];

#[test]
fn a_pendulum_hits_the_moving_wall() -> Result<(), Failure> {
    let way = run(&model(WALL, &[])?, Scheme::Taylor, &[-1.0, 0.0], 30.0)?;
    assert_eq!(way.passages.len(), IMPACTS.len());
    for (impact, expected) in way.passages.iter().zip(IMPACTS) {
        let [theta, omega] = [impact.before[0], impact.before[1]];
        let values = [impact.t, theta, omega, impact.after[1]];
        assert_close("impact", &values, &expected, 1e-12);
    }
    assert_close("end", &way.x, &AT_END, 1e-12);
    Ok(())
}
