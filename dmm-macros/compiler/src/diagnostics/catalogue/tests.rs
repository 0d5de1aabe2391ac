//! The catalogue is complete and in order, and `DIAGNOSTICS.md` is a copy of it.

use std::collections::BTreeSet;
use std::path::Path;

use super::{all, find, markdown, stages};

/// Set to write `DIAGNOSTICS.md` anew.
const UPDATE: &str = "UPDATE_DIAGNOSTICS";

#[test]
fn numbers_are_unique_sorted_and_in_the_range_of_their_stage() {
    for stage in stages() {
        for code in stage.codes {
            assert!(stage.numbers.contains(&code.number), "{code}");
        }
    }
    let numbers: Vec<u16> = all().iter().map(|code| code.number).collect();
    assert!(numbers.is_sorted_by(|one, next| one < next), "{numbers:?}");
}

#[test]
fn every_entry_says_what_why_and_what_to_do() {
    let mut titles = BTreeSet::new();
    for code in all() {
        assert!(titles.insert(code.title), "{code}: its title is used twice");
        assert!(!code.title.ends_with('.'), "{code}: a title is no sentence");
        for sentence in [code.cause, code.remedy] {
            let first = sentence.chars().next().unwrap_or('.');
            assert!(!first.is_lowercase(), "{code}: {sentence}");
            assert!(sentence.ends_with('.'), "{code}: {sentence}");
        }
        // code is marked as such, so that the document shows it as written
        for text in [code.title, code.cause, code.remedy] {
            assert!(text.matches('`').count() % 2 == 0, "{code}: {text}");
        }
        assert_eq!(find(code.number).map(|found| found.title), Some(code.title));
    }
    assert!(find(0).is_none());
}

#[test]
fn the_document_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../dmm-runtime/DIAGNOSTICS.md");
    let expected = markdown();
    if std::env::var_os(UPDATE).is_some() {
        std::fs::write(&path, &expected).expect("DIAGNOSTICS.md can be written");
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == expected,
        "DIAGNOSTICS.md is not a copy of the catalogue: run this test with {UPDATE}=1"
    );
}
