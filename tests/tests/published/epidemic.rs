//! The epidemic with hysteresis, beside Taylor series of 40 digits.

use super::{Failure, Scheme, assert_close, model, run};

const EPIDEMIC: &str = include_str!("../../../problems/hybrid/epidemic.pws");
/// The lockdown begins and ends; the ten decimals that were published agree.
const SWITCHES: [f64; 4] = [
    24.303338546402372119,
    65.333052959311967552,
    82.567165828569090352,
    109.5713294536094311,
];
/// S, I and R at t = 300.
const END: [f64; 3] = [
    186.8528353788371729,
    0.15347526145812845995,
    812.99368935970469864,
];

#[test]
fn the_lockdown_begins_and_ends_in_time() -> Result<(), Failure> {
    let way = run(
        &model(EPIDEMIC, &[])?,
        Scheme::Taylor,
        &[999.0, 1.0, 0.0],
        300.0,
    )?;
    let events = way.passages.iter().filter(|one| one.jumped);
    let (times, infected): (Vec<f64>, Vec<f64>) = events.map(|one| (one.t, one.before[1])).unzip();
    assert_close("switch", &times, &SWITCHES, 1e-12);
    assert_close("infected", &infected, &[100.0, 20.0, 100.0, 20.0], 1e-13);
    assert_close("end", &way.x, &END, 1e-11);
    Ok(())
}
