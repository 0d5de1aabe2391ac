//! The mistakes that newcomers make in formulas, each with what to write instead.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Lit, Token, token};

use super::name;
use super::{Expression, ExpressionKind};
use crate::algebra::Function;
use crate::diagnostics::Extent;

/// `x**2`
pub(super) fn refuse_double_star(input: ParseStream<'_>) -> syn::Result<()> {
    if !input.peek2(Token![*]) {
        return Ok(());
    }
    let first: Token![*] = input.parse()?;
    let second: Token![*] = input.parse()?;
    Err(Extent::new(first.span, second.span).error("power is written `^`, as in `x^2`"))
}

/// `x.powi(2)`, `x.sqrt()`, `self.k`
pub(super) fn refuse_method(input: ParseStream<'_>, receiver: &Expression) -> syn::Result<()> {
    if !input.peek(Token![.]) {
        return Ok(());
    }
    let dot: Token![.] = input.parse()?;
    let Some(method) = name::peek_word(input) else {
        return Err(syn::Error::new(dot.span, "unexpected `.` in a formula"));
    };
    let place = receiver.extent.to(&method);
    let base = receiver.to_string();
    let receiver = receiver.inside_parentheses().to_string();
    Err(place.error(match method.to_string().as_str() {
        "powi" | "powf" | "pow" => format!("power is written `^`, as in `{base}^2`"),
        "recip" => format!("write `1/{base}`"),
        other if other.parse::<Function>().is_ok_and(Function::is_declarable) => {
            format!("functions are not methods here: write `{other}({receiver})`")
        }
        "abs" | "signum" | "min" | "max" => format!(
            "`{method}` is not smooth: declare an `interface` where it switches and a `region` on each side"
        ),
        _ if receiver == "self" => format!("parameters are called by their name: write `{method}`"),
        _ => "formulas have neither methods nor fields".to_string(),
    }))
}

/// The error where an operand should stand.
pub(super) fn no_operand(input: ParseStream<'_>) -> syn::Error {
    let message = if input.is_empty() || input.peek(Token![;]) {
        "the formula ends where a number, a name or a function is expected"
    } else if input.peek(Token![+]) {
        "there is no unary plus: leave it out"
    } else {
        "expected a number, a name or a function"
    };
    name::error_here(input, message)
}

/// The error on a token that cannot go on the formula `before`.
pub(super) fn unexpected(input: ParseStream<'_>, before: &Expression) -> syn::Error {
    let operand_follows =
        input.peek(Lit) || input.peek(token::Paren) || name::peek_word(input).is_some();
    if !operand_follows {
        return name::error_here(input, unexpected_sign(input));
    }
    if let Some(function) = last_name(before)
        && function.to_string().parse::<Function>().is_ok()
    {
        let advice =
            format!("the argument of `{function}` stands in parentheses, as in `{function}(x)`");
        return syn::Error::new(function.span(), advice);
    }
    name::error_here(input, "missing operator: a product is written `a*b`")
}

fn last_name(expression: &Expression) -> Option<&Ident> {
    match &expression.kind {
        ExpressionKind::Name(ident) => Some(ident),
        ExpressionKind::Negative(operand) => last_name(operand),
        ExpressionKind::Binary { right, .. } => last_name(right),
        _ => None,
    }
}

fn unexpected_sign(input: ParseStream<'_>) -> &'static str {
    if input.peek(Token![==]) || input.peek(Token![=]) {
        "a formula ends before `=`; is a `;` missing in front of this item?"
    } else if input.peek(Token![<])
        || input.peek(Token![>])
        || input.peek(Token![<=])
        || input.peek(Token![>=])
    {
        "formulas have no comparisons: declare an `interface` and a `region` on each side of it"
    } else if input.peek(Token![%]) {
        "formulas have no remainder `%`"
    } else {
        "unexpected token in a formula"
    }
}
