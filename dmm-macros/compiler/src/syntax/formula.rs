//! Tokens → formula: precedence climbing over `+ - * / % ^`, unary minus, calls, elements, sums
//! and parentheses; and ranges, which sums and loops go through.

use proc_macro2::{Ident, Span};
use syn::parse::ParseStream;
use syn::{Lit, Token, braced, parenthesized, token};

use super::expression::{Expression, ExpressionKind, Operator};
use super::mistake::{self, SUM_FORM};
use super::{Comparison, Range, Relation, instead, name, number};
use crate::diagnostics::catalogue::syntax::{BRANCH, DEPTH, INDEX, PATH, RANGE, SUM};
use crate::diagnostics::{Code, Extent};

/// Parentheses, signs, exponents and indices may be nested this deep.
const DEEPEST_NESTING: usize = 64;

/// A whole formula, as far as it reaches.
pub(super) fn formula(input: ParseStream<'_>) -> syn::Result<Expression> {
    terms(input, 0)
}

/// product (± product)*
fn terms(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let mut left = product(input, nesting)?;
    loop {
        let operator = if input.peek(Token![+]) && !input.peek(Token![+=]) {
            Operator::Add
        } else if input.peek(Token![-]) && !input.peek(Token![-=]) && !input.peek(Token![->]) {
            Operator::Subtract
        } else {
            return Ok(left);
        };
        name::skip_one(input);
        let right = product(input, nesting)?;
        left = Expression::binary(operator, left, right)?;
    }
}

/// signed ((* | / | %) signed)*
fn product(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let mut left = signed(input, nesting)?;
    loop {
        let operator = if input.peek(Token![*]) && !input.peek(Token![*=]) {
            mistake::refuse_double_star(input)?;
            Operator::Multiply
        } else if input.peek(Token![/]) && !input.peek(Token![/=]) {
            Operator::Divide
        } else if input.peek(Token![%]) && !input.peek(Token![%=]) {
            Operator::Remainder
        } else {
            return Ok(left);
        };
        name::skip_one(input);
        let right = signed(input, nesting)?;
        left = Expression::binary(operator, left, right)?;
    }
}

/// −signed, or a power
fn signed(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    if input.peek(Token![-]) {
        return negative(input, nesting, signed);
    }
    power(input, nesting)
}

/// −exponent, or a power
fn exponent(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    if input.peek(Token![-]) {
        return negative(input, nesting, exponent);
    }
    power(input, nesting)
}

