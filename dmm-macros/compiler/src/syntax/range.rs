//! What counts through a range: the range itself, sums, and loops.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Attribute, Token, braced, parenthesized, token};

use num_traits::One;

use super::expression::{Expression, ExpressionKind, Operator};
use super::item::{self, Place};
use super::{ForItem, Range};
use super::{formula, mistake, name};
use crate::algebra::Rational;
use crate::diagnostics::catalogue::syntax::{ATTRIBUTE, DEPTH, LOOP, RANGE, SUM};
use crate::diagnostics::{Diagnostics, Extent, closest};

/// Loops may be nested this deep.
const DEEPEST_LOOP: usize = 8;

/// `start..end`
pub(super) fn range(input: ParseStream<'_>, nesting: usize) -> syn::Result<Range> {
    if input.peek(Token![..]) {
        return Err(RANGE.error(input.span(), "a range has a start: write `0..n`"));
    }
    if input.peek(token::Paren) && name::group_has(input, &['.', '.']) {
        let message = "a range stands without parentheses: write `0..n`";
        return Err(RANGE.error(input.span(), message));
    }
    let start = formula::terms(input, nesting)?;
    if input.peek(Token![..=]) {
        input.parse::<Token![..=]>()?;
        let end = formula::terms(input, nesting)?;
        let message = format!("a range excludes its end: write `{start}..{}`", next(&end));
        return Err(RANGE.error(start.extent.to(end.extent), message));
    }
    if input.peek(Token![...]) || !input.peek(Token![..]) {
        return Err(RANGE.error(start.extent, no_range(input, &start)));
    }
    let dots: Token![..] = input.parse()?;
    if input.is_empty() || input.peek(Token![,]) || input.peek(token::Brace) {
        let place = start.extent.to(dots.spans[1]);
        return Err(RANGE.error(place, format!("a range has an end: write `{start}..n`")));
    }
    let end = formula::terms(input, nesting)?;
    if input.peek(Token![..]) {
        let message = "a range counts by one: use a formula of the index, such as `q[2*i]`";
        return Err(RANGE.error(input.span(), message));
    }
    Ok(Range { start, end })
}

/// `end + 1` as one would write it.
fn next(end: &Expression) -> String {
    match &end.kind {
        ExpressionKind::Number { value, .. } => (value + Rational::one()).to_string(),
        ExpressionKind::Binary {
            operator: Operator::Subtract,
            left,
            right,
        } if matches!(&right.kind, ExpressionKind::Number { value, .. } if value.is_one()) => {
            left.to_string()
        }
        _ => format!("{end} + 1"),
    }
}

fn no_range(input: ParseStream<'_>, start: &Expression) -> String {
    if input.peek(Token![...]) || input.peek(Token![:]) {
        return format!("a range is written with two dots, as in `{start}..n`");
    }
    format!("a range has a start and an end: write `0..{start}`, which excludes {start}")
}

/// How a sum is written.
const FORM: &str = "a sum is written `sum(i in 0..n, term)`";

/// Whether the parentheses with `content` begin with `i in`.
pub(super) fn counts(content: ParseStream<'_>) -> bool {
    name::peek_word(content).is_some() && content.peek2(Token![in])
}

/// What is said about a range in the call of something else than `sum`.
pub(super) fn no_sum(function: &Ident, whole: Extent) -> syn::Error {
    match closest(&function.to_string(), ["sum"]) {
        Some(meant) => SUM.error(
            function,
            format!("there is no `{function}` over a range; did you mean `{meant}`?"),
        ),
        None => SUM.error(
            whole,
            format!("only a sum goes through a range, not `{function}`: {FORM}"),
        ),
    }
}

/// The rest of `sum(i in start..end, term)`.
pub(super) fn sum(input: ParseStream<'_>, word: &Ident, nesting: usize) -> syn::Result<Expression> {
    let nesting = formula::deeper(input, nesting)?;
    let content;
    let parentheses = parenthesized!(content in input);
    let whole = Extent::from(word).to(parentheses.span.close());
    if !counts(&content) {
        return Err(SUM.error(whole, FORM));
    }
    let variable = name::declared(&content)?;
    content.parse::<Token![in]>()?;
    let range = range(&content, nesting)?;
    if content.is_empty() {
        let message = format!("the term of the sum is missing: {FORM}");
        return Err(SUM.error(whole, message));
    }
    if !content.peek(Token![,]) {
        return Err(mistake::unexpected(&content, &range.end));
    }
    content.parse::<Token![,]>()?;
    let term = formula::terms(&content, nesting)?;
    if content.peek(Token![,]) {
        content.parse::<Token![,]>()?;
        if !content.is_empty() {
            let message = format!("{FORM}, with one term; put sums into each other");
            return Err(SUM.error(content.span(), message));
        }
    }
    if !content.is_empty() {
        return Err(mistake::unexpected(&content, &term));
    }
    let kind = ExpressionKind::Sum {
        variable,
        range: Box::new(range),
        term: Box::new(term),
    };
    Expression::new(kind, whole)
}

/// The rest of `for i in start..end { … }`, in a block at `place`.
pub(super) fn repeat(
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
    let range = range(input, 0)?;
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
    let items = item::items(&body, Place::Loop(depth), diagnostics);
    Ok(ForItem {
        variable,
        range,
        items,
    })
}
