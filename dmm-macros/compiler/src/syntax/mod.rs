//! Tokens → declaration: what was written, with its spans, and no mathematics.
//!
//! The stage is [`parse`]. It knows the shape of the language only: names are not resolved, and
//! `pi`, `t` and functions are names like others.
//!
//! ```text
//! system    = "system" Name "{" item* "}"
//! item      = "state" name ("," name)* ";"
//!           | "param" name "=" formula ("," name "=" formula)* ";"
//!           | ("const" | "let") name "=" formula ("," name "=" formula)* ";"
//!           | "interface" name "=" formula ";"
//!           | "region" name ["where" side ("and" side)*] "{" item* "}"
//!           | "der" "(" name ")" "=" formula ";"
//!           | "conserved" name "=" formula ";"
//! side      = name (">" | "<") "0"
//!
//! formula   = product (("+" | "-") product)*
//! product   = signed (("*" | "/") signed)*
//! signed    = "-" signed | power
//! power     = operand ["^" exponent]          right-associative: x^y^z = x^(y^z)
//! exponent  = "-" exponent | power            so that 2^-1 needs no parentheses
//! operand   = number | name | name "(" formula ("," formula)* ")" | "(" formula ")"
//! ```
//!
//! Documentation comments may precede the system, every item, and every name of a list. An
//! error loses one item: parsing goes on behind its `;` or block, so that all are found.

mod condition;
mod declaration;
mod definition;
mod expression;
mod item;
mod mistake;
mod name;
mod number;
mod print;

#[cfg(test)]
mod tests;

use proc_macro2::{Span, TokenStream};
use syn::parse::{ParseStream, Parser};
use syn::{Attribute, Visibility, braced, token};

use crate::diagnostics::{Diagnostics, Extent};
pub use declaration::{
    Condition, Declaration, Definition, Derivative, Documented, Item, RegionItem, Relation,
};
pub use expression::{Expression, ExpressionKind, Operator};

/// Parses one `system`. The declaration is there, possibly with items missing, whenever its
/// head could be read; it is complete if nothing was added to `diagnostics`.
pub fn parse(input: TokenStream, diagnostics: &mut Diagnostics) -> Option<Declaration> {
    let before = diagnostics.len();
    let mut declaration = None;
    let outcome = |input: ParseStream<'_>| {
        declaration = Some(system(input, diagnostics)?);
        Ok(())
    };
    // An error within parentheses leaves tokens behind, of which syn complains as well: that
    // complaint is not passed on where the reason has been reported.
    if let Err(error) = outcome.parse2(input)
        && (declaration.is_none() || diagnostics.len() == before)
    {
        diagnostics.push(error);
    }
    declaration
}

/// `system Name { … }`
fn system(input: ParseStream<'_>, diagnostics: &mut Diagnostics) -> syn::Result<Declaration> {
    const EXPECTED: &str = "expected `system Name { … }`";
    if input.is_empty() {
        return Err(syn::Error::new(Span::call_site(), EXPECTED));
    }
    if input.peek(syn::Token![#]) && input.peek2(syn::Token![!]) {
        return Err(name::error_here(
            input,
            "document the system with `///` in front of it",
        ));
    }
    let attributes = documentation(input, diagnostics)?;
    let visibility: Visibility = input.parse()?;
    let Some(keyword) = name::peek_word(input) else {
        return Err(name::error_here(input, EXPECTED));
    };
    if keyword != "system" {
        return Err(syn::Error::new(keyword.span(), EXPECTED));
    }
    name::word(input)?;
    let name = name::declared(input)?;
    if !input.peek(token::Brace) {
        return Err(name::error_here(
            input,
            format!("expected `{{` after `system {name}`"),
        ));
    }
    let body;
    braced!(body in input);
    let items = item::items(&body, item::Place::System, diagnostics);
    if !input.is_empty() {
        diagnostics.error(
            input.span(),
            "one `pws!` declares one system; write another `pws!` for the next",
        );
        name::skip_all(input);
    }
    Ok(Declaration {
        attributes,
        visibility,
        name,
        items,
    })
}

/// The documentation comments at the front of `input`; other attributes are refused.
fn documentation(
    input: ParseStream<'_>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Vec<Attribute>> {
    let mut documentation = Attribute::parse_outer(input)?;
    documentation.retain(|attribute| {
        let is_documentation = attribute.path().is_ident("doc");
        if !is_documentation {
            let place = Extent::new(
                attribute.pound_token.span,
                attribute.bracket_token.span.close(),
            );
            diagnostics.error(
                place,
                "only documentation comments (`///`) may stand here; other attributes are not supported",
            );
        }
        is_documentation
    });
    Ok(documentation)
}