fn negative(
    input: ParseStream<'_>,
    nesting: usize,
    operand: fn(ParseStream<'_>, usize) -> syn::Result<Expression>,
) -> syn::Result<Expression> {
    let minus: Token![-] = input.parse()?;
    let operand = operand(input, deeper(input, nesting)?)?;
    let extent = Extent::from(minus.span).to(operand.extent);
    Expression::new(ExpressionKind::Negative(Box::new(operand)), extent)
}

/// operand [^ exponent]
fn power(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let base = operand(input, nesting)?;
    if !input.peek(Token![^]) || input.peek(Token![^=]) {
        return Ok(base);
    }
    name::skip_one(input);
    let exponent = exponent(input, deeper(input, nesting)?)?;
    Expression::binary(Operator::Power, base, exponent)
}

/// The next depth of nesting, if there may be one.
fn deeper(input: ParseStream<'_>, nesting: usize) -> syn::Result<usize> {
    if nesting >= DEEPEST_NESTING {
        return Err(DEPTH.error(
            input.span(),
            "this formula is nested too deeply; name parts of it with `let`",
        ));
    }
    Ok(nesting + 1)
}

/// A number, a name, an element, a call, a sum, or a formula in parentheses.
fn operand(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let found = if input.peek(token::Paren) {
        parentheses(input, nesting)?
    } else if input.peek(Lit) {
        literal(input)?
    } else if let Some(ident) = name::peek_word(input) {
        word(input, &ident, nesting)?
    } else {
        return Err(mistake::no_operand(input));
    };
    mistake::refuse_method(input, &found)?;
    mistake::refuse_index(input, &found)?;
    Ok(found)
}

fn parentheses(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let content;
    let parentheses = parenthesized!(content in input);
    let inner = terms(&content, deeper(input, nesting)?)?;
    if !content.is_empty() {
        return Err(mistake::unexpected(&content, &inner));
    }
    let extent = Extent::new(parentheses.span.open(), parentheses.span.close());
    Expression::new(ExpressionKind::Parenthesised(Box::new(inner)), extent)
}

fn literal(input: ParseStream<'_>) -> syn::Result<Expression> {
    let literal: Lit = input.parse()?;
    let value =
        number::exact(&literal).map_err(|(code, message)| code.error(literal.span(), message))?;
    let text = number::literal_text(&literal);
    Expression::new(
        ExpressionKind::Number { value, text },
        literal.span().into(),
    )
}

/// What begins with the word `ident`.
fn word(input: ParseStream<'_>, ident: &Ident, nesting: usize) -> syn::Result<Expression> {
    let text = ident.to_string();
    if text == "if" {
        return branch(input, ident, nesting);
    }
    if text == "match" || text == "where" && input.peek2(token::Paren) {
        return Err(BRANCH.error(ident, instead::NO_BRANCH));
    }
    if text != "der" && name::begins_item(input) {
        return Err(mistake::no_operand(input));
    }
    name::word(input)?;
    if input.peek(Token![::]) {
        let advice = "formulas have no paths; π is `pi`, and functions are called by their name, as in `sqrt(x)`";
        return Err(PATH.error(ident, advice));
    }
    if text == "sum" && input.peek(token::Paren) {
        return sum(input, ident, nesting);
    }
    if text != "der"
        && let Some(refusal) = name::refusal_of_word(ident)
    {
        return Err(refusal);
    }
    if input.peek(token::Bracket) {
        mistake::refuse_function_index(ident)?;
        let (index, close) = index(input, ident, nesting)?;
        let kind = ExpressionKind::Element {
            group: ident.clone(),
            index: Box::new(index),
        };
        return Expression::new(kind, Extent::from(ident).to(close));
    }
    if input.peek(token::Paren) {
        return call(input, ident, nesting);
    }
    Expression::new(ExpressionKind::Name(ident.clone()), ident.into())
}

/// `left < right`; what is wrong has the code of what it belongs to.
pub(super) fn comparison(input: ParseStream<'_>, code: &Code) -> syn::Result<Comparison> {
    let left = formula(input)?;
    let relation = if input.peek(Token![>=]) || input.peek(Token![<=]) {
        let message =
            "write `>` or `<`: what holds at the boundary alone holds at no time that is found";
        return Err(code.error(input.span(), message));
    } else if input.peek(Token![>]) {
        Relation::Greater
    } else if input.peek(Token![<]) {
        Relation::Less
    } else {
        return Err(code.error(input.span(), "expected `>` or `<`, as in `v > 0`"));
    };
    name::skip_one(input);
    let right = formula(input)?;
    Ok(Comparison {
        left,
        relation,
        right,
    })
}

/// `if a > b { then } else { otherwise }`
fn branch(input: ParseStream<'_>, ident: &Ident, nesting: usize) -> syn::Result<Expression> {
    const FORM: &str = "a formula switches as in `if v > 0 { 1 } else { -1 }`";
    let nesting = deeper(input, nesting)?;
    name::word(input)?;
    let condition = comparison(input, &BRANCH)?;
    if name::peek_is(input, "and") || input.peek(Token![&&]) || input.peek(Token![||]) {
        let message = "one comparison decides: put a branch into another one";
        return Err(BRANCH.error(input.span(), message));
    }
    let slides = name::peek_is(input, "sliding");
    if slides {
        name::skip_one(input);
    }
    let block = |input: ParseStream<'_>| -> syn::Result<(Expression, Span)> {
        if !input.peek(token::Brace) {
            return Err(BRANCH.error(input.span(), FORM));
        }
        let content;
        let braces = braced!(content in input);
        let value = terms(&content, nesting)?;
        if !content.is_empty() {
            return Err(mistake::unexpected(&content, &value));
        }
        Ok((value, braces.span.close()))
    };
    let (then, end) = block(input)?;
    if !name::peek_is(input, "else") {
        let message = format!("{FORM}: it has a value on both sides");
        return Err(BRANCH.error(Extent::from(ident).to(end), message));
    }
    name::word(input)?;
    let (otherwise, end) = match name::peek_word(input) {
        Some(next) if next == "if" => {
            let other = branch(input, &next, nesting)?;
            let end = other.extent;
            (other, end)
        }
        _ => {
            let (value, end) = block(input)?;
            (value, end.into())
        }
    };
    let kind = ExpressionKind::If {
        condition: Box::new(condition),
        slides,
        then: Box::new(then),
        otherwise: Box::new(otherwise),
    };
    Expression::new(kind, Extent::from(ident).to(end))
}

