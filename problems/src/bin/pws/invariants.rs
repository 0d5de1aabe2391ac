//! `pws show … --find-invariants DEGREE`

use std::io::Write;

use dmm_compiler::diagnostics::Diagnostics;
use dmm_compiler::invariants;
use proc_macro2::TokenStream;

use crate::failure::Failure;

/// Prints the polynomial invariants of every system declared, up to `degree`; `report` tells
/// what is wrong with the declarations.
pub(crate) fn print(
    declarations: Vec<TokenStream>,
    degree: u32,
    report: impl Fn(&[Diagnostics]) -> Failure,
) -> Result<(), Failure> {
    let mut models = Vec::new();
    let mut wrong = Vec::new();
    for declaration in declarations {
        match invariants::read(declaration) {
            Ok(model) => models.push(model),
            Err(diagnostics) => wrong.push(diagnostics),
        }
    }
    if !wrong.is_empty() {
        return Err(report(&wrong));
    }
    let mut texts = Vec::new();
    for model in &mut models {
        let text = invariants::report(model, degree)
            .map_err(|obstacle| Failure::Request(format!("{}: {obstacle}", model.name)))?;
        texts.push(text);
    }
    write!(std::io::stdout().lock(), "{}", texts.join("\n"))?;
    Ok(())
}
