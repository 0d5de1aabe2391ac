//! Declarations with words and signs left out, exchanged, repeated or put in anywhere: parsing
//! ends, says what is wrong with the number of an entry of the catalogue, and what it accepts is
//! read again from its text.

use proc_macro2::TokenStream;
use proptest::prelude::*;
use proptest::sample::Index;

use super::read;
use super::round_trip::LANGUAGE;

/// What is put in.
const PIECES: &[&str] = &[
    ";",
    ",",
    "=",
    "==",
    "..",
    "..=",
    ".",
    "*",
    "^",
    "%",
    "-",
    "+=",
    ":",
    "->",
    "#",
    "!",
    "<",
    "'a",
    "()",
    "{}",
    "[]",
    "[0]",
    "(x, y)",
    "{ der(x) = 1; }",
    "0",
    "1.",
    "2x",
    "1e999",
    "\"s\"",
    "x",
    "state",
    "param",
    "const",
    "let",
    "fn",
    "interface",
    "region",
    "where",
    "der",
    "hamiltonian",
    "conserved",
    "assume",
    "for",
    "in",
    "sum",
    "on",
    "and",
    "system",
    "if",
    "else",
    "self",
    "r#x",
];

#[derive(Debug, Clone)]
enum Mutation {
    Remove(Index),
    Repeat(Index),
    Exchange(Index, Index),
    Insert(Index, &'static str),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let place = any::<Index>;
    prop_oneof![
        place().prop_map(Mutation::Remove),
        place().prop_map(Mutation::Repeat),
        (place(), place()).prop_map(|(one, other)| Mutation::Exchange(one, other)),
        (place(), prop::sample::select(PIECES)).prop_map(|(at, piece)| Mutation::Insert(at, piece)),
    ]
}

/// The words and signs of the declaration with every construct.
fn pieces() -> Vec<String> {
    let lines = LANGUAGE.lines().filter(|line| !line.contains("///"));
    let spaced: String = (lines.flat_map(str::chars))
        .flat_map(|letter| {
            let is_sign = !letter.is_alphanumeric() && letter != '_' && letter != '.';
            let space = if is_sign { " " } else { "" };
            [space.to_owned(), letter.to_string(), space.to_owned()]
        })
        .collect();
    spaced.split_whitespace().map(str::to_owned).collect()
}

fn mutate(pieces: &mut Vec<String>, mutation: &Mutation) {
    let count = pieces.len();
    match mutation {
        Mutation::Remove(at) => drop(pieces.remove(at.index(count))),
        Mutation::Repeat(at) => {
            let at = at.index(count);
            pieces.insert(at, pieces[at].clone());
        }
        Mutation::Exchange(one, other) => pieces.swap(one.index(count), other.index(count)),
        Mutation::Insert(at, piece) => pieces.insert(at.index(count), (*piece).to_owned()),
    }
}

proptest! {
    #[test]
    fn are_parsed_to_the_end(mutations in prop::collection::vec(mutation(), 1..6)) {
        let mut pieces = pieces();
        for mutation in &mutations {
            let mut mutated = pieces.clone();
            mutate(&mut mutated, mutation);
            // brackets that do not match never reach the macro
            if mutated.join(" ").parse::<TokenStream>().is_ok() {
                pieces = mutated;
            }
        }
        let text = pieces.join(" ");
        let (declaration, messages) = read(&text);
        prop_assert!(declaration.is_some() || !messages.is_empty());
        if let Some(declaration) = declaration.filter(|_| messages.is_empty()) {
            let printed = declaration.to_string();
            let (again, messages) = read(&printed);
            prop_assert_eq!(messages, Vec::<String>::new(), "{}", printed);
            prop_assert_eq!(again.map(|again| again.to_string()), Some(printed));
        }
    }
}