fn call(input: ParseStream<'_>, function: &Ident, nesting: usize) -> syn::Result<Expression> {
    let content;
    let parentheses = parenthesized!(content in input);
    let whole = Extent::from(function).to(parentheses.span.close());
    if counts(&content) {
        return Err(mistake::no_sum(function, whole));
    }
    let mut arguments = Vec::new();
    while !content.is_empty() {
        let argument = terms(&content, deeper(input, nesting)?)?;
        if !content.is_empty() && !content.peek(Token![,]) {
            return Err(mistake::unexpected_in_list(&content, &argument));
        }
        arguments.push(argument);
        name::skip_one(&content);
    }
    let kind = ExpressionKind::Call {
        function: function.clone(),
        arguments,
    };
    Expression::new(kind, whole)
}

/// `[formula]` behind the name of a group, with the place of its `]`.
pub(super) fn index(
    input: ParseStream<'_>,
    group: &Ident,
    nesting: usize,
) -> syn::Result<(Expression, Extent)> {
    let content;
    let brackets = syn::bracketed!(content in input);
    let whole = Extent::new(brackets.span.open(), brackets.span.close());
    if content.is_empty() {
        let message = format!("which element of `{group}`? write `{group}[0]`");
        return Err(INDEX.error(whole, message));
    }
    if content.peek(Token![..]) {
        return Err(mistake::slice(whole, group));
    }
    let index = terms(&content, deeper(input, nesting)?)?;
    if content.peek(Token![..]) {
        return Err(mistake::slice(whole, group));
    }
    if content.peek(Token![,]) {
        let message = "a group has one index: declare a group for each row";
        return Err(INDEX.error(whole, message));
    }
    if !content.is_empty() {
        return Err(mistake::unexpected(&content, &index));
    }
    if input.peek(token::Bracket) {
        let message = "a group has one index: declare a group for each row";
        return Err(INDEX.error(input.span(), message));
    }
    Ok((index, brackets.span.close().into()))
}

/// Whether the parentheses with `content` begin with `i in`.
fn counts(content: ParseStream<'_>) -> bool {
    name::peek_word(content).is_some() && content.peek2(Token![in])
}

/// The rest of `sum(i in start..end, term)`.
fn sum(input: ParseStream<'_>, word: &Ident, nesting: usize) -> syn::Result<Expression> {
    let nesting = deeper(input, nesting)?;
    let content;
    let parentheses = parenthesized!(content in input);
    let whole = Extent::from(word).to(parentheses.span.close());
    if !counts(&content) {
        return Err(SUM.error(whole, SUM_FORM));
    }
    let variable = name::declared(&content)?;
    content.parse::<Token![in]>()?;
    let range = range(&content, nesting)?;
    if content.is_empty() {
        let message = format!("the term of the sum is missing: {SUM_FORM}");
        return Err(SUM.error(whole, message));
    }
    if !content.peek(Token![,]) {
        return Err(mistake::unexpected(&content, &range.end));
    }
    content.parse::<Token![,]>()?;
    let term = terms(&content, nesting)?;
    if content.peek(Token![,]) {
        content.parse::<Token![,]>()?;
        if !content.is_empty() {
            let message = format!("{SUM_FORM}, with one term; put sums into each other");
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

/// `start..end`
pub(super) fn range(input: ParseStream<'_>, nesting: usize) -> syn::Result<Range> {
    if input.peek(Token![..]) {
        return Err(RANGE.error(input.span(), "a range has a start: write `0..n`"));
    }
    if input.peek(token::Paren) && name::group_has(input, &['.', '.']) {
        let message = "a range stands without parentheses: write `0..n`";
        return Err(RANGE.error(input.span(), message));
    }
    let start = terms(input, nesting)?;
    if input.peek(Token![..=]) {
        input.parse::<Token![..=]>()?;
        let end = terms(input, nesting)?;
        return Err(mistake::inclusive(&start, &end));
    }
    if input.peek(Token![...]) || !input.peek(Token![..]) {
        return Err(mistake::no_range(input, &start));
    }
    let dots: Token![..] = input.parse()?;
    if input.is_empty() || input.peek(Token![,]) || input.peek(token::Brace) {
        let place = start.extent.to(dots.spans[1]);
        return Err(RANGE.error(place, format!("a range has an end: write `{start}..n`")));
    }
    let end = terms(input, nesting)?;
    if input.peek(Token![..]) {
        let message = "a range counts by one: use a formula of the index, such as `q[2*i]`";
        return Err(RANGE.error(input.span(), message));
    }
    Ok(Range { start, end })
}
