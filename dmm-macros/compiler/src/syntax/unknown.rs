//! What is said where no item of the language stands.

use proc_macro2::{Group, Ident};
use syn::parse::ParseStream;
use syn::{Lit, Token, token};

use super::instead;
use super::name;
use super::place::Place;
use crate::diagnostics::catalogue::syntax::{
    COMMENT, DERIVATIVE, FUNCTION, INITIAL_VALUE, MISPLACED_ITEM, SEMICOLON, UNKNOWN_ITEM,
};
use crate::diagnostics::{Code, closest};

/// What may stand at `place`.
fn expected(place: Place) -> &'static str {
    match place {
        Place::System => {
            "expected `state`, `param`, `const`, `let`, `fn`, `interface`, `region`, `der`, `hamiltonian`, `conserved`, `sliding`, `discrete`, `on`, `every`, `at` or `for`"
        }
        Place::Region => "expected `let`, `der`, `hamiltonian`, `conserved`, `on` or `for`",
        Place::Sliding => "expected `conserved`",
        Place::Loop(_) => "expected `der`, `conserved` or `for`",
    }
}

/// The error on the item `keyword` that cannot stand at `place`, if it cannot.
pub(super) fn misplaced(keyword: &Ident, place: Place) -> Option<syn::Error> {
    let text = keyword.to_string();
    let message = match (place, text.as_str()) {
        (Place::System, _) => return None,
        (
            _,
            "state" | "param" | "const" | "fn" | "interface" | "region" | "discrete" | "every"
            | "at" | "sliding",
        ) => {
            let block = match place {
                Place::Loop(_) => "a loop",
                Place::Sliding => "the block of a sliding motion",
                _ => "a region",
            };
            format!("`{text}` belongs at the top level of the system, not in {block}")
        }
        (Place::Sliding, "conserved" | "assume") => return None,
        (Place::Sliding, "der" | "hamiltonian") => {
            "the motion on an interface follows from the fields on its sides: leave out this rate"
                .to_owned()
        }
        (Place::Sliding, _) => format!("`{text}` does not belong here: {}", expected(place)),
        (Place::Loop(_), "let") => {
            "a loop has no `let`: declare a function of the index, `fn r(i) = …;`, in front of it"
                .to_owned()
        }
        (Place::Loop(_), "hamiltonian") => {
            "a loop has no `hamiltonian`: write one with a `sum` in front of it".to_owned()
        }
        (Place::Loop(_), "on") => "a loop has no `on`: write one for each interface".to_owned(),
        _ => return None,
    };
    Some(MISPLACED_ITEM.error(keyword, message))
}

/// The error on a token with which no item begins.
pub(super) fn no_word(input: ParseStream<'_>, place: Place) -> syn::Error {
    if input.peek(Token![;]) {
        let message = format!("this `;` ends nothing: {}", expected(place));
        return SEMICOLON.error(input.span(), message);
    }
    let is_dashes = input.peek(Token![-]) && input.peek2(Token![-]);
    if input.peek(Token![#]) || input.peek(Token![%]) || is_dashes {
        return COMMENT.error(input.span(), "a comment is written `// …`");
    }
    if input.peek(Lit) || input.peek(token::Paren) {
        let message =
            "an item begins with its word: a rate stands alone on the left, `der(x) = …;`";
        return UNKNOWN_ITEM.error(input.span(), message);
    }
    if input.peek(Token![+]) || input.peek(Token![-]) || input.peek(Token![*]) {
        let message = "no item begins like this: does it go on the formula in front of the `;`?";
        return SEMICOLON.error(input.span(), message);
    }
    UNKNOWN_ITEM.error(input.span(), expected(place))
}

/// The error on a word with which no item begins.
pub(super) fn word(input: ParseStream<'_>, keyword: &Ident, place: Place) -> syn::Error {
    let text = keyword.to_string();
    let rest = input.fork();
    name::skip_one(&rest);
    let is_defined = rest.peek(Token![=]) && !rest.peek(Token![==]);
    let known = instead::of_item(&text).filter(|_| !is_defined && !is_declared_call(&rest));
    let (code, message) = if let Some(known) = known {
        known
    } else if rest.peek(token::Paren) {
        called(&rest, &text, place)
    } else if rest.peek(Token![.]) {
        let message = format!("a rate is written `der({text}) = …;`");
        (DERIVATIVE, message)
    } else if rest.peek(Token![=]) && !rest.peek(Token![==]) {
        let message = format!(
            "write `let {text} = …;` to name a formula, and `der({}) = …;` for the rate of a state",
            state_of(&text)
        );
        (UNKNOWN_ITEM, message)
    } else if rest.peek(Token![/]) {
        (DERIVATIVE, "a derivative is written `der(x) = …;`".into())
    } else if rest.peek(Token![+=]) || rest.peek(Token![-=]) || rest.peek(token::Bracket) {
        let message = "nothing is assigned: write `der(x) = …;` for the rate of a state".into();
        (DERIVATIVE, message)
    } else {
        misnamed(&text, place)
    };
    code.error(keyword, message)
}

/// Whether the definition of a function follows, `(q) = …`, of which nothing is a number.
fn is_declared_call(rest: ParseStream<'_>) -> bool {
    let rest = rest.fork();
    let arguments = rest.parse::<Group>();
    let is_value = |arguments: &Group| syn::parse2::<Lit>(arguments.stream()).is_ok();
    rest.peek(Token![=]) && arguments.is_ok_and(|arguments| !is_value(&arguments))
}

/// The state of which `dx`, `dxdt` or `x_dot` is probably meant to be the rate.
fn state_of(text: &str) -> &str {
    let state = (text.strip_suffix("_dot"))
        .or_else(|| text.strip_suffix("dot"))
        .or_else(|| text.strip_prefix('d')?.strip_suffix("dt"))
        .or_else(|| text.strip_prefix('d').filter(|rest| rest.len() < 3));
    state.filter(|state| !state.is_empty()).unwrap_or(text)
}

/// `d(x) = …`, `V(q) = …`
fn called(rest: ParseStream<'_>, text: &str, place: Place) -> (Code, String) {
    let is_derivative = matches!(
        text,
        "d" | "D"
            | "dt"
            | "ddt"
            | "d_dt"
            | "diff"
            | "deriv"
            | "derivative"
            | "Derivative"
            | "dot"
            | "rate"
    );
    let is_value = rest
        .fork()
        .parse::<Group>()
        .is_ok_and(|arguments| syn::parse2::<Lit>(arguments.stream()).is_ok());
    name::skip_one(rest);
    if is_value && rest.peek(Token![=]) {
        let message = "the initial state is given to the integrator, not declared".into();
        (INITIAL_VALUE, message)
    } else if is_derivative {
        (DERIVATIVE, "a derivative is written `der(x) = …;`".into())
    } else if rest.peek(Token![=]) {
        let message = format!("a function is declared as `fn {text}(…) = …;`");
        (FUNCTION, message)
    } else {
        misnamed(text, place)
    }
}

fn misnamed(text: &str, place: Place) -> (Code, String) {
    let message = match closest(text, name::ITEMS.iter().copied()) {
        Some(word) => format!("unknown item `{text}`; did you mean `{word}`?"),
        None => format!("unknown item `{text}`: {}", expected(place)),
    };
    (UNKNOWN_ITEM, message)
}
