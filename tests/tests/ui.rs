//! Declarations that compile, and the diagnostics of those that do not.
//!
//! The expected messages are the files `ui/fail/*.stderr`; after an intended change,
//! `TRYBUILD=overwrite cargo test -p dmm-tests --test ui` writes them anew, to be read before
//! they are committed.

#[test]
fn wrong_declarations_are_reported_and_right_ones_compile() {
    let cases = trybuild::TestCases::new();
    cases.pass("ui/pass/*.rs");
    cases.compile_fail("ui/fail/*.rs");
}
