//! The items of a system, its regions and loops: which one stands next.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Attribute, Token, braced, token};

use super::definition::{conserved, definitions, derivative, interface};
use super::place::Place;
use super::{ConservedItem, Definition, ForItem, Item, RegionItem, SlidingItem};
use super::{canonical, condition, documentation, event, formula, group, mistake, name, unknown};
use crate::diagnostics::catalogue::syntax::{
    ASSUME, ATTRIBUTE, DEPTH, LOOP, NAME, REGION, SLIDING,
};
use crate::diagnostics::{Diagnostics, Extent};

/// Loops may be nested this deep.
const DEEPEST_LOOP: usize = 8;

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
            name::report(diagnostics, error);
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
        let error = ATTRIBUTE.error(input.span(), "document an item with `///` in front of it");
        (0..3).for_each(|_| drop(name::skip_one(input)));
        return Err(error);
    }
    let attributes = documentation(input, diagnostics)?;
    let Some(keyword) = name::peek_word(input) else {
        let error = unknown::no_word(input, place);
        if !input.peek(Token![;]) {
            // the words behind `#` are no items
            name::skip_one(input);
            name::skip_one(input);
        }
        return Err(error);
    };
    if let Some(error) = unknown::misplaced(&keyword, place) {
        name::word(input)?;
        if keyword != "state" && keyword != "param" {
            return Err(error);
        }
        // the names are kept: others refer to them
        name::report(diagnostics, error);
        let mut known = Diagnostics::new();
        items.extend(behind_keyword(
            input, &keyword, attributes, place, &mut known,
        )?);
        return Ok(());
    }
    if !name::ITEMS.contains(&keyword.to_string().as_str()) {
        return Err(unknown::word(input, &keyword, place));
    }
    name::word(input)?;
    items.extend(behind_keyword(
        input,
        &keyword,
        attributes,
        place,
        diagnostics,
    )?);
    Ok(())
}

