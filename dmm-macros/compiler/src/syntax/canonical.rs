//! Functions and Hamiltonians: `fn V(q) = …;`, `hamiltonian H = … in (q, p);`.

use syn::parse::ParseStream;
use syn::{Attribute, Token, parenthesized, token};

use super::definition::{after_formula, comma, defined, equals};
use super::target::target;
use super::{Definition, FunctionItem, HamiltonianItem, Target};
use super::{formula, mistake, name};
use crate::diagnostics::Extent;
use crate::diagnostics::catalogue::syntax::{FUNCTION, HAMILTONIAN, TYPE};

/// `V(q, k) = formula;`
pub(super) fn function(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
) -> syn::Result<FunctionItem> {
    let ident = name::declared(input)?;
    if !input.peek(token::Paren) {
        let message = format!("a function has arguments: write `fn {ident}(q) = …;`");
        return Err(FUNCTION.error(&ident, message));
    }
    let content;
    let parentheses = parenthesized!(content in input);
    if content.is_empty() {
        let place = Extent::from(&ident).to(parentheses.span.close());
        let message = format!("a formula without arguments is named by `let {ident} = …;`");
        return Err(FUNCTION.error(place, message));
    }
    let mut arguments = Vec::new();
    while !content.is_empty() {
        arguments.push(argument(&content)?);
        name::skip_one(&content);
    }
    let names: Vec<String> = arguments.iter().map(ToString::to_string).collect();
    let head = format!("fn {ident}({})", names.join(", "));
    if input.peek(Token![->]) {
        let message = format!("every quantity is real: write `{head} = …;` without a type");
        return Err(TYPE.error(input.span(), message));
    }
    if input.peek(token::Brace) {
        let message = format!("a function is one formula: write `{head} = …;`");
        return Err(FUNCTION.error(input.span(), message));
    }
    equals(input, &head)?;
    let formula = formula::formula(input)?;
    after_formula(input, &formula, false)?;
    Ok(FunctionItem {
        definition: Definition {
            attributes,
            ident,
            formula,
        },
        arguments,
    })
}

/// The name of an argument, up to its comma.
fn argument(content: ParseStream<'_>) -> syn::Result<proc_macro2::Ident> {
    let argument = name::declared(content)?;
    if content.peek(Token![:]) {
        let message = format!("every quantity is real: leave out the type of `{argument}`");
        return Err(TYPE.error(content.span(), message));
    }
    if content.peek(token::Bracket) {
        let message = format!(
            "an argument is one number or an index: name it `{argument}` alone; groups need not be passed"
        );
        return Err(FUNCTION.error(content.span(), message));
    }
    if !content.is_empty() && !content.peek(Token![,]) {
        let message = "the arguments of a function are names with commas between them";
        return Err(FUNCTION.error(content.span(), message));
    }
    Ok(argument)
}

/// `H = formula in (q, p), (x, y);`
pub(super) fn hamiltonian(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
) -> syn::Result<HamiltonianItem> {
    let ident = name::declared(input)?;
    if input.peek(token::Paren) {
        let message = format!(
            "the canonical pairs stand behind the formula: write `hamiltonian {ident} = … in (q, p);`"
        );
        return Err(HAMILTONIAN.error(Extent::from(&ident).to(input.span()), message));
    }
    let formula = defined(input, "hamiltonian", &ident)?;
    if input.peek(Token![,]) && input.peek2(Token![in]) {
        let message = "there is no `,` in front of `in`";
        return Err(HAMILTONIAN.error(input.span(), message));
    }
    if !input.peek(Token![in]) {
        if input.is_empty() || input.peek(Token![;]) || name::begins_item(input) {
            let message = format!(
                "which are the canonical pairs? write `hamiltonian {ident} = … in (q, p);`"
            );
            return Err(HAMILTONIAN.error(Extent::from(&ident).to(formula.extent), message));
        }
        return Err(mistake::unexpected(input, &formula));
    }
    input.parse::<Token![in]>()?;
    let mut pairs = Vec::new();
    loop {
        let (pair, place) = pair(input)?;
        pairs.push(pair);
        if !comma(input, place, "pair `(q, p)`")? {
            break;
        }
    }
    Ok(HamiltonianItem {
        definition: Definition {
            attributes,
            ident,
            formula,
        },
        pairs,
    })
}

/// `(q, p)`, and where it stands.
fn pair(input: ParseStream<'_>) -> syn::Result<((Target, Target), Extent)> {
    const FORM: &str = "a canonical pair is written `(q, p)`: the coordinate, then its momentum";
    if !input.peek(token::Paren) {
        return Err(HAMILTONIAN.error(input.span(), FORM));
    }
    let content;
    let parentheses = parenthesized!(content in input);
    let place = Extent::new(parentheses.span.open(), parentheses.span.close());
    if content.is_empty() {
        return Err(HAMILTONIAN.error(place, FORM));
    }
    let coordinate = target(&content)?;
    if !content.peek(Token![,]) {
        return Err(HAMILTONIAN.error(place, FORM));
    }
    content.parse::<Token![,]>()?;
    if content.is_empty() {
        return Err(HAMILTONIAN.error(place, FORM));
    }
    let momentum = target(&content)?;
    if content.peek(Token![,]) {
        content.parse::<Token![,]>()?;
    }
    if !content.is_empty() {
        return Err(HAMILTONIAN.error(place, FORM));
    }
    Ok(((coordinate, momentum), place))
}
