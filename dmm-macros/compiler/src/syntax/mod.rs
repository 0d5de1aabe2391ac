//! Tokens → declaration: what was written, with its spans, and no mathematics.
//!
//! The stage is [`parse`]. It knows the shape of the language only: names are not resolved, and
//! `pi`, `t` and functions are names like others.
//!
//! ```text
//! system    = "system" Name "{" item* "}"
//! item      = "state" group ("," group)* ";"
//!           | "param" group "=" default ("," group "=" default)* ";"
//!           | ("const" | "let") name "=" formula ("," name "=" formula)* ";"
//!           | "fn" name "(" name ("," name)* ")" "=" formula ";"
//!           | "interface" name "=" formula ["," "sliding"] ";"
//!           | "sliding" name "{" item* "}"
//!           | "region" name ["where" side ("and" side)*] "{" item* "}"
//!           | "der" "(" target ")" "=" formula ";"
//!           | "hamiltonian" name "=" formula "in" pair ("," pair)* ";"
//!           | ["assume"] "conserved" name "=" formula ";"
//!           | "for" name "in" range "{" item* "}"
//! group     = name ["[" formula "]"]
//! default   = formula | "[" formula ("," formula)* "]"
//! side      = name (">" | "<") "0"
//! target    = name ["[" formula "]"]
//! pair      = "(" target "," target ")"
//! range     = formula ".." formula
//!
//! formula   = product (("+" | "-") product)*
//! product   = signed (("*" | "/" | "%") signed)*
//! signed    = "-" signed | power
//! power     = operand ["^" exponent]          right-associative: x^y^z = x^(y^z)
//! exponent  = "-" exponent | power            so that 2^-1 needs no parentheses
//! operand   = number | name | name "[" formula "]" | name "(" formula ("," formula)* ")"
//!           | "sum" "(" name "in" range "," formula ")" | "(" formula ")"
//! ```
//!
//! A region has `let`, `der`, `hamiltonian`, `conserved` and `for` items, a loop `der`,
//! `conserved` and `for` items, the block of a sliding motion `conserved` items.
//! Documentation comments may precede the system, every item but `for`, and every name of a
//! list. An error loses one item: parsing goes on behind its `;` or block, so that all are found.
//! Names of the system, of states, parameters and regions are kept even then, for the stub of the
//! declaration.

mod canonical;
mod condition;
mod declaration;
mod definition;
mod event;
mod expression;
mod formula;
mod group;
mod instead;
mod item;
mod mistake;
mod name;
mod number;
mod place;
mod print;
mod target;
mod unknown;

#[cfg(test)]
mod tests;

use proc_macro2::{Span, TokenStream, TokenTree};
use syn::parse::{ParseStream, Parser};
use syn::{Attribute, Visibility, braced, token};

use crate::diagnostics::catalogue::syntax::{ATTRIBUTE, DEPTH, HEAD, NUMBER, ONE_SYSTEM, SYNTAX};
use crate::diagnostics::{Code, Diagnostics, Extent};
pub use declaration::{
    Assignment, Comparison, Condition, ConservedItem, Declaration, Defaults, Definition,
    Derivative, Direction, EventItem, ForItem, FunctionItem, Group, HamiltonianItem, InterfaceItem,
    Item, ParameterItem, Range, RegionItem, Relation, SlidingItem, Target, Trigger,
};
pub use expression::{Expression, ExpressionKind, Operator};
pub(crate) use name::{is_identifier, is_name_of_type};
use place::Place;

/// Brackets of any kind may be nested this deep. It is more than the grammar can use, and little
/// enough for the recursive descent into them.
const DEEPEST_BRACKETS: usize = 128;