/// What a known keyword begins.
fn behind_keyword(
    input: ParseStream<'_>,
    keyword: &Ident,
    attributes: Vec<Attribute>,
    place: Place,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Vec<Item>> {
    let text = keyword.to_string();
    let mut list = |item: fn(Definition) -> Item| {
        let definitions = definitions(input, &text, &attributes, diagnostics);
        Ok(definitions.into_iter().map(item).collect())
    };
    let item = match text.as_str() {
        "const" => return list(Item::Constant),
        "let" => return list(Item::Let),
        "param" => return Ok(group::parameters(input, &attributes, diagnostics)),
        "state" => Item::State(group::states(input, &attributes, diagnostics)),
        "fn" => Item::Function(canonical::function(input, attributes)?),
        "discrete" => return list(Item::Discrete),
        "interface" => Item::Interface(interface(input, attributes)?),
        "region" => Item::Region(region(input, attributes, diagnostics)?),
        "sliding" => Item::Sliding(sliding(input, diagnostics)?),
        "der" => Item::Derivative(derivative(input, attributes)?),
        "hamiltonian" => Item::Hamiltonian(canonical::hamiltonian(input, attributes)?),
        "conserved" => Item::Conserved(ConservedItem {
            definition: conserved(input, attributes)?,
            assumed: false,
        }),
        "assume" => Item::Conserved(assumed(input, attributes)?),
        "for" => Item::For(repeat(input, &attributes, place, diagnostics)?),
        _ => Item::Event(event::event(input, keyword, attributes, diagnostics)?),
    };
    Ok(vec![item])
}

/// `conserved name = ψ;` behind `assume`
fn assumed(input: ParseStream<'_>, attributes: Vec<Attribute>) -> syn::Result<ConservedItem> {
    if !name::peek_is(input, "conserved") {
        let message = "write `assume conserved name = …;`";
        return Err(ASSUME.error(input.span(), message));
    }
    name::word(input)?;
    Ok(ConservedItem {
        definition: conserved(input, attributes)?,
        assumed: true,
    })
}

/// `interface { conserved … }`
fn sliding(input: ParseStream<'_>, diagnostics: &mut Diagnostics) -> syn::Result<SlidingItem> {
    const FORM: &str = "what holds while a solution slides stands in a block of its interface, as in `sliding belt { conserved energy = …; }`";
    if name::peek_word(input).is_none() {
        return Err(SLIDING.error(input.span(), FORM));
    }
    let interface = name::declared(input)?;
    if !input.peek(token::Brace) {
        return Err(SLIDING.error(input.span(), FORM));
    }
    let body;
    braced!(body in input);
    let items = items(&body, Place::Sliding, diagnostics);
    Ok(SlidingItem { interface, items })
}

/// `name where … { … }`
fn region(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<RegionItem> {
    if name::peek_is(input, "where") && !input.peek2(token::Brace) {
        let message = "expected a name, as in `region above where …`";
        return Err(NAME.error(input.span(), message));
    }
    let ident = name::declared_or_reported(input, diagnostics)?;
    let mut conditions = Vec::new();
    if name::peek_is(input, "where") {
        let word = name::word(input)?;
        if input.is_empty() || input.peek(token::Brace) || input.peek(Token![;]) {
            let message = "expected a condition, as in `where wall > 0`";
            diagnostics.report(REGION, word.span(), message);
        }
        conditions = condition::conditions(input, diagnostics);
    }
    let mut region = RegionItem {
        attributes,
        ident,
        conditions,
        items: Vec::new(),
    };
    if !input.peek(token::Brace) {
        name::report(diagnostics, no_block(input, &region.ident));
        // the name is kept: others refer to it
        name::recover(input);
        return Ok(region);
    }
    let body;
    braced!(body in input);
    region.items = items(&body, Place::Region, diagnostics);
    Ok(region)
}

/// The error where the block of the region `ident` should stand.
fn no_block(input: ParseStream<'_>, ident: &Ident) -> syn::Error {
    if input.peek(Token![;]) || input.is_empty() {
        REGION.error(ident, "a region has a block `{ … }` with its `der` items")
    } else if input.peek(Token![>]) || input.peek(Token![<]) {
        let message = "a region has a name in front of its conditions: write `region name where wall > 0 { … }` with `interface wall = …;`";
        REGION.error(ident, message)
    } else if input.peek(Token![:]) || name::peek_word(input).is_some() {
        let message = format!(
            "a region says where it lies: write `region {ident} where wall > 0 {{ … }}` (or `< 0`) with `interface wall = …;`"
        );
        REGION.error(input.span(), message)
    } else {
        let message = "expected `where …` or the region's block `{ … }`";
        REGION.error(input.span(), message)
    }
}

/// The rest of `for i in start..end { … }`, in a block at `place`.
fn repeat(
    input: ParseStream<'_>,
    attributes: &[Attribute],
    place: Place,
    diagnostics: &mut Diagnostics,
) -> syn::Result<ForItem> {
    const FORM: &str = "a loop is written `for i in 0..n { … }`";
    if let Some(first) = attributes.first() {
        let message = "a loop leaves nothing behind that could be documented: write `//`, or document the items in it";
        diagnostics.report(ATTRIBUTE, first.pound_token.span, message);
    }
    if input.peek(token::Paren) {
        return Err(LOOP.error(input.span(), FORM));
    }
    let variable = name::declared(input)?;
    if input.peek(Token![,]) {
        let message = format!("{FORM}, with one index; put loops into each other");
        return Err(LOOP.error(input.span(), message));
    }
    if !input.peek(Token![in]) {
        return Err(LOOP.error(input.span(), FORM));
    }
    input.parse::<Token![in]>()?;
    let range = formula::range(input, 0)?;
    if input.peek(Token![,]) {
        let message = format!("{FORM}, with one index; put loops into each other");
        return Err(LOOP.error(input.span(), message));
    }
    if !input.peek(token::Brace) {
        let place = if name::begins_item(input) || input.is_empty() || input.peek(Token![;]) {
            Extent::from(&variable).to(range.end.extent)
        } else {
            return Err(mistake::unexpected(input, &range.end));
        };
        let message = "the items that the loop repeats stand in a block `{ … }`";
        return Err(LOOP.error(place, message));
    }
    let depth = place.loops() + 1;
    if depth > DEEPEST_LOOP {
        return Err(DEPTH.error(&variable, "loops are nested too deeply"));
    }
    let body;
    braced!(body in input);
    let items = items(&body, Place::Loop(depth), diagnostics);
    Ok(ForItem {
        variable,
        range,
        items,
    })
}
