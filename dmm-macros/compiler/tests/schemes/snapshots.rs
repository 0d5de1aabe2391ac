//! Snapshots of the last stage: the listing, the emitted code, and how many operations it takes.

use std::fmt::Write as _;

use dmm_compiler::{compile, explain};
use insta::assert_snapshot;
use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

use crate::{corpus, systems, tokens};

fn listing(source: &str) -> String {
    explain(tokens(source)).unwrap_or_else(|messages| panic!("{messages:#?}"))
}

fn rust(source: &str) -> String {
    let file = syn::parse2(compile(tokens(source))).expect("emitted code is Rust");
    prettyplease::unparse(&file)
}

/// One system for each strategy: skew pairing, with an interface; cross product; minimal norm.
#[test]
fn code_is_as_it_was() {
    for (name, source) in [
        ("harmonic_rust", systems::HARMONIC),
        ("rigid_body_rust", systems::RIGID_BODY),
        ("damped_rust", systems::DAMPED),
    ] {
        let text = rust(source);
        // the listing is compared by itself
        let is_listing = |line: &&str| line.trim_start().starts_with("const LISTING:");
        let lines: Vec<&str> = text.lines().filter(|line| !is_listing(line)).collect();
        assert_snapshot!(name, lines.join("\n"));
    }
}

/// Beside those whose code is compared, a system with divided differences of an elementary function,
/// and one whose conserved quantities become dependent.
#[test]
fn listings_are_as_they_were() {
    for (name, source) in [
        ("harmonic_listing", systems::HARMONIC),
        ("rigid_body_listing", systems::RIGID_BODY),
        ("damped_listing", systems::DAMPED),
        ("pendulum_listing", systems::PENDULUM),
        ("kepler_listing", systems::KEPLER),
    ] {
        assert_snapshot!(name, listing(source));
    }
}

/// The methods that a run evaluates, with the heads of their columns.
const METHODS: [(&str, &str); 11] = [
    ("vector_field", "f"),
    ("conserved", "ψ"),
    ("conserved_size", "|ψ|"),
    ("multiplier", "Λ"),
    ("discrete_vector_field", "f^τ"),
    ("linearised", "f^τ, ∂f^τ"),
    ("time_derivative", "∂ₜf^τ"),
    ("switching_function", "g"),
    ("switching_size", "|g|"),
    ("switching_gradient", "∇g"),
    ("advance", "series"),
];

/// Operations in the source of a function.
#[derive(Clone, Copy, Default)]
struct Operations {
    /// Sums, products, quotients and signs.
    arithmetic: usize,
    /// Elementary functions and recurrences of series.
    calls: usize,
}

impl Operations {
    fn count(&mut self, body: TokenStream) {
        let mut before = [const { String::new() }; 3];
        let mut tokens = body.into_iter().peekable();
        while let Some(token) = tokens.next() {
            match &token {
                TokenTree::Punct(sign) if matches!(sign.as_char(), '+' | '-' | '*' | '/') => {
                    let next = tokens.peek().map(ToString::to_string);
                    let is_arrow = sign.spacing() == Spacing::Joint && next.as_deref() == Some(">");
                    // of the unary ones a sign is an operation, and a dereference is none
                    let is_unary = matches!(before[2].as_str(), "" | "=" | "," | ";" | "return");
                    if !(is_arrow || is_unary && sign.as_char() == '*') {
                        self.arithmetic += 1;
                    }
                }
                TokenTree::Ident(name) if before[1..] == [":", ":"] => {
                    let is_function = before[0] == "S" && name != "from_f64";
                    let is_recurrence = before[0] == "series" && !is_scale(&name.to_string());
                    self.calls += usize::from(is_function || is_recurrence);
                }
                TokenTree::Group(group) => self.count(group.stream()),
                _ => {}
            }
            before.rotate_left(1);
            before[2] = token.to_string();
        }
    }
}

/// Whether an item of the runtime's module `series` does no arithmetic with coefficients.
fn is_scale(name: &str) -> bool {
    matches!(name, "step" | "next_step" | "Straight" | "Rolled" | "Order")
}

/// Adds the operations of every method in `code`.
fn count(code: TokenStream, counts: &mut [Operations; METHODS.len()]) {
    let mut method = None;
    let mut follows_fn = false;
    for token in code {
        match &token {
            TokenTree::Ident(name) if follows_fn => {
                method = METHODS.iter().position(|(method, _)| name == method);
            }
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                match method.take() {
                    Some(method) => counts[method].count(group.stream()),
                    None => count(group.stream(), counts),
                }
            }
            _ => {}
        }
        follows_fn = matches!(&token, TokenTree::Ident(word) if word == "fn");
    }
}

/// Of every problem, all regions together: sums, products, quotients and signs, and behind a plus
/// the calls of elementary functions and of recurrences.
#[test]
fn operations_are_as_many_as_they_were() {
    let mut table = format!("{:24}", "");
    for (_, head) in METHODS {
        write!(table, "{head:>11}").expect("text");
    }
    for problem in corpus::problems() {
        let mut counts = [Operations::default(); METHODS.len()];
        count(compile(tokens(&problem.source)), &mut counts);
        write!(table, "\n{:24}", problem.name).expect("text");
        for Operations { arithmetic, calls } in counts {
            let cell = match (arithmetic, calls) {
                (0, 0) => "–".to_owned(),
                (_, 0) => arithmetic.to_string(),
                _ => format!("{arithmetic}+{calls}"),
            };
            write!(table, "{cell:>11}").expect("text");
        }
    }
    assert_snapshot!("operations", table);
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
        assert!(!emits(smooth, "switching") && emits(smooth, "dmm::NoGuards"));
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
