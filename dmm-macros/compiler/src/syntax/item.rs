//! The items of a system and of its regions: which one stands next, and what is wrong if none
//! does.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Attribute, Token, braced, token};

use super::definition::{conserved, definitions, derivative, interface, states};
use super::{Definition, Item, RegionItem};
use super::{condition, documentation, name};
use crate::diagnostics::{Diagnostics, Extent, closest};

/// Where an item stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// In the system's block.
    System,
    /// In a region's block.
    Region,
}

/// The items that a region does not have.
const SYSTEM_ITEMS: &[&str] = &["state", "param", "const", "interface", "region", "on"];

/// The items up to the end of a block. What is wrong is reported, and parsing goes on.
pub(super) fn items(
    input: ParseStream<'_>,
    place: Place,
    diagnostics: &mut Diagnostics,
) -> Vec<Item> {
    let mut items = Vec::new();
    while !input.is_empty() {
        let before = input.cursor();
        if let Err(error) = item(input, place, &mut items, diagnostics) {
            diagnostics.push(error);
            name::recover(input);
        }
        if input.cursor() == before {
            name::skip_one(input);
        }
    }
    items
}

/// One statement; a list such as `param k = 1, m = 2;` becomes an item each.
fn item(
    input: ParseStream<'_>,
    place: Place,
    items: &mut Vec<Item>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<()> {
    if input.peek(Token![#]) && input.peek2(Token![!]) {
        let error = name::error_here(input, "document an item with `///` in front of it");
        (0..3).for_each(|_| drop(name::skip_one(input)));
        return Err(error);
    }
    let attributes = documentation(input, diagnostics)?;
    let Some(keyword) = name::peek_word(input) else {
        return Err(name::error_here(input, expected(place)));
    };
    let text = keyword.to_string();
    if place == Place::Region && SYSTEM_ITEMS.contains(&text.as_str()) {
        let message = format!("`{text}` belongs at the top level of the system, not in a region");
        name::word(input)?;
        return Err(syn::Error::new(keyword.span(), message));
    }
    if !name::ITEMS.contains(&text.as_str()) {
        return Err(unknown_item(input, &keyword, place));
    }
    name::word(input)?;
    items.extend(behind_keyword(input, &keyword, attributes, diagnostics)?);
    Ok(())
}

/// What a known keyword begins.
fn behind_keyword(
    input: ParseStream<'_>,
    keyword: &Ident,
    attributes: Vec<Attribute>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Vec<Item>> {
    let text = keyword.to_string();
    let mut list = |item: fn(Definition) -> Item, attributes| {
        let definitions = definitions(input, &text, attributes, diagnostics)?;
        Ok(definitions.into_iter().map(item).collect())
    };
    let item = match text.as_str() {
        "param" => return list(Item::Parameter, attributes),
        "const" => return list(Item::Constant, attributes),
        "let" => return list(Item::Let, attributes),
        "state" => Item::State(states(input, attributes, diagnostics)?),
        "interface" => Item::Interface(interface(input, attributes)?),
        "region" => Item::Region(region(input, attributes, diagnostics)?),
        "der" => Item::Derivative(derivative(input, attributes)?),
        "conserved" => Item::Conserved(conserved(input, attributes)?),
        _ => {
            return Err(syn::Error::new(
                keyword.span(),
                "state jumps (`on`) are not supported yet: a trajectory is continuous across an interface",
            ));
        }
    };
    Ok(vec![item])
}

fn expected(place: Place) -> &'static str {
    match place {
        Place::System => {
            "expected `state`, `param`, `const`, `let`, `interface`, `region`, `der` or `conserved`"
        }
        Place::Region => "expected `let`, `der` or `conserved`",
    }
}

fn unknown_item(input: ParseStream<'_>, keyword: &Ident, place: Place) -> syn::Error {
    let text = keyword.to_string();
    let rest = input.fork();
    name::skip_one(&rest);
    let message = if rest.peek(Token![=]) {
        format!("write `let {text} = …;` to name a formula")
    } else if rest.peek(Token![/]) {
        "a derivative is written `der(x) = …;`".into()
    } else {
        match text.as_str() {
            "parameter" | "parameters" | "params" => {
                format!("unknown item `{text}`: write `param`")
            }
            "variable" | "variables" | "var" | "states" => {
                format!("unknown item `{text}`: write `state`")
            }
            "invariant" | "conserve" | "conserves" => {
                format!("unknown item `{text}`: write `conserved`")
            }
            "system" => "a system cannot contain another one".into(),
            _ => match closest(&text, name::ITEMS.iter().copied()) {
                Some(word) => format!("unknown item `{text}`; did you mean `{word}`?"),
                None => format!("unknown item `{text}`: {}", expected(place)),
            },
        }
    };
    syn::Error::new(keyword.span(), message)
}

/// `name where … { … }`
fn region(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<RegionItem> {
    let ident = name::declared(input)?;
    let mut conditions = Vec::new();
    if name::peek_is(input, "where") {
        let word = name::word(input)?;
        let before = diagnostics.len();
        conditions = condition::conditions(input, diagnostics);
        if conditions.is_empty() && diagnostics.len() == before {
            diagnostics.error(word.span(), "expected a condition, as in `where wall > 0`");
        }
    }
    if !input.peek(token::Brace) {
        return Err(if input.peek(Token![;]) || input.is_empty() {
            Extent::from(&ident).error("a region has a block `{ … }` with its `der` items")
        } else {
            name::error_here(input, "expected `where …` or the region's block `{ … }`")
        });
    }
    let body;
    braced!(body in input);
    let items = items(&body, Place::Region, diagnostics);
    Ok(RegionItem {
        attributes,
        ident,
        conditions,
        items,
    })
}
