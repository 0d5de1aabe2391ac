//! What a correct declaration becomes, and what is said about a wrong one.

mod declared;
mod events;
mod formulas;
mod functions;
mod groups;
mod hamiltonians;
mod loops;
mod regions;
mod shared;
mod size;
mod switches;

use proc_macro2::TokenStream;

use super::resolve;
use crate::diagnostics::Diagnostics;
use crate::model::Model;
use crate::syntax;

fn read(text: &str) -> (Option<Model>, Vec<String>) {
    let tokens: TokenStream = text.parse().expect("the test's text is made of tokens");
    let mut diagnostics = Diagnostics::new();
    let declaration = syntax::parse(tokens, &mut diagnostics);
    assert_eq!(diagnostics.messages(), Vec::<String>::new(), "{text}");
    let declaration = declaration.expect("no error, so a declaration");
    let model = resolve(declaration, &mut diagnostics);
    assert_eq!(model.is_some(), diagnostics.is_empty());
    let warnings = diagnostics.warnings().map(|one| format!("warning: {one}"));
    let messages = diagnostics.messages().into_iter().chain(warnings).collect();
    (model, messages)
}

#[track_caller]
fn model(text: &str) -> Model {
    let (model, messages) = read(text);
    assert_eq!(messages, Vec::<String>::new(), "{text}");
    model.expect("no error, so a model")
}

/// The messages on the items of a system.
fn messages(items: &str) -> Vec<String> {
    read(&format!("system S {{ {items} }}")).1
}

#[track_caller]
fn one(items: &str, message: &str) {
    let messages = messages(items);
    assert_eq!(messages.len(), 1, "{items}: {messages:?}");
    assert!(messages[0].contains(message), "{items}: {messages:?}");
}

/// The messages on the items of a system begin like this.
#[track_caller]
fn all(items: &str, expected: &[&str]) {
    let messages = messages(items);
    let begins = |(message, expected): (&String, &&str)| message.starts_with(expected);
    let is_right = messages.len() == expected.len() && messages.iter().zip(expected).all(begins);
    assert!(is_right, "{items}: {messages:#?}, not {expected:#?}");
}

/// The formula of a rate or a conserved quantity as text.
fn text(model: &Model, id: crate::algebra::Id) -> String {
    crate::algebra::to_text(&model.dag, id)
}

/// The field of a region as text.
fn field(model: &Model, region: usize) -> Vec<String> {
    let field = model.regions[region].field.iter();
    field.map(|&rate| text(model, rate)).collect()
}
