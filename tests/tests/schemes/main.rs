//! What is derived for every problem: the listing as text and as a document. (Snapshots of listings
//! and of code are with the tests of the compiler.)

mod latex;

use dmm_problems::problem::Problem;
use dmm_problems::registry;
use proc_macro2::TokenStream;

fn declaration(problem: &Problem) -> TokenStream {
    problem
        .declaration()
        .parse()
        .expect("a declaration is made of tokens")
}

#[test]
fn a_declaration_printed_says_the_same() {
    for problem in registry::all() {
        let again = dmm_compiler::explain(declaration(&problem));
        assert_eq!(again.as_deref(), Ok(problem.listing()));
    }
}

#[test]
fn listings_are_of_a_length_that_can_be_read() {
    for problem in registry::all() {
        let (name, text) = (problem.description().name, problem.listing());
        let derived = text.trim_start_matches(problem.declaration());
        let widest = derived.lines().map(|line| line.chars().count()).max();
        // room for one term that cannot be broken
        assert!(widest < Some(140), "{name}: {widest:?}");
        let lines = derived.lines().count();
        assert!(lines < 500, "{name}: {lines} lines");
    }
}
