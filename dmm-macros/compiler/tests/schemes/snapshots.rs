//! Snapshots of the last stage: the listing, and the emitted code.

use dmm_compiler::{compile, explain};
use insta::assert_snapshot;

use crate::{systems, tokens};

fn listing(source: &str) -> String {
    explain(tokens(source)).unwrap_or_else(|messages| panic!("{messages:#?}"))
}

fn rust(source: &str) -> String {
    let file = syn::parse2(compile(tokens(source))).expect("emitted code is Rust");
    prettyplease::unparse(&file)
}

/// Those of the problems are with the tests of the workspace; this one has no interface, and
/// conserved quantities that become dependent.
#[test]
fn kepler() {
    assert_snapshot!("kepler_listing", listing(systems::KEPLER));
    assert_snapshot!("kepler_rust", rust(systems::KEPLER));
}

#[test]
fn the_same_declaration_gives_the_same_code() {
    for source in [systems::ELLIPTIC, systems::KEPLER] {
        assert_eq!(rust(source), rust(source));
    }
}

#[test]
fn hostile_names_give_code_without_clashes() {
    let code = rust(systems::HOSTILE);
    // a name that is taken twice in a function would be a second `let` of it
    for function in code.split("fn ").skip(1) {
        let mut locals: Vec<&str> = function
            .lines()
            .filter_map(|line| line.trim().strip_prefix("let ")?.split(' ').next())
            .collect();
        let count = locals.len();
        locals.sort_unstable();
        locals.dedup();
        assert_eq!(locals.len(), count, "in fn {function}");
    }
}

/// Whether the emitted code of `source` has a method or item `name`.
fn emits(source: &str, name: &str) -> bool {
    rust(source).contains(name)
}

#[test]
fn a_system_pays_only_for_what_it_uses() {
    // a smooth system has no transition code
    assert!(emits(systems::ELLIPTIC, "fn switching_function"));
    for smooth in [systems::PENDULUM, systems::LOTKA_VOLTERRA, systems::DAMPED] {
        assert!(!emits(smooth, "switching") && emits(smooth, "dmm::Unbounded"));
    }
    // an autonomous one no time derivatives
    assert!(emits(systems::DAMPED, "fn time_derivative"));
    for autonomous in [systems::HARMONIC, systems::ELLIPTIC, systems::KEPLER] {
        assert!(!emits(autonomous, "fn time_derivative"));
    }
    // a linear step no iteration
    assert!(emits(systems::HARMONIC, "Solvability::Linear"));
    assert!(emits(systems::ELLIPTIC, "Solvability::Nonlinear"));
    // a scheme without minimal norm no projection
    assert!(emits(systems::KEPLER, "MinimalNorm"));
    assert!(!emits(systems::RIGID_BODY, "MinimalNorm"));
}
