//! The integrate-and-fire neuron.

use super::{BOTH, Failure, Scheme, assert_close, model, run};

const NEURON: &str = include_str!("../../../problems/hybrid/neuron.pws");
const THRESHOLD: usize = 0;

#[test]
fn a_constant_current_gives_spikes_at_equal_intervals() -> Result<(), Failure> {
    let neuron = model(NEURON, &[])?;
    // τ ln(RI/(RI − 1)) to the threshold, and the refractory time
    let rise = 10.0 * 3.0_f64.ln();
    for scheme in BOTH {
        let spikes = run(&neuron, scheme, &[0.0, 0.0], 1000.0)?.times(THRESHOLD);
        assert_eq!(spikes.len(), ((1000.0 + 2.0) / (rise + 2.0)) as usize);
        let expected: Vec<f64> = (0..spikes.len())
            .map(|number| rise + number as f64 * (rise + 2.0))
            .collect();
        assert_close("spike", &spikes, &expected, 2e-12);
    }
    Ok(())
}

#[test]
fn a_modulated_current_moves_them() -> Result<(), Failure> {
    let neuron = model(NEURON, &[("modulation", 0.6), ("omega", 0.5)])?;
    let way = run(&neuron, Scheme::Taylor, &[0.0, 0.0], 100.0)?;
    // Taylor series of 40 digits
    let expected = [
        11.701930052479515497,
        24.959891004558526873,
        37.928107105773506404,
        50.719865772076986193,
        63.409810772611779893,
        76.043034622464347289,
        88.645302874380802774,
    ];
    assert_close("spike", &way.times(THRESHOLD), &expected, 1e-12);
    let end = [0.85724361583578865322, 11.354697125619197226];
    assert_close("end", &way.x, &end, 1e-12);
    Ok(())
}
