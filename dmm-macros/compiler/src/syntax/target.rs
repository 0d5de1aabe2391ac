//! The state that a `der` or a canonical pair is about: `x`, or an element `q[i]` of a group.

use syn::parse::ParseStream;
use syn::token;

use super::{Target, formula, name};
use crate::diagnostics::Extent;
use crate::diagnostics::catalogue::syntax::INDEX;

/// `x` or `q[i]`
pub(super) fn target(input: ParseStream<'_>) -> syn::Result<Target> {
    let ident = name::declared(input)?;
    let mut extent = Extent::from(&ident);
    let mut index = None;
    if input.peek(token::Bracket) {
        let (formula, close) = formula::index(input, &ident, 0)?;
        extent = extent.to(close);
        index = Some(formula);
    }
    if input.peek(token::Paren) {
        let message = format!("an element of a group is written with brackets, as in `{ident}[0]`");
        return Err(INDEX.error(input.span(), message));
    }
    Ok(Target {
        ident,
        index,
        extent,
    })
}
