//! A short campaign of disguised declarations.
//!
//! The long one is `cargo run --release -p dmm-compiler --example campaign -- --cases 10000`.

#[path = "campaign/mod.rs"]
mod campaign;

use campaign::truth::Truth;
use campaign::{Answer, Disguise, FAMILIES, case, constants_agree, identities_agree};

/// The cases of the short campaign.
const CASES: u64 = 300;

#[test]
fn nothing_wrong_is_proved_and_nothing_right_refuted() {
    let disguise = Disguise::new();
    let (mut right, mut undecided, mut refuted) = (0, 0, 0);
    for index in 0..CASES {
        let case = case(&disguise, 1, index);
        let about = format!("{index}: {}: {}", FAMILIES[case.family], case.declaration);
        match (case.truth, case.answer) {
            (Truth::Holds, Answer::Refuted) => panic!("right and refuted: {about}"),
            (Truth::Fails, Answer::Proved) => panic!("wrong and proved: {about}"),
            (Truth::Holds, answer) => {
                right += 1;
                undecided += usize::from(answer != Answer::Proved);
            }
            (Truth::Fails, Answer::Refuted) => refuted += 1,
            _ => {}
        }
    }
    assert!(
        right > 100 && refuted > 80,
        "{right} right, {refuted} refuted"
    );
    assert!(
        undecided <= 2,
        "{undecided} of {right} right ones are undecided"
    );
}

#[test]
fn the_same_seed_gives_the_same_declarations() {
    let disguise = Disguise::new();
    let declaration = |seed, index| campaign::declaration(&disguise, seed, index);
    for index in 0..50 {
        assert_eq!(declaration(7, index), declaration(7, index));
    }
    assert_ne!(declaration(7, 0), declaration(8, 0));
}

/// The disguises themselves, in 120 digits.
#[test]
fn identities_hold() {
    assert_eq!(constants_agree(), Vec::<String>::new());
    assert_eq!(identities_agree(), Vec::<String>::new());
}
