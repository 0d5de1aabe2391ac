//! What happens in an instant: `on wall falling where v < 0 { v = -e * v; conserves momentum; }`,
//! `every 2 { … }`, `at 3 { … }`.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Attribute, Token, braced, token};

use super::definition::{after_formula, equals};
use super::target::target;
use super::{Assignment, Comparison, Direction, EventItem, Trigger};
use super::{formula, name};
use crate::diagnostics::catalogue::syntax::{EVENT, SEMICOLON};
use crate::diagnostics::{Diagnostics, Extent};

/// What follows `on`, `every` or `at`.
pub(super) fn event(
    input: ParseStream<'_>,
    keyword: &Ident,
    attributes: Vec<Attribute>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<EventItem> {
    let (trigger, extent) = trigger(input, keyword)?;
    let mut conditions = Vec::new();
    if name::peek_is(input, "where") {
        name::word(input)?;
        conditions = comparisons(input)?;
    }
    if !input.peek(token::Brace) {
        let message = "expected a block of what changes, as in `on wall falling { v = -v; }`";
        return Err(EVENT.error(input.span(), message));
    }
    let body;
    braced!(body in input);
    let mut event = EventItem {
        attributes,
        trigger,
        conditions,
        assignments: Vec::new(),
        conserved: Vec::new(),
        extent,
    };
    while !body.is_empty() {
        if let Err(error) = statement(&body, &mut event) {
            name::report(diagnostics, error);
            // what stands there is no item, even if it begins like one
            name::skip_one(&body);
            name::recover(&body);
        }
    }
    Ok(event)
}

fn trigger(input: ParseStream<'_>, keyword: &Ident) -> syn::Result<(Trigger, Extent)> {
    let start = Extent::from(keyword);
    if keyword == "every" || keyword == "at" {
        let time = formula::formula(input)?;
        let extent = start.to(time.extent);
        let trigger = if keyword == "every" {
            Trigger::Every(time)
        } else {
            Trigger::At(time)
        };
        return Ok((trigger, extent));
    }
    if name::peek_word(input).is_none() || name::peek_is(input, "where") {
        let message = "expected the name of an interface, as in `on wall falling { v = -v; }`";
        return Err(EVENT.error(input.span(), message));
    }
    let interface = name::declared(input)?;
    let mut extent = start.to(Extent::from(&interface));
    let direction = match name::peek_word(input) {
        Some(word) if word != "where" => {
            let word = name::word(input)?;
            extent = extent.to(Extent::from(&word));
            direction(&word)?
        }
        _ if input.peek(Token![>]) || input.peek(Token![<]) || input.peek(Token![=]) => {
            let message = format!(
                "an event has a direction instead of a sign: write `on {interface} rising {{ … }}`, `on {interface} falling {{ … }}`, or `on {interface} {{ … }}` for both"
            );
            return Err(EVENT.error(input.span(), message));
        }
        _ => Direction::Both,
    };
    let trigger = Trigger::On {
        interface,
        direction,
    };
    Ok((trigger, extent))
}

fn direction(word: &Ident) -> syn::Result<Direction> {
    match word.to_string().as_str() {
        "rising" => Ok(Direction::Rising),
        "falling" => Ok(Direction::Falling),
        "both" => Ok(Direction::Both),
        _ => {
            let message = "expected `rising`, `falling`, `where …` or the block `{ … }`";
            Err(EVENT.error(word, message))
        }
    }
}

/// `v < 0 and theta > 0.05`, up to the block.
fn comparisons(input: ParseStream<'_>) -> syn::Result<Vec<Comparison>> {
    let mut comparisons = vec![formula::comparison(input, &EVENT)?];
    while !input.is_empty() && !input.peek(token::Brace) {
        if name::peek_is(input, "and") || input.peek(Token![,]) {
            name::skip_one(input);
        } else if input.peek(Token![&&]) {
            input.parse::<Token![&&]>()?;
        } else {
            let message = "expected `and` and another condition, or the block `{ … }`";
            return Err(EVENT.error(input.span(), message));
        }
        comparisons.push(formula::comparison(input, &EVENT)?);
    }
    Ok(comparisons)
}

/// `v = -v;` or `conserves energy, momentum;`
fn statement(input: ParseStream<'_>, event: &mut EventItem) -> syn::Result<()> {
    if name::peek_is(input, "conserves") {
        name::word(input)?;
        loop {
            event.conserved.push(name::declared(input)?);
            if input.peek(Token![,]) {
                input.parse::<Token![,]>()?;
                continue;
            }
            if !input.peek(Token![;]) {
                let message = "expected `,` and another quantity, or `;`";
                return Err(SEMICOLON.error(input.span(), message));
            }
            name::skip_one(input);
            return Ok(());
        }
    }
    if name::peek_is(input, "der") {
        let message = "an event changes states, not how they go on: write `x = …;`, or a region or a `discrete` that `der` depends on";
        return Err(EVENT.error(input.span(), message));
    }
    let target = target(input)?;
    equals(input, &target.to_string())?;
    let formula = formula::formula(input)?;
    after_formula(input, &formula, false)?;
    event.assignments.push(Assignment { target, formula });
    Ok(())
}
