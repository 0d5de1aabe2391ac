//! Mistakes that a newcomer makes, and what the compiler says to them.
//!
//! `tests/mistakes/list.txt` holds them: what was thought, and what was written. The snapshot
//! shows every message on the tokens that it stands on. A mistake has one message; where it is
//! none after all, the declaration compiles.

use std::fmt::Write as _;
use std::path::Path;

use dmm_compiler::diagnostics::{Diagnostics, catalogue};
use dmm_compiler::{compile, read_with};
use insta::assert_snapshot;
use proc_macro2::{LineColumn, TokenStream, TokenTree};

/// A section of the list.
struct Mistake {
    name: String,
    thought: String,
    declaration: String,
}

/// An error or a warning with the place that it is shown at.
struct Shown {
    severity: &'static str,
    message: String,
    start: LineColumn,
    end: LineColumn,
}

fn list() -> Vec<Mistake> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mistakes/list.txt");
    let text = std::fs::read_to_string(file).expect("the list of mistakes");
    let sections =
        text.split_inclusive('\n')
            .fold(Vec::new(), |mut sections: Vec<String>, line| {
                match (line.strip_prefix("== "), sections.last_mut()) {
                    (Some(name), _) => sections.push(name.to_owned()),
                    (None, Some(section)) => section.push_str(line),
                    (None, None) => {}
                }
                sections
            });
    sections
        .iter()
        .map(|section| {
            let (name, rest) = section.split_once('\n').expect("a name");
            let (thought, declaration) = rest.split_once('\n').expect("a thought");
            Mistake {
                name: name.to_owned(),
                thought: thought
                    .strip_prefix("thought: ")
                    .expect("`thought: ` in the second line")
                    .to_owned(),
                declaration: declaration.trim_end().to_owned(),
            }
        })
        .collect()
}

/// The `compile_error!`s in what the macro gives.
fn errors(declaration: &str) -> Vec<Shown> {
    let tokens: TokenStream = declaration.parse().expect("the mistakes are tokens");
    let mut errors = Vec::new();
    let mut start = None;
    for token in compile(tokens) {
        match token {
            TokenTree::Ident(ident) if ident == "compile_error" => start = Some(ident.span()),
            TokenTree::Group(group) => {
                let Some(start) = start.take() else { continue };
                let literal: syn::LitStr =
                    syn::parse2(group.stream()).expect("compile_error! has a text");
                errors.push(Shown {
                    severity: "error",
                    message: literal.value(),
                    start: start.start(),
                    end: group.span().end(),
                });
            }
            _ => {}
        }
    }
    errors
}

/// The warnings, of which the tokens that the macro gives make rustc warn.
fn warnings(declaration: &str) -> Vec<Shown> {
    let tokens: TokenStream = declaration.parse().expect("the mistakes are tokens");
    let mut diagnostics = Diagnostics::new();
    read_with(tokens, &mut diagnostics);
    let shown = |warning: &syn::Error| Shown {
        severity: "warning",
        message: warning.to_string(),
        start: warning.span().start(),
        end: warning.span().end(),
    };
    diagnostics.warnings().map(shown).collect()
}

/// Everything that is said about a declaration.
fn messages(declaration: &str) -> Vec<Shown> {
    let mut messages = errors(declaration);
    messages.extend(warnings(declaration));
    messages
}

/// The message above the line that it is about, underlined.
fn render(declaration: &str, error: &Shown) -> String {
    let Shown {
        severity,
        message,
        start,
        end,
    } = error;
    let line = declaration.lines().nth(start.line - 1).unwrap_or_default();
    let last = if end.line == start.line {
        end.column
    } else {
        line.chars().count()
    };
    let carets = "^".repeat(last.saturating_sub(start.column).max(1));
    let continued = if end.line == start.line { "" } else { "…" };
    let number = start.line;
    let indent = " ".repeat(start.column);
    format!("{severity}: {message}\n  {number:>3} | {line}\n      | {indent}{carets}{continued}\n")
}

#[test]
fn messages_say_what_to_do() {
    let mut text = String::new();
    for mistake in list() {
        let Mistake {
            name,
            thought,
            declaration,
        } = mistake;
        writeln!(text, "== {name}: {thought}\n").expect("text");
        let errors = messages(&declaration);
        if errors.is_empty() {
            text.push_str("compiles\n");
        }
        for error in errors {
            text.push_str(&render(&declaration, &error));
        }
        text.push('\n');
    }
    assert_snapshot!("mistakes", text);
}

#[test]
fn a_mistake_has_one_message() {
    // where it is made at several places, each of them is shown; and three are none after all
    const OTHERS: &[(&str, usize)] = &[
        ("half as an integer division", 0),
        ("degrees", 0),
        ("argument called like a state", 0),
        ("Leibniz's notation", 2),
        ("condition on a state", 2),
        ("condition with another bound", 2),
        ("a group without its index", 4),
        ("index in round parentheses", 2),
        ("index from one", 4),
        ("two indices", 2),
        ("index of a scalar", 4),
        ("length from a parameter", 2),
        ("rate as a field", 2),
    ];
    let mut wrong = String::new();
    for mistake in list() {
        let other = OTHERS.iter().find(|(name, _)| *name == mistake.name);
        let expected = other.map_or(1, |&(_, count)| count);
        let errors = messages(&mistake.declaration);
        if errors.len() != expected {
            writeln!(wrong, "{}: {} messages", mistake.name, errors.len()).expect("text");
            for error in errors {
                wrong.push_str(&render(&mistake.declaration, &error));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_message_has_a_code() {
    let codes: Vec<String> = catalogue::all().iter().map(ToString::to_string).collect();
    for mistake in list() {
        for error in messages(&mistake.declaration) {
            let code = error.message.rsplit_once('[').map(|(_, code)| code);
            let code = code.and_then(|code| code.strip_suffix(']'));
            assert!(
                code.is_some_and(|code| codes.iter().any(|known| known == code)),
                "{}: {}",
                mistake.name,
                error.message
            );
        }
    }
}
