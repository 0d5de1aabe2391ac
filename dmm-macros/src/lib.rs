//! The procedural macro behind `dmm_runtime::pws!`: a shell around the compiler `dmm-compiler`.
//!
//! Depend on `dmm-runtime`, whose macro calls this one and whose items emitted code refers to. The
//! language is documented there.

use proc_macro::{Delimiter, TokenStream, TokenTree};

/// `[path of the runtime] declaration` → the items of the system.
///
/// Who calls it is the macro `pws!` of the runtime, which knows its own path, `$crate`.
#[proc_macro]
pub fn pws(input: TokenStream) -> TokenStream {
    let mut tokens = input.into_iter();
    match tokens.next() {
        Some(TokenTree::Group(runtime)) if runtime.delimiter() == Delimiter::Bracket => {
            let declaration: TokenStream = tokens.collect();
            dmm_compiler::compile_with(declaration.into(), &runtime.stream().into()).into()
        }
        _ => "::core::compile_error! { \"call `pws!` of `dmm-runtime`\" }"
            .parse()
            .unwrap_or_default(),
    }
}
