//! What parses, how it is printed, and what is said about what does not parse.

mod events;
mod mistakes;
mod mutations;
mod nesting;
mod newcomers;
mod reading;
mod round_trip;

use proc_macro2::TokenStream;

use super::{Declaration, parse};
use crate::diagnostics::{Diagnostics, catalogue};

fn read(text: &str) -> (Option<Declaration>, Vec<String>) {
    let tokens: TokenStream = text.parse().expect("the test's text is made of tokens");
    let mut diagnostics = Diagnostics::new();
    let declaration = parse(tokens, &mut diagnostics);
    let messages = diagnostics.messages();
    for message in &messages {
        let number = message.rsplit_once("[PWS").map(|(_, number)| number);
        let number = number.and_then(|number| number.strip_suffix(']')?.parse().ok());
        let code = number.and_then(catalogue::find);
        assert!(code.is_some_and(|code| code.number < 200), "{message}");
    }
    (declaration, messages)
}

fn printed(text: &str) -> String {
    let (declaration, messages) = read(text);
    assert_eq!(messages, Vec::<String>::new(), "{text}");
    declaration.expect("no error, so a declaration").to_string()
}

/// The messages on `der(x) = formula;`.
fn formula_messages(formula: &str) -> Vec<String> {
    read(&format!("system S {{ state x; der(x) = {formula}; }}")).1
}

fn item_messages(items: &str) -> Vec<String> {
    read(&format!("system S {{ {items} }}")).1
}
