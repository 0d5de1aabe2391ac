//! The sign pattern of a region: `where contact > 0 and load < 0`.

use syn::parse::ParseStream;
use syn::{Token, token};

use num_traits::Zero;

use super::expression::{Expression, ExpressionKind};
use super::{Condition, Relation};
use super::{formula, name};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::syntax::{ALTERNATIVES, CONDITION, REGION};

/// The conditions up to the block, separated by `and`; a comma or `&&` does as well.
/// What is wrong is reported, and parsing goes on at the block.
pub(super) fn conditions(input: ParseStream<'_>, diagnostics: &mut Diagnostics) -> Vec<Condition> {
    let mut conditions = Vec::new();
    while !input.is_empty() && !input.peek(token::Brace) && !input.peek(Token![;]) {
        let before = input.cursor();
        match condition(input).and_then(|condition| {
            separator(input)?;
            Ok(condition)
        }) {
            Ok(condition) => conditions.push(condition),
            Err(error) => {
                name::report(diagnostics, error);
                skip_condition(input);
            }
        }
        if input.cursor() == before {
            name::skip_one(input);
        }
    }
    conditions
}

fn separator(input: ParseStream<'_>) -> syn::Result<()> {
    if input.peek(token::Brace) {
        return Ok(());
    }
    if name::peek_is(input, "and") || input.peek(Token![,]) {
        name::skip_one(input);
    } else if input.peek(Token![&&]) {
        input.parse::<Token![&&]>()?;
    } else if name::peek_is(input, "or") || input.peek(Token![||]) {
        return Err(ALTERNATIVES.error(
            input.span(),
            "a region is one sign pattern: write a region for each alternative",
        ));
    } else {
        return Err(REGION.error(
            input.span(),
            "expected `and` and another condition, or the region's `{ … }`",
        ));
    }
    Ok(())
}

fn skip_condition(input: ParseStream<'_>) {
    while !input.is_empty() && !input.peek(token::Brace) && !input.peek(Token![;]) {
        let is_end = name::peek_is(input, "and") || input.peek(Token![,]);
        name::skip_one(input);
        if is_end {
            return;
        }
    }
}

/// `interface > 0` or `interface < 0`
fn condition(input: ParseStream<'_>) -> syn::Result<Condition> {
    if input.peek(Token![!]) || name::peek_is(input, "not") {
        let message = "the other side of an interface is written `< 0` instead of `> 0`";
        return Err(CONDITION.error(input.span(), message));
    }
    let compares = name::group_has(input, &['>']) || name::group_has(input, &['<']);
    if input.peek(token::Paren) && compares {
        let message = "a condition stands without parentheses: write `where wall > 0`";
        return Err(CONDITION.error(input.span(), message));
    }
    let left = formula::formula(input)?;
    let relation = relation(input, &left)?;
    let right = formula::formula(input)?;
    if let (ExpressionKind::Number { value, .. }, Some(interface)) = (&left.kind, right.as_name())
        && value.is_zero()
    {
        let flipped = match relation {
            Relation::Less => Relation::Greater,
            Relation::Greater => Relation::Less,
        };
        let advice = format!(
            "the interface stands on the left: write `{interface} {} 0`",
            flipped.symbol()
        );
        return Err(CONDITION.error(left.extent.to(right.extent), advice));
    }
    let Some(interface) = left.as_name() else {
        let advice = format!(
            "a region is bounded by named interfaces: declare `interface name = {left};` and write `name {} 0`",
            relation.symbol()
        );
        return Err(CONDITION.error(left.extent, advice));
    };
    if !matches!(&right.kind, ExpressionKind::Number { value, .. } if value.is_zero()) {
        let level = match right.kind {
            ExpressionKind::Number { .. } | ExpressionKind::Name(_) => right.to_string(),
            _ => format!("({right})"),
        };
        let advice = format!(
            "an interface is compared with 0: declare its level in it, `interface {interface} = … - {level};`"
        );
        return Err(CONDITION.error(right.extent, advice));
    }
    Ok(Condition {
        interface: interface.clone(),
        relation,
    })
}

fn relation(input: ParseStream<'_>, left: &Expression) -> syn::Result<Relation> {
    let left = left.to_string();
    if input.peek(Token![>=]) || input.peek(Token![<=]) {
        let strict = if input.peek(Token![>=]) { ">" } else { "<" };
        return Err(CONDITION.error(
            input.span(),
            format!(
                "regions are open sets, their boundary belongs to neither: write `{left} {strict} 0`"
            ),
        ));
    }
    if input.peek(Token![==]) || input.peek(Token![=]) || input.peek(Token![!=]) {
        return Err(CONDITION.error(
            input.span(),
            format!(
                "a region lies on one side of an interface: write `{left} > 0` or `{left} < 0`"
            ),
        ));
    }
    if input.peek(Token![>]) && !input.peek(Token![>>]) {
        input.parse::<Token![>]>()?;
        return Ok(Relation::Greater);
    }
    if input.peek(Token![<]) && !input.peek(Token![<<]) && !input.peek(Token![<-]) {
        input.parse::<Token![<]>()?;
        return Ok(Relation::Less);
    }
    Err(CONDITION.error(
        input.span(),
        format!("expected `{left} > 0` or `{left} < 0`"),
    ))
}
