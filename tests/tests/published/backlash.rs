//! Two inertias with backlash, in closed form.

use super::{BOTH, Failure, assert_close, model, run};

const BACKLASH: &str = include_str!("../../../problems/hybrid/backlash.pws");

#[test]
fn contacts_and_gaps_alternate() -> Result<(), Failure> {
    let backlash = model(BACKLASH, &[])?;
    let (inertia, k, alpha) = ([1.0, 3.0], 40.0, 0.1);
    // the relative motion: speed 1 through the gap, half a period of the reduced mass in contact
    let reduced: f64 = inertia[0] * inertia[1] / (inertia[0] + inertia[1]);
    let contact = std::f64::consts::PI * (reduced / k).sqrt();
    for scheme in BOTH {
        let way = run(&backlash, scheme, &[0.0, 0.0, 1.0, 0.0], 20.0)?;
        assert!(way.passages.len() > 60, "{}", way.passages.len());
        let mut t = alpha;
        for (number, passage) in way.passages.iter().enumerate() {
            assert_close("time", &[passage.t], &[t], 1e-12);
            // at the end of a contact the relative velocity has changed its sign
            let side = if number % 4 < 2 { 1.0 } else { -1.0 };
            let speed = if number % 4 == 1 || number % 4 == 2 {
                -1.0
            } else {
                1.0
            };
            let x = &passage.before;
            let relative = [x[0] - x[1], x[2] / inertia[0] - x[3] / inertia[1]];
            assert_close("relative", &relative, &[side * alpha, speed], 1e-12);
            let centre = [(x[0] + 3.0 * x[1]) / 4.0, x[2] + x[3]];
            assert_close("centre", &centre, &[t / 4.0, 1.0], 1e-12);
            t += if number % 2 == 0 {
                contact
            } else {
                2.0 * alpha
            };
        }
    }
    Ok(())
}
