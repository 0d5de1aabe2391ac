//! A few runs of the campaign, and what the reference is made of.

use crate::study::Campaign;

#[test]
fn nothing_is_different_in_silence() {
    let campaign = Campaign {
        runs: 400,
        ..Campaign::default()
    };
    let total = campaign.make();
    assert_eq!(total.silent, 0);
    assert!(total.same > 300, "{total:?}");
}

#[test]
fn the_reference_makes_no_step_over_a_pole() {
    // slides that end where one rate is zero and the other one 2.5e-4 and 1.9e-4, so that the weight has a
    // pole 1e-4 behind the end or nearer: at 2.132513676511289 and 1.140159973230212, by the motion in
    // the time s with dt/ds = a + b, the sum of both rates, in which it has no pole, in 30 digits
    for only in [5519, 17923] {
        let campaign = Campaign {
            runs: 20_000,
            seed: 3,
            only: Some(only),
        };
        let total = campaign.make();
        assert_eq!((total.same, total.silent), (3, 0), "{total:?}");
    }
}
