//! Groups `q[3]`: how states and parameters are declared.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Attribute, Token, bracketed, token};

use super::definition::{after_formula, equals, joined, list, no_type};
use super::{Defaults, Expression, Group, Item, ParameterItem};
use super::{documentation, formula, mistake, name};
use crate::diagnostics::catalogue::syntax::{DEFAULT, GROUP, INITIAL_VALUE, NAME, TYPE};
use crate::diagnostics::{Diagnostics, Extent};

/// `x, q[3];`
pub(super) fn states(
    input: ParseStream<'_>,
    attributes: &[Attribute],
    diagnostics: &mut Diagnostics,
) -> Vec<Group> {
    let mut states = Vec::new();
    list(input, "state", diagnostics, |diagnostics| {
        let (state, place) = group(input, "state", attributes, diagnostics)?;
        let text = state.to_string();
        states.push(state);
        let is_assigned = input.peek(Token![:]) && input.peek2(Token![=]);
        if place.is_ok() && (input.peek(Token![=]) || is_assigned) {
            let message = format!(
                "a state has no value here: the initial state is given to the integrator; write `state {text};`"
            );
            return Err(INITIAL_VALUE.error(input.span(), message));
        }
        place
    });
    states
}

/// `k = 1, m[3] = 1, l[2] = [1, 2];`
pub(super) fn parameters(
    input: ParseStream<'_>,
    attributes: &[Attribute],
    diagnostics: &mut Diagnostics,
) -> Vec<Item> {
    let mut parameters = Vec::new();
    list(input, "param", diagnostics, |diagnostics| {
        mistake::refuse_decimal_comma(input, last_default(&parameters))?;
        let (mut group, place) = group(input, "param", attributes, diagnostics)?;
        let defaults = place.and_then(|place| defaults(input, &mut group, place));
        let (defaults, place) = match defaults {
            Ok((defaults, place)) => (defaults, Ok(place)),
            Err(error) => {
                // the name is kept: others refer to it
                let zero = Expression::integer(0, Extent::from(&group.ident));
                (Defaults::Same(zero), Err(error))
            }
        };
        parameters.push(Item::Parameter(ParameterItem { group, defaults }));
        place
    });
    parameters
}

/// The default of the last of some parameters.
fn last_default(parameters: &[Item]) -> Option<&Expression> {
    match parameters.last() {
        Some(Item::Parameter(ParameterItem {
            defaults: Defaults::Same(formula),
            ..
        })) => Some(formula),
        _ => None,
    }
}

/// A name with its length if it is a group, and where it stands or what is wrong behind the
/// name.
fn group(
    input: ParseStream<'_>,
    keyword: &str,
    attributes: &[Attribute],
    diagnostics: &mut Diagnostics,
) -> syn::Result<(Group, syn::Result<Extent>)> {
    let attributes = joined(attributes, documentation(input, diagnostics)?);
    if input.peek(token::Paren) || input.peek(token::Bracket) {
        let message = format!("names stand without brackets: write `{keyword} x, y;`");
        return Err(NAME.error(input.span(), message));
    }
    if name::is_type(input) {
        let message = format!("every quantity is real: write `{keyword} x` without a type");
        return Err(TYPE.error(input.span(), message));
    }
    let ident = name::declared_or_reported(input, diagnostics)?;
    let mut group = Group {
        attributes,
        ident,
        length: None,
    };
    let place = behind_name(input, keyword, &mut group);
    Ok((group, place))
}

fn behind_name(input: ParseStream<'_>, keyword: &str, group: &mut Group) -> syn::Result<Extent> {
    let ident = &group.ident;
    let mut place = Extent::from(ident);
    if input.peek(token::Bracket) {
        let (formula, close) = length(input, ident)?;
        place = place.to(close);
        group.length = Some(formula);
    }
    if input.peek(token::Paren) {
        return Err(parentheses(input, keyword, ident));
    }
    no_type(input, keyword, ident)?;
    Ok(place)
}

