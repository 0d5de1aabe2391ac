//! What an item defines, behind its keyword: names, `=` and formulas, up to the `;`.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Attribute, Token, parenthesized, token};

use super::{Definition, Derivative, Expression, InterfaceItem, Target};
use super::{documentation, formula, mistake, name, target};
use crate::diagnostics::catalogue::syntax::{
    ASSUME, DERIVATIVE, EQUALS, FUNCTION, GROUP, NAME, ONE_DEFINITION, SEMICOLON, TYPE, UNEXPECTED,
};
use crate::diagnostics::{Diagnostics, Extent};

/// `name = formula, name = formula;`
pub(super) fn definitions(
    input: ParseStream<'_>,
    keyword: &str,
    attributes: &[Attribute],
    diagnostics: &mut Diagnostics,
) -> Vec<Definition> {
    let mut definitions: Vec<Definition> = Vec::new();
    list(input, keyword, diagnostics, |diagnostics| {
        let attributes = joined(attributes, documentation(input, diagnostics)?);
        mistake::refuse_decimal_comma(input, definitions.last().map(|last| &last.formula))?;
        let ident = name::declared(input)?;
        let formula = defined(input, keyword, &ident)?;
        after_formula(input, &formula, true)?;
        let place = formula.extent;
        definitions.push(Definition {
            attributes,
            ident,
            formula,
        });
        Ok(place)
    });
    definitions
}

/// The elements of a list up to its `;`. An error loses what is left of its element.
pub(super) fn list(
    input: ParseStream<'_>,
    what: &str,
    diagnostics: &mut Diagnostics,
    mut element: impl FnMut(&mut Diagnostics) -> syn::Result<Extent>,
) {
    loop {
        let more = element(diagnostics).and_then(|place| comma(input, place, what));
        match more {
            Ok(true) => {}
            Ok(false) => return,
            Err(error) => {
                name::report(diagnostics, error);
                if !name::recover_in_list(input) {
                    return;
                }
            }
        }
    }
}

/// `name = g;`, `name = g, sliding;`
pub(super) fn interface(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
) -> syn::Result<InterfaceItem> {
    let ident = name::declared(input)?;
    let formula = defined(input, "interface", &ident)?;
    let slides = input.peek(Token![,]);
    if slides {
        input.parse::<Token![,]>()?;
        if !name::peek_is(input, "sliding") {
            let message = "expected `sliding;` or, in place of the comma, `;`: each interface has an `interface` item of its own";
            return Err(ONE_DEFINITION.error(input.span(), message));
        }
        name::skip_one(input);
    }
    if mistake::at_comparison(input) {
        let message = format!(
            "an interface is where its formula is zero: end it here, `interface {ident} = {formula};`, and write `where {ident} > 0` in a region"
        );
        return Err(UNEXPECTED.error(input.span(), message));
    }
    after_formula(input, &formula, false)?;
    let definition = Definition {
        attributes,
        ident,
        formula,
    };
    Ok(InterfaceItem { definition, slides })
}

/// `name = ψ;`
pub(super) fn conserved(
    input: ParseStream<'_>,
    attributes: Vec<Attribute>,
) -> syn::Result<Definition> {
    if name::peek_is(input, "assume") {
        let message = "write `assume conserved name = …;`";
        name::skip_one(input);
        return Err(ASSUME.error(input.span(), message));
    }
    if name::peek_word(input).is_none() {
        let message = "a conserved quantity has a name: write `conserved name = …;`";
        return Err(NAME.error(input.span(), message));
    }
    let ident = name::declared(input)?;
    let formula = defined(input, "conserved", &ident)?;
    if input.peek(Token![=]) && !input.peek(Token![==]) {
        let message = "the value of a conserved quantity follows from the initial state: leave out what begins with this `=`";
        return Err(UNEXPECTED.error(input.span(), message));
    }
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
            Some(state) => {
                let message = format!("write `der({state}) = …;` with parentheses");
                DERIVATIVE.error(&state, message)
            }
            None => DERIVATIVE.error(input.span(), "expected `der(x) = …;`"),
        });
    }
    let target = derivative_of(input)?;
    if mistake::at_operator(input) {
        let message = format!(
            "a rate stands alone on the left: solve the equation for it and write `der({target}) = …;`"
        );
        return Err(DERIVATIVE.error(input.span(), message));
    }
    equals(input, &format!("der({target})"))?;
    let formula = formula::formula(input)?;
    after_formula(input, &formula, false)?;
    Ok(Derivative {
        attributes,
        target,
        formula,
    })
}