/// Parses one `system`. The declaration is there, possibly with items missing, whenever its
/// head could be read; it is complete if nothing was added to `diagnostics`.
pub fn parse(input: TokenStream, diagnostics: &mut Diagnostics) -> Option<Declaration> {
    if let Err((code, place, message)) = bounded(&input) {
        diagnostics.report(code, place, message);
        return None;
    }
    let before = diagnostics.len();
    let mut outcome = None;
    let read = |input: ParseStream<'_>| {
        outcome = Some(system(input, diagnostics));
        name::skip_all(input);
        Ok(())
    };
    // An error within parentheses leaves tokens behind, of which syn complains as well: that
    // complaint is not passed on where the reason has been reported.
    let left_over = read.parse2(input).err();
    match outcome? {
        Ok(declaration) => {
            if let Some(error) = left_over.filter(|_| diagnostics.len() == before) {
                diagnostics.report(SYNTAX, error.span(), error);
            }
            Some(declaration)
        }
        Err(error) => {
            name::report(diagnostics, error);
            None
        }
    }
}

/// Refuses the first bracket that is nested too deeply, and the first number that is too long:
/// the parser reads brackets by recursion, and a number in a time that grows with the square of
/// its length. The search
/// does not recurse.
fn bounded(input: &TokenStream) -> Result<(), (Code, Span, String)> {
    let mut open = vec![input.clone().into_iter()];
    while let Some(innermost) = open.last_mut() {
        match innermost.next() {
            Some(TokenTree::Group(group)) if open.len() > DEEPEST_BRACKETS => {
                let message = "brackets are nested too deeply".to_owned();
                return Err((DEPTH, group.span_open(), message));
            }
            Some(TokenTree::Group(group)) => open.push(group.stream().into_iter()),
            Some(TokenTree::Literal(literal)) => {
                if let Some(message) = number::too_long(&literal.to_string()) {
                    return Err((NUMBER, literal.span(), message));
                }
            }
            Some(_) => {}
            None => drop(open.pop()),
        }
    }
    Ok(())
}

/// `system Name { … }`
fn system(input: ParseStream<'_>, diagnostics: &mut Diagnostics) -> syn::Result<Declaration> {
    const EXPECTED: &str = "expected `system Name { … }`";
    if input.is_empty() {
        return Err(HEAD.error(Span::call_site(), EXPECTED));
    }
    if input.peek(syn::Token![#]) && input.peek2(syn::Token![!]) {
        let message = "document the system with `///` in front of it";
        return Err(ATTRIBUTE.error(input.span(), message));
    }
    let attributes = documentation(input, diagnostics)?;
    let visibility: Visibility = input
        .parse()
        .map_err(|error: syn::Error| SYNTAX.error(error.span(), error))?;
    let Some(keyword) = name::peek_word(input) else {
        return Err(HEAD.error(input.span(), EXPECTED));
    };
    if keyword != "system" {
        return Err(HEAD.error(&keyword, EXPECTED));
    }
    name::word(input)?;
    let name = name::declared_type(input, diagnostics)?;
    if !input.peek(token::Brace) {
        let message = format!(
            "expected `{{` after `system {name}`: states and parameters are declared in its block"
        );
        return Err(HEAD.error(input.span(), message));
    }
    let body;
    braced!(body in input);
    let items = item::items(&body, Place::System, diagnostics);
    if input.peek(syn::Token![;]) && input.peek2(syn::parse::End) {
        let message = "leave out the `;` behind the block of a system";
        diagnostics.report(ONE_SYSTEM, input.span(), message);
        name::skip_all(input);
    }
    if !input.is_empty() {
        let message = "one `pws!` declares one system; write another `pws!` for the next";
        diagnostics.report(ONE_SYSTEM, input.span(), message);
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
    let mut documentation = Vec::new();
    while input.peek(syn::Token![#]) && input.peek2(token::Bracket) {
        documentation.extend(
            Attribute::parse_outer(input).map_err(|error| SYNTAX.error(error.span(), error))?,
        );
    }
    documentation.retain(|attribute: &Attribute| {
        let is_documentation = attribute.path().is_ident("doc");
        if !is_documentation {
            let place = Extent::new(
                attribute.pound_token.span,
                attribute.bracket_token.span.close(),
            );
            let message = "only documentation comments (`///`) may stand here; other attributes are not supported";
            diagnostics.report(ATTRIBUTE, place, message);
        }
        is_documentation
    });
    Ok(documentation)
}
