//! What the compiler was called with, for tests that call it again.

use proc_macro::{Delimiter, Group, Literal, Punct, Spacing, TokenStream, TokenTree};

/// The command line of the compiler that compiles this, as an array of strings: its program first.
///
/// Only cargo knows which files of the dependencies belong to a build, and it tells the compiler
/// alone.
#[proc_macro]
pub fn arguments(_: TokenStream) -> TokenStream {
    let strings = std::env::args().flat_map(|argument| {
        [
            TokenTree::Literal(Literal::string(&argument)),
            TokenTree::Punct(Punct::new(',', Spacing::Alone)),
        ]
    });
    let array = Group::new(Delimiter::Bracket, strings.collect());
    TokenTree::Group(array).into()
}