/// `(x)` behind `der`
fn derivative_of(input: ParseStream<'_>) -> syn::Result<Target> {
    let content;
    let parentheses = parenthesized!(content in input);
    if name::peek_is(&content, "der") && content.peek2(token::Paren) {
        name::skip_one(&content);
        let inner;
        parenthesized!(inner in content);
        let state = name::peek_word(&inner).map_or("x".to_owned(), |state| state.to_string());
        let message = format!(
            "a system is of first order: declare the velocity as a state, as in `der({state}) = v; der(v) = …;`"
        );
        name::skip_all(&inner);
        name::skip_all(&content);
        let place = Extent::new(parentheses.span.open(), parentheses.span.close());
        return Err(DERIVATIVE.error(place, message));
    }
    let is_state = name::peek_word(&content).is_some();
    let target = is_state.then(|| target::target(&content)).transpose()?;
    let Some(target) = target.filter(|_| content.is_empty()) else {
        let message = "`der` takes the name of one state, as in `der(x) = …;`";
        return Err(DERIVATIVE.error(content.span(), message));
    };
    Ok(target)
}

/// `= formula`
pub(super) fn defined(
    input: ParseStream<'_>,
    keyword: &str,
    ident: &Ident,
) -> syn::Result<Expression> {
    if input.peek(token::Bracket) {
        let message = format!("only states and parameters are groups: `{ident}` has one value");
        return Err(GROUP.error(input.span(), message));
    }
    if input.peek(token::Paren) {
        let message = if keyword == "let" || keyword == "const" {
            format!("a function of arguments is written `fn {ident}(…) = …;`")
        } else {
            format!("what it depends on is seen from its formula: write `{keyword} {ident} = …;`")
        };
        return Err(FUNCTION.error(ident, message));
    }
    if mistake::at_operator(input) {
        let message =
            format!("its name stands in front of the formula: write `{keyword} name = …;`");
        return Err(NAME.error(ident, message));
    }
    no_type(input, keyword, ident)?;
    equals(input, &format!("{keyword} {ident}"))?;
    formula::formula(input)
}

/// Refuses `: f64` behind the name that an item of `keyword` defines, and `: formula`.
pub(super) fn no_type(input: ParseStream<'_>, keyword: &str, ident: &Ident) -> syn::Result<()> {
    if !input.peek(Token![:]) || input.peek2(Token![=]) {
        return Ok(());
    }
    let rest = input.fork();
    name::skip_one(&rest);
    if keyword != "state" && !rest.peek(token::Bracket) && !name::is_type(&rest) {
        let message = format!("write `{keyword} {ident} = …;` with `=`");
        return Err(EQUALS.error(input.span(), message));
    }
    let message = if input.peek2(token::Bracket) {
        format!("every quantity is real: a group has its length behind the name, `{ident}[3]`")
    } else {
        format!("every quantity is real: leave out the type of `{ident}`")
    };
    Err(TYPE.error(input.span(), message))
}

/// `=`, behind `what`.
pub(super) fn equals(input: ParseStream<'_>, what: &str) -> syn::Result<()> {
    if input.peek(Token![==]) {
        let sign: Token![==] = input.parse()?;
        let place = Extent::new(sign.spans[0], sign.spans[1]);
        return Err(EQUALS.error(place, format!("write `{what} = …` with one `=`")));
    }
    if input.peek(Token![=]) {
        input.parse::<Token![=]>()?;
        return Ok(());
    }
    let message = if mistake::at_assignment(input) {
        format!("nothing is added up: write the whole formula, `{what} = …;`")
    } else {
        format!("expected `=`, as in `{what} = …;`")
    };
    Err(EQUALS.error(input.span(), message))
}

/// Takes the comma of a list; false at its `;`, which is taken as well.
pub(super) fn comma(input: ParseStream<'_>, before: Extent, what: &str) -> syn::Result<bool> {
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
        SEMICOLON.error(before, "a `;` is missing behind this")
    } else if input.peek(Token![in]) {
        TYPE.error(
            input.span(),
            "every quantity is real: leave out what begins with this `in`",
        )
    } else {
        let message = format!("expected `,` and another {what}, or `;`");
        SEMICOLON.error(input.span(), message)
    })
}

/// What follows a formula: true if it is the comma of a list, which is left, false if the `;`
/// of the item, which is left where a list is allowed.
pub(super) fn after_formula(
    input: ParseStream<'_>,
    formula: &Expression,
    is_list: bool,
) -> syn::Result<bool> {
    if is_list && (input.peek(Token![,]) || input.peek(Token![;])) {
        return Ok(true);
    }
    if input.peek(Token![;]) {
        input.parse::<Token![;]>()?;
        return Ok(false);
    }
    if input.is_empty() || name::at_item(input) {
        let message = "a `;` is missing behind this formula";
        return Err(SEMICOLON.error(formula.extent, message));
    }
    if input.peek(Token![,]) {
        let rest = input.fork();
        name::skip_one(&rest);
        mistake::refuse_decimal_comma(&rest, mistake::last_operand(formula))?;
        let message = "expected `;`: this item takes one definition";
        return Err(ONE_DEFINITION.error(input.span(), message));
    }
    Err(mistake::unexpected(input, formula))
}

/// The documentation of a statement belongs to every name of its list.
pub(super) fn joined(of_statement: &[Attribute], of_name: Vec<Attribute>) -> Vec<Attribute> {
    of_statement.iter().cloned().chain(of_name).collect()
}
