//! Formulas: precedence climbing over `+ - * / ^`, unary minus, calls and parentheses.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Lit, Token, parenthesized, token};

use super::mistake;
use super::name;
use super::number;
use crate::algebra::Rational;
use crate::diagnostics::Extent;

/// Parentheses, signs and exponents may be nested this deep.
const DEEPEST_NESTING: usize = 64;
/// The longest chain of operations; later stages walk formulas recursively.
const TALLEST: usize = 400;

/// A formula as written.
#[derive(Debug, Clone)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Where it stands.
    pub extent: Extent,
    /// The length of the longest path to a leaf.
    height: usize,
}

/// The kinds of formulas.
#[derive(Debug, Clone)]
pub enum ExpressionKind {
    /// An exact constant, with the literal that it was read from.
    Number {
        /// Its value.
        value: Rational,
        /// Its literal.
        text: String,
    },
    /// A name.
    Name(Ident),
    /// `function(arguments)`
    Call {
        /// The function's name.
        function: Ident,
        /// Its arguments.
        arguments: Vec<Expression>,
    },
    /// −operand
    Negative(Box<Expression>),
    /// left operator right
    Binary {
        /// The operation.
        operator: Operator,
        /// The operand on its left.
        left: Box<Expression>,
        /// The operand on its right.
        right: Box<Expression>,
    },
    /// A formula in parentheses.
    Parenthesised(Box<Expression>),
}

/// The operations on two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
}

impl Operator {
    /// The sign that it is written with.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
        }
    }
}

impl Expression {
    fn new(kind: ExpressionKind, extent: Extent) -> syn::Result<Self> {
        let below = match &kind {
            ExpressionKind::Number { .. } | ExpressionKind::Name(_) => 0,
            ExpressionKind::Call { arguments, .. } => {
                arguments.iter().map(|a| a.height).max().unwrap_or(0)
            }
            ExpressionKind::Negative(operand) | ExpressionKind::Parenthesised(operand) => {
                operand.height
            }
            ExpressionKind::Binary { left, right, .. } => left.height.max(right.height),
        };
        if below >= TALLEST {
            return Err(extent.error("this formula is too long; name parts of it with `let`"));
        }
        Ok(Self {
            kind,
            extent,
            height: below + 1,
        })
    }

    fn binary(operator: Operator, left: Self, right: Self) -> syn::Result<Self> {
        let extent = left.extent.to(right.extent);
        let kind = ExpressionKind::Binary {
            operator,
            left: Box::new(left),
            right: Box::new(right),
        };
        Self::new(kind, extent)
    }

    /// The formula without the parentheses around all of it.
    pub fn inside_parentheses(&self) -> &Self {
        match &self.kind {
            ExpressionKind::Parenthesised(inner) => inner.inside_parentheses(),
            _ => self,
        }
    }

    /// The name, if the formula is nothing else.
    pub fn as_name(&self) -> Option<&Ident> {
        match &self.kind {
            ExpressionKind::Name(ident) => Some(ident),
            _ => None,
        }
    }
}

/// A whole formula, as far as it reaches.
pub(super) fn formula(input: ParseStream<'_>) -> syn::Result<Expression> {
    sum(input, 0)
}

/// product (± product)*
fn sum(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
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

/// signed ((* | /) signed)*
fn product(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let mut left = signed(input, nesting)?;
    loop {
        let operator = if input.peek(Token![*]) && !input.peek(Token![*=]) {
            mistake::refuse_double_star(input)?;
            Operator::Multiply
        } else if input.peek(Token![/]) && !input.peek(Token![/=]) {
            Operator::Divide
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

fn deeper(input: ParseStream<'_>, nesting: usize) -> syn::Result<usize> {
    if nesting >= DEEPEST_NESTING {
        return Err(name::error_here(
            input,
            "this formula is nested too deeply; name parts of it with `let`",
        ));
    }
    Ok(nesting + 1)
}

/// A number, a name, a call, or a formula in parentheses.
fn operand(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let found = if input.peek(token::Paren) {
        parentheses(input, nesting)?
    } else if input.peek(Lit) {
        literal(input)?
    } else if let Some(ident) = name::peek_word(input) {
        name_or_call(input, &ident, nesting)?
    } else {
        return Err(mistake::no_operand(input));
    };
    mistake::refuse_method(input, &found)?;
    Ok(found)
}

fn parentheses(input: ParseStream<'_>, nesting: usize) -> syn::Result<Expression> {
    let content;
    let parentheses = parenthesized!(content in input);
    let inner = sum(&content, deeper(input, nesting)?)?;
    if !content.is_empty() {
        return Err(mistake::unexpected(&content, &inner));
    }
    let extent = Extent::new(parentheses.span.open(), parentheses.span.close());
    Expression::new(ExpressionKind::Parenthesised(Box::new(inner)), extent)
}

fn literal(input: ParseStream<'_>) -> syn::Result<Expression> {
    let literal: Lit = input.parse()?;
    let value =
        number::exact(&literal).map_err(|message| syn::Error::new(literal.span(), message))?;
    let text = number::literal_text(&literal);
    Expression::new(
        ExpressionKind::Number { value, text },
        literal.span().into(),
    )
}

fn name_or_call(input: ParseStream<'_>, ident: &Ident, nesting: usize) -> syn::Result<Expression> {
    let text = ident.to_string();
    if text == "if" || text == "match" {
        let advice =
            "formulas have no branches: declare an `interface` and a `region` on each side of it";
        return Err(syn::Error::new(ident.span(), advice));
    }
    if name::ITEMS.contains(&text.as_str()) && text != "der" {
        return Err(mistake::no_operand(input));
    }
    name::word(input)?;
    if input.peek(Token![::]) {
        let advice = "formulas have no paths; π is `pi`, and functions are called by their name, as in `sqrt(x)`";
        return Err(syn::Error::new(ident.span(), advice));
    }
    if !input.peek(token::Paren) {
        return Expression::new(ExpressionKind::Name(ident.clone()), ident.into());
    }
    let content;
    let parentheses = parenthesized!(content in input);
    let mut arguments = Vec::new();
    while !content.is_empty() {
        let argument = sum(&content, deeper(input, nesting)?)?;
        if !content.is_empty() && !content.peek(Token![,]) {
            return Err(mistake::unexpected(&content, &argument));
        }
        arguments.push(argument);
        name::skip_one(&content);
    }
    let extent = Extent::from(ident).to(parentheses.span.close());
    let function = ident.clone();
    Expression::new(
        ExpressionKind::Call {
            function,
            arguments,
        },
        extent,
    )
}
