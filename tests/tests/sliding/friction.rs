//! A mass on a moving belt: it sticks and slips.

use dmm_runtime::{
    Best, Composed, Integrator, Method, Symmetric, System, Taylor, TransitionKind, pws,
};

use super::{Failure, assert_close, story, taylor};

pws! {
    /// A mass on a belt whose friction becomes weaker the faster it slips.
    pub system Belt {
        state x, v;
        param force = 0.4, speed = 0.2, delta = 3;
        interface belt = v - speed, sliding;
        region faster where belt > 0 {
            der(x) = v;
            der(v) = -x - force/(1 + delta*(v - speed));
        }
        region slower where belt < 0 {
            der(x) = v;
            der(v) = -x + force/(1 - delta*(v - speed));
        }
        sliding belt { conserved speed_of_belt = v; }
    }
}

/// Stick and slip times from (0, 0.5), by Taylor series with 60 digits: 32 digits agree.
const TIMES: [f64; 6] = [
    0.711_349_186_642_819_2,
    1.373_622_598_801_256_4,
    6.137_229_231_774_887,
    9.207_176_574_925_595,
    13.970_783_207_899_226,
    17.040_730_551_049_932,
];

/// x(20) and v(20)
const AT_20: [f64; 2] = [0.128_357_337_522_457_62, -0.406_454_214_599_564_44];

fn times<Met: Method + 'static>(method: Met) -> Result<(Vec<f64>, [f64; 2]), Failure> {
    let belt = Belt::default();
    let run = Integrator::new(&belt, method).initial(0.0, [0.0, 0.5]);
    let run = run.run_until(20.0)?;
    let kinds: Vec<TransitionKind> = run.transitions().iter().map(|one| one.kind).collect();
    let both = [TransitionKind::BeganToSlide, TransitionKind::LeftSlide];
    assert_eq!(kinds, both.repeat(3));
    let stuck = run.points().iter();
    for point in stuck.filter(|point| belt.of_region(point.region).name == "sliding_belt") {
        assert_eq!(point.x[1], 0.2);
    }
    let end = run.last().ok_or("no point")?.x;
    let times = run.transitions().iter().map(|one| one.t).collect();
    Ok((times, [end[0], end[1]]))
}

#[test]
fn stick_and_slip_times_are_those_of_the_reference() -> Result<(), Failure> {
    for (times, end) in [
        times(Taylor::tolerance(1e-15))?,
        times(Best::tolerance(1e-15))?,
    ] {
        for (time, expected) in times.iter().zip(TIMES) {
            assert_close(*time, expected, 1e-13);
        }
        for (value, expected) in end.iter().zip(AT_20) {
            assert_close(*value, expected, 2e-13);
        }
    }
    Ok(())
}

#[test]
fn one_step_schemes_keep_their_order_through_stick_and_slip() -> Result<(), Failure> {
    let error = |(times, end): (Vec<f64>, [f64; 2])| {
        let times = times.iter().zip(TIMES);
        let times = times.map(|(time, expected)| (time - expected).abs());
        let end = end.iter().zip(AT_20);
        let end = end.map(|(value, expected)| (value - expected).abs());
        times.chain(end).fold(0.0, f64::max)
    };
    let second = [0.02, 0.01, 0.005].map(|step| times(Symmetric::step_size(step)).map(error));
    let fourth = [0.08, 0.04, 0.02].map(|step| times(Composed::<4>::step_size(step)).map(error));
    for (errors, order) in [(second, 2.0), (fourth, 4.0)] {
        let errors: Vec<f64> = errors.into_iter().collect::<Result<_, _>>()?;
        let slope = (errors[0] / errors[2]).log2() / 2.0;
        assert!((slope - order).abs() < 0.35, "{slope}: {errors:?}");
    }
    Ok(())
}

#[test]
fn dry_friction_as_a_switch_of_a_formula() -> Result<(), Failure> {
    // the slip orbit is the circle about (0.4, 0) that touches the belt's speed once a turn
    let declaration = "system Dry {
        state x, v;
        param force = 0.4, speed = 0.2;
        der(x) = v;
        der(v) = -x - force*(if v > speed sliding { 1 } else { -1 });
    }";
    let way = taylor(declaration, &[], &[0.0, 0.5], 20.0)?;
    assert_eq!(story(&way), ["slides on v - speed", "leaves v - speed"]);
    assert_close(way.passed[0].t, 0.578_392_191_589_083_4, 1e-15);
    assert_close(way.passed[0].x[0], 0.208_276_253_029_821_97, 1e-15);
    assert_close(way.passed[1].t, 1.537_010_926_439_973_5, 1e-15);
    assert_close(way.end[0], 0.324_597_834_519_371_4, 1e-14);
    assert_close(way.end[1], 0.185_241_770_237_794_65, 1e-14);
    Ok(())
}

#[test]
fn the_stick_slip_oscillator_of_leine() -> Result<(), Failure> {
    // Leine, van Campen, de Kraker & van den Steen (1998), to the digits that exact flows give
    let declaration = include_str!("../../../problems/hybrid/stick_slip.pws");
    let way = taylor(declaration, &[], &[0.0, 0.2], 30.0)?;
    let times: Vec<f64> = way.passed.iter().map(|one| one.t).collect();
    assert_close(times[1] - times[0], 4.295_999_525_480, 1e-11);
    assert_close(times[2] - times[1], 7.705_031_769_350, 1e-11);
    assert_close(times[2] - times[0], 12.001_031_294_831, 1e-11);
    assert_close(way.passed[2].x[0], 1.0, 1e-15);
    Ok(())
}
