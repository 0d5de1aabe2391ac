//! Chua's circuit and a diode bridge, beside Taylor series of 40 digits.

use super::{BOTH, Failure, Scheme, assert_close, model, run};

const CHUA: &str = include_str!("../../../problems/hybrid/chua.pws");
const BRIDGE: &str = include_str!("../../../problems/hybrid/diode_bridge.pws");

/// Times at which |x| = 1 from (0.7, 0, 0), until t = 30.
const SWITCHES: [f64; 22] = [
    0.18263498335495348531,
    1.5924806099762340256,
    3.1928110909911539744,
    6.6732312591864347705,
    7.0690975480060575085,
    8.6135696859670654074,
    9.9318750781616699916,
    11.279796137875154895,
    11.878936252559262754,
    13.311725868343464802,
    15.15768519314550581,
    16.681981442803934031,
    17.287125848077783059,
    18.71607536458324797,
    20.468932786783912583,
    22.031193043429449006,
    22.603366358555978943,
    24.048516459933988293,
    26.132140693025070529,
    27.612743550404386286,
    28.172283115273034895,
    29.62415110293594236,
];
/// (x, y, z) at t = 30.
const STATE: [f64; 3] = [
    -0.10549985951340729846,
    0.25678232170788877236,
    -0.29079520996571842446,
];

#[test]
fn the_double_scroll_is_followed_until_errors_have_grown() -> Result<(), Failure> {
    let chua = model(CHUA, &[])?;
    for scheme in BOTH {
        let way = run(&chua, scheme, &[0.7, 0.0, 0.0], 30.0)?;
        let times: Vec<f64> = way.passages.iter().map(|one| one.t).collect();
        // errors grow as exp(0.326 t), to 2·10⁴ times their size
        let (early, late) = times.split_at(14);
        assert_close("early switch", early, &SWITCHES[..14], 1e-12);
        assert_close("late switch", late, &SWITCHES[14..], 1e-10);
        assert_close("end", &way.x, &STATE, 1e-10);
    }
    Ok(())
}

#[test]
fn the_double_scroll_is_bounded() -> Result<(), Failure> {
    let chua = model(CHUA, &[])?;
    let way = run(&chua, Scheme::Best, &[0.7, 0.0, 0.0], 1000.0)?;
    let (mut left, mut right) = (0, 0);
    for passage in &way.passages {
        assert!(passage.before.iter().all(|x| x.abs() < 5.0), "{passage:?}");
        right += usize::from(passage.before[0] > 0.0);
        left += usize::from(passage.before[0] < 0.0);
    }
    // both scrolls
    assert!(left > 100 && right > 100, "{left} {right}");
    Ok(())
}

/// Times at which the voltage of the source changes its sign or the current of the bridge starts or
/// stops, and the voltage of the capacitor there, until t = 0.05.
const BRIDGE_SWITCHES: [[f64; 2]; 14] = [
    [0.00044732934620973184798, 0.0],
    [0.0067285896940851690922, 7.16688579656505942],
    [0.010005072145190424326, 6.93586931501728672],
    [0.013027918323464411988, 6.72934582405928104],
    [0.016284872256464699622, 7.80647338650086723],
    [0.020010144290380848653, 7.52101115112485774],
    [0.023353750042354040375, 7.27369585440563925],
    [0.026180609869781117643, 7.93504889681295972],
    [0.030015216435571272979, 7.63653106108680132],
    [0.033428359454537741394, 7.38028326215089034],
    [0.036159514650383011724, 7.96419510851480531],
    [0.040020288580761697305, 7.66257543113029669],
    [0.043449464402785803344, 7.40426649308497238],
    [0.046158419300981931205, 7.97097271075273361],
];

#[test]
fn a_bridge_of_diodes_charges_its_capacitor() -> Result<(), Failure> {
    let bridge = model(BRIDGE, &[])?;
    for scheme in BOTH {
        let way = run(&bridge, scheme, &[0.0, 10.0, 0.0], 0.05)?;
        assert_eq!(
            way.passages.len(),
            BRIDGE_SWITCHES.len(),
            "{:?}",
            way.passages
        );
        for (passage, [t, v]) in way.passages.iter().zip(BRIDGE_SWITCHES) {
            assert_close("time", &[passage.t], &[t], 1e-14);
            assert_close("voltage", &[passage.before[2]], &[v], 1e-12);
        }
        assert_close("end", &way.x[2..], &[7.6705684409607298489], 1e-12);
    }
    Ok(())
}
