//! A short campaign of disguised declarations.
//!
//! The long one is `cargo bench -p dmm-compiler --bench campaign -- --cases 10000`.

#[path = "campaign/mod.rs"]
mod campaign;

use std::ops::Range;
use std::thread;

use campaign::truth::Truth;
use campaign::{Answer, Disguise, FAMILIES, case, constants_agree, identities_agree};

/// The cases of the short campaign.
const CASES: u64 = 300;

#[test]
fn nothing_wrong_is_proved_and_nothing_right_refuted() {
    // as many threads as there are processors on the smallest machines
    let halves = thread::scope(|scope| {
        let halves = [0..CASES / 2, CASES / 2..CASES];
        let started = halves.map(|cases| scope.spawn(|| some(cases)));
        started.map(|half| half.join().expect("no wrong answer"))
    });
    let [right, undecided, refuted]: [usize; 3] =
        [0, 1, 2].map(|k| halves.iter().map(|half| half[k]).sum());
    assert!(
        right > 100 && refuted > 80,
        "{right} right, {refuted} refuted"
    );
    assert!(
        undecided <= 2,
        "{undecided} of {right} right ones are undecided"
    );
}

/// How many cases are right, undecided though right, and refuted.
fn some(cases: Range<u64>) -> [usize; 3] {
    let disguise = Disguise::new();
    let (mut right, mut undecided, mut refuted) = (0, 0, 0);
    for index in cases {
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
    [right, undecided, refuted]
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