/// The error on `(t)`, `(0) = 1` or `(3)` behind a name that is declared.
fn parentheses(input: ParseStream<'_>, keyword: &str, ident: &Ident) -> syn::Error {
    let rest = input.fork();
    let is_of_time = (rest.parse::<proc_macro2::Group>())
        .is_ok_and(|group| matches!(group.stream().to_string().as_str(), "t" | "time"));
    let (code, message) = if is_of_time && keyword == "state" {
        let message = format!("a state depends on the time in any case: write `state {ident};`");
        (GROUP, message)
    } else if is_of_time {
        let message = format!("a parameter is constant: a formula of `t` is `let {ident} = …;`");
        (DEFAULT, message)
    } else if rest.peek(Token![=]) && keyword == "state" {
        let message = format!(
            "a state has no value here: the initial state is given to the integrator; write `state {ident};`"
        );
        (INITIAL_VALUE, message)
    } else {
        let message = format!("a group of states or parameters is declared as `{ident}[3]`");
        (GROUP, message)
    };
    code.error(input.span(), message)
}

/// `[formula]` behind a name that is declared, with the place of its `]`.
fn length(input: ParseStream<'_>, ident: &Ident) -> syn::Result<(Expression, Extent)> {
    let content;
    let brackets = bracketed!(content in input);
    let whole = Extent::new(brackets.span.open(), brackets.span.close());
    let one_index = "a group has one index: declare a group for each row";
    if content.is_empty() {
        let message = format!("how many elements has `{ident}`? write `{ident}[3]`");
        return Err(GROUP.error(whole, message));
    }
    let length = formula::formula(&content)?;
    if content.peek(Token![..]) {
        let message =
            format!("a group is declared with its number of elements, as in `{ident}[3]`");
        return Err(GROUP.error(whole, message));
    }
    if content.peek(Token![,]) {
        return Err(GROUP.error(whole, one_index));
    }
    if !content.is_empty() {
        return Err(mistake::unexpected(&content, &length));
    }
    if input.peek(token::Bracket) {
        return Err(GROUP.error(input.span(), one_index));
    }
    Ok((length, brackets.span.close().into()))
}

/// `= formula` for all elements, or `= [formula, formula]` with one an element.
fn defaults(
    input: ParseStream<'_>,
    group: &mut Group,
    place: Extent,
) -> syn::Result<(Defaults, Extent)> {
    if input.peek(Token![;]) || input.peek(Token![,]) {
        let message = format!("a parameter has a default: write `param {group} = 1;`");
        return Err(DEFAULT.error(place, message));
    }
    equals(input, &format!("param {group}"))?;
    if input.peek(token::Brace) {
        let message = "a list of defaults stands in brackets: `[1, 2, 3]`";
        return Err(GROUP.error(input.span(), message));
    }
    if input.peek(token::Bracket) {
        return each(input, group);
    }
    let formula = formula::formula(input)?;
    after_formula(input, &formula, true)?;
    let place = formula.extent;
    Ok((Defaults::Same(formula), place))
}

fn each(input: ParseStream<'_>, group: &mut Group) -> syn::Result<(Defaults, Extent)> {
    let content;
    let brackets = bracketed!(content in input);
    let place = Extent::new(brackets.span.open(), brackets.span.close());
    let mut formulas = Vec::new();
    while !content.is_empty() {
        let formula = formula::formula(&content)?;
        if content.peek(Token![;]) {
            let message =
                format!("one default for all elements: write `param {group} = {formula};`");
            return Err(GROUP.error(place, message));
        }
        if !content.is_empty() && !content.peek(Token![,]) {
            return Err(mistake::unexpected_in_list(&content, &formula));
        }
        formulas.push(formula);
        name::skip_one(&content);
    }
    if formulas.is_empty() {
        let message = "a list of defaults has one for each element of the group";
        return Err(GROUP.error(place, message));
    }
    if group.length.is_none() {
        let count = formulas.len();
        group.length = Some(Expression::integer(count, place));
        let message = format!("only a group has a list of defaults: write `param {group} = …;`");
        return Err(GROUP.error(Extent::from(&group.ident).to(place), message));
    }
    Ok((Defaults::Each(formulas, place), place))
}
