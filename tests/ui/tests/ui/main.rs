//! The diagnostics of declarations that do not compile.
//!
//! The expected messages are the files `fail/*.stderr`; after an intended change,
//! `UPDATE_MESSAGES=1 cargo test -p dmm-ui-tests` writes them anew, to be read before
//! they are committed.

mod messages;

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use dmm_compiler::diagnostics::catalogue;

/// What no declaration can provoke, with the reason.
const UNREACHABLE: &[(u16, &str)] = &[(
    400,
    "a derived scheme that violates its identities is an error of the compiler",
)];

#[test]
fn wrong_declarations_are_reported() {
    messages::check("fail");
    // messages of rustc about the library's traits, which have no code of ours
    messages::check("runtime");
}

/// The files of expected messages, with their texts.
fn expected_messages() -> Vec<(PathBuf, String)> {
    let files = messages::files("fail", "stderr").into_iter();
    files
        .map(|path| {
            let text = fs::read_to_string(messages::root().join(&path)).expect("expected messages");
            (path, text)
        })
        .collect()
}

/// The numbers of the codes `[PWSnnn]` in the expected messages.
fn expected_codes() -> BTreeSet<u16> {
    let mut codes = BTreeSet::new();
    for (_, text) in expected_messages() {
        let numbers = text.split("[PWS").skip(1).filter_map(|rest| rest.get(..3));
        codes.extend(numbers.filter_map(|number| number.parse::<u16>().ok()));
    }
    codes
}

#[test]
fn every_code_of_the_catalogue_is_expected_somewhere() {
    let catalogue: BTreeSet<u16> = catalogue::all().iter().map(|code| code.number).collect();
    let unreachable: BTreeSet<u16> = UNREACHABLE.iter().map(|(number, _)| *number).collect();
    let expected = expected_codes();
    let unknown: Vec<&u16> = expected.difference(&catalogue).collect();
    assert!(unknown.is_empty(), "not in the catalogue: {unknown:?}");
    let reached: Vec<&u16> = unreachable.intersection(&expected).collect();
    assert!(reached.is_empty(), "said to be unreachable: {reached:?}");
    let missing: Vec<&u16> = catalogue
        .difference(&expected)
        .filter(|number| !unreachable.contains(number))
        .collect();
    assert!(missing.is_empty(), "in no expected message: {missing:?}");
}

#[test]
fn every_message_has_a_code() {
    for (path, text) in expected_messages() {
        let errors = text.lines().filter(|line| line.starts_with("error"));
        for error in errors {
            assert!(error.contains("[PWS"), "{}: {error}", path.display());
        }
    }
}
