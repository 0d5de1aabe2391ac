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
