//! What is derived for every problem: snapshots of its listing and of its code, and the listing
//! as a document.

mod latex;

use dmm_problems::problem::Problem;
use dmm_problems::registry;
use insta::assert_snapshot;
use proc_macro2::TokenStream;

/// Longer code is not compared: of thirty-two masses it says nothing that that of eight does
/// not, in many times the characters.
const LONGEST_CODE: usize = 100_000;

fn declaration(problem: &dyn Problem) -> TokenStream {
    problem
        .declaration()
        .parse()
        .expect("a declaration is made of tokens")
}

#[test]
fn listings_are_as_they_were() {
    for problem in registry::all() {
        let name = problem.card().name;
        assert_snapshot!(format!("{name}_listing"), problem.listing());
    }
}

#[test]
fn code_is_as_it_was() {
    for problem in registry::all() {
        let name = problem.card().name;
        let code = dmm_compiler::compile(declaration(&*problem));
        let file = syn::parse2(code).expect("emitted code is Rust");
        let text = prettyplease::unparse(&file);
        // the listing is compared by itself
        let is_listing = |line: &&str| line.trim_start().starts_with("const LISTING:");
        let lines: Vec<&str> = text.lines().filter(|line| !is_listing(line)).collect();
        let text = lines.join("\n");
        if text.len() <= LONGEST_CODE {
            assert_snapshot!(format!("{name}_rust"), text);
        }
    }
}

#[test]
fn a_declaration_printed_says_the_same() {
    for problem in registry::all() {
        let again = dmm_compiler::explain(declaration(&*problem));
        assert_eq!(again.as_deref(), Ok(problem.listing()));
    }
}

#[test]
fn listings_are_of_a_length_that_can_be_read() {
    for problem in registry::all() {
        let (name, text) = (problem.card().name, problem.listing());
        let derived = text.trim_start_matches(problem.declaration());
        let widest = derived.lines().map(|line| line.chars().count()).max();
        // room for one term that cannot be broken
        assert!(widest < Some(140), "{name}: {widest:?}");
        let lines = derived.lines().count();
        assert!(lines < 500, "{name}: {lines} lines");
    }
}
