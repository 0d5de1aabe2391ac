//! Limit cycles of switched linear systems: the ring of three repressors and the relay.

use super::{BOTH, Failure, assert_close, model, run};

const REPRESSORS: &str = include_str!("../../../problems/hybrid/repressor_ring.pws");
const RELAY: &str = include_str!("../../../problems/hybrid/relay.pws");

#[test]
fn three_repressors_oscillate_in_the_golden_ratio() -> Result<(), Failure> {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let ring = model(REPRESSORS, &[])?;
    for scheme in BOTH {
        let way = run(&ring, scheme, &[0.3, -0.2, 0.1], 60.0)?;
        // a state switches after each sixth of the period 6 ln((1 + √5)/2) = 2.88727095035762
        let last = &way.passages[way.passages.len() - 20..];
        for pair in last.windows(7) {
            let period = pair[6].t - pair[0].t;
            assert_close("period", &[period], &[6.0 * golden.ln()], 1e-12);
            assert_close("sixth", &[pair[1].t - pair[0].t], &[golden.ln()], 1e-12);
            assert_eq!(pair[0].interface, pair[6].interface);
        }
        // xᵢ is largest where xᵢ₋₁ switches
        for passage in last {
            let largest = passage
                .before
                .iter()
                .fold(0.0_f64, |most, x| most.max(x.abs()));
            assert_close(
                "amplitude",
                &[largest],
                &[2.0 / (1.0 + 5.0_f64.sqrt())],
                1e-13,
            );
        }
    }
    Ok(())
}

#[test]
fn a_relay_oscillates_with_the_published_period() -> Result<(), Failure> {
    let relay = model(RELAY, &[])?;
    for scheme in BOTH {
        let way = run(&relay, scheme, &[0.0, 0.3, -0.1], 100.0)?;
        let turning = 0;
        let switches: Vec<_> = way
            .passages
            .iter()
            .filter(|one| one.interface != turning)
            .collect();
        let turns: Vec<_> = way
            .passages
            .iter()
            .filter(|one| one.interface == turning)
            .collect();
        let (last, before) = (switches[switches.len() - 1], switches[switches.len() - 3]);
        // 14 decimals are given
        assert_close("period", &[last.t - before.t], &[4.55107102608458], 1e-12);
        let amplitude = turns[turns.len() - 1].before[0].abs();
        assert_close("amplitude", &[amplitude], &[0.220037073248707], 1e-14);
    }
    Ok(())
}
