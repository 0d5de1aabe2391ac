//! What an item defines, behind its keyword: names, `=` and formulas, up to the `;`.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Attribute, Token, parenthesized, token};

use super::expression::{self, Expression};
use super::{Definition, Derivative, Documented};
use super::{documentation, mistake, name};
use crate::diagnostics::{Diagnostics, Extent};

/// `x, y;`
pub(super) fn states(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Vec<Documented>> {
    let mut states = Vec::new();
    loop {
        let attributes = joined(&attributes, documentation(input, diagnostics)?);
        let ident = name::declared(input)?;
        if input.peek(Token![=]) {
            return Err(name::error_here(
                input,
                format!(
                    "a state has no value here: the initial state is given to the integrator; write `state {ident};`"
                ),
            ));
        }
        no_type(input, &ident)?;
        let place = Extent::from(&ident);
        states.push(Documented { attributes, ident });
        if !comma(input, place, "state")? {
            return Ok(states);
        }
    }
}

/// `name = formula, name = formula;`
pub(super) fn definitions(
    input: ParseStream<'_>,
    keyword: &str,
    attributes: Vec<Attribute>,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Vec<Definition>> {
    let mut definitions = Vec::new();
    loop {
        let attributes = joined(&attributes, documentation(input, diagnostics)?);
        let ident = name::declared(input)?;
        if keyword == "param" && (input.peek(Token![;]) || input.peek(Token![,])) {
            let message = format!("a parameter has a default: write `param {ident} = 1.0;`");
            return Err(syn::Error::new(ident.span(), message));
        }
        let formula = defined(input, keyword, &ident)?;
        let place = formula.extent;
        let more = after_formula(input, &formula, true)?;
        definitions.push(Definition {
            attributes,
            ident,
            formula,
        });
        if !more || !comma(input, place, keyword)? {
            return Ok(definitions);
        }
    }
}

/// `name = g;`
pub(super) fn interface(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
) -> syn::Result<Definition> {
    let ident = name::declared(input)?;
    let formula = defined(input, "interface", &ident)?;
    if input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
        if name::peek_is(input, "sliding") {
            return Err(name::error_here(
                input,
                "sliding is not supported yet: a trajectory crosses an interface or stops with an error",
            ));
        }
        return Err(name::error_here(
            input,
            "expected `;`: each interface has an `interface` item of its own",
        ));
    }
    after_formula(input, &formula, false)?;
    Ok(Definition {
        attributes,
        ident,
        formula,
    })
}

/// `name = ψ;`
pub(super) fn conserved(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
) -> syn::Result<Definition> {
    let ident = name::declared(input)?;
    let formula = defined(input, "conserved", &ident)?;
    after_formula(input, &formula, false)?;
    Ok(Definition {
        attributes,
        ident,
        formula,
    })
}

/// `(x) = f;`
pub(super) fn derivative(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
) -> syn::Result<Derivative> {
    if !input.peek(token::Paren) {
        return Err(match name::peek_word(input) {
            Some(state) => syn::Error::new(
                state.span(),
                format!("write `der({state}) = …;` with parentheses"),
            ),
            None => name::error_here(input, "expected `der(x) = …;`"),
        });
    }
    let content;
    parenthesized!(content in input);
    let state = name::declared(&content)?;
    if !content.is_empty() {
        return Err(name::error_here(
            &content,
            "`der` takes the name of one state, as in `der(x) = …;`",
        ));
    }
    equals(input, &format!("der({state})"))?;
    let formula = expression::formula(input)?;
    after_formula(input, &formula, false)?;
    Ok(Derivative {
        attributes,
        state,
        formula,
    })
}

/// `= formula`
fn defined(input: ParseStream<'_>, keyword: &str, ident: &Ident) -> syn::Result<Expression> {
    no_type(input, ident)?;
    equals(input, &format!("{keyword} {ident}"))?;
    expression::formula(input)
}

fn no_type(input: ParseStream<'_>, ident: &Ident) -> syn::Result<()> {
    if input.peek(Token![:]) {
        let message = format!("every quantity is real: leave out the type of `{ident}`");
        return Err(name::error_here(input, message));
    }
    Ok(())
}

fn equals(input: ParseStream<'_>, what: &str) -> syn::Result<()> {
    if input.peek(Token![==]) {
        let sign: Token![==] = input.parse()?;
        let [first, second] = sign.spans;
        return Err(Extent::new(first, second).error(format!("write `{what} = …` with one `=`")));
    }
    if !input.peek(Token![=]) {
        return Err(name::error_here(
            input,
            format!("expected `=`, as in `{what} = …;`"),
        ));
    }
    input.parse::<Token![=]>()?;
    Ok(())
}

/// Takes the comma of a list; false at its `;`, which is taken as well.
fn comma(input: ParseStream<'_>, before: Extent, keyword: &str) -> syn::Result<bool> {
    if input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
        if input.peek(Token![;]) {
            input.parse::<Token![;]>()?;
            return Ok(false);
        }
        return Ok(true);
    }
    if input.peek(Token![;]) {
        input.parse::<Token![;]>()?;
        return Ok(false);
    }
    Err(if input.is_empty() || name::at_item(input) {
        before.error("a `;` is missing behind this")
    } else {
        name::error_here(input, format!("expected `,` and another {keyword}, or `;`"))
    })
}

/// What follows a formula: true if it is the comma of a list, which is left, false if the `;`
/// of the item, which is left where a list is allowed.
fn after_formula(input: ParseStream<'_>, formula: &Expression, is_list: bool) -> syn::Result<bool> {
    if is_list && (input.peek(Token![,]) || input.peek(Token![;])) {
        return Ok(true);
    }
    if input.peek(Token![;]) {
        input.parse::<Token![;]>()?;
        return Ok(false);
    }
    let only_word_follows = name::at_item(input) && !input.peek(token::Paren);
    if input.is_empty() || only_word_follows {
        return Err(formula.extent.error("a `;` is missing behind this formula"));
    }
    if input.peek(Token![,]) {
        return Err(name::error_here(
            input,
            "expected `;`: this item takes one definition",
        ));
    }
    Err(mistake::unexpected(input, formula))
}

/// The documentation of a statement belongs to every name of its list.
fn joined(of_statement: &[Attribute], of_name: Vec<Attribute>) -> Vec<Attribute> {
    of_statement.iter().cloned().chain(of_name).collect()
}
