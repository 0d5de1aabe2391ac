//! The mistakes that newcomers make in formulas, each with what to write instead.

mod range;

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Lit, LitInt, Token, token};

use super::{Expression, ExpressionKind, Operator};
use super::{instead, name, number};
use crate::algebra::Function;
use crate::diagnostics::catalogue::syntax::{
    BRANCH, COMMENT, EQUALS, FUNCTION, GROUP, HAMILTONIAN, INDEX, METHOD, NUMBER, OPERAND,
    OPERATOR, POWER, RANGE, SEMICOLON, TYPE, UNEXPECTED,
};
use crate::diagnostics::{Code, Extent};
pub(super) use range::{SUM_FORM, inclusive, no_range, no_sum};

/// `x**2`
pub(super) fn refuse_double_star(input: ParseStream<'_>) -> syn::Result<()> {
    if !input.peek2(Token![*]) {
        return Ok(());
    }
    let first: Token![*] = input.parse()?;
    let second: Token![*] = input.parse()?;
    let place = Extent::new(first.span, second.span);
    Err(POWER.error(place, "power is written `^`, as in `x^2`"))
}

/// `x.powi(2)`, `x.sqrt()`, `self.k`, `q.0`
pub(super) fn refuse_method(input: ParseStream<'_>, receiver: &Expression) -> syn::Result<()> {
    if !input.peek(Token![.]) || input.peek(Token![..]) {
        return Ok(());
    }
    let dot: Token![.] = input.parse()?;
    let base = receiver.to_string();
    let Some(method) = name::peek_word(input) else {
        if input.peek(Token![*]) || input.peek(Token![/]) || input.peek(Token![^]) {
            let message = "a formula is made of numbers: write the operator without its point";
            return Err(OPERATOR.error(dot.span, message));
        }
        return Err(match input.parse::<Lit>() {
            Ok(Lit::Int(index)) if receiver.as_name().is_some() => {
                let place = receiver.extent.to(Extent::from(dot.span));
                let message = format!("an element of a group is written `{base}[{index}]`");
                INDEX.error(place, message)
            }
            _ => UNEXPECTED.error(dot.span, "unexpected `.` in a formula"),
        });
    };
    let place = receiver.extent.to(&method);
    let receiver = receiver.inside_parentheses().to_string();
    let (code, message) = about_method(&method.to_string(), &base, &receiver);
    Err(code.error(place, message))
}

fn about_method(method: &str, base: &str, receiver: &str) -> (Code, String) {
    match method {
        "powi" | "powf" | "pow" => (POWER, format!("power is written `^`, as in `{base}^2`")),
        "recip" => (METHOD, format!("write `1/{base}`")),
        "abs" | "min" | "max" | "clamp" => {
            let more = if method == "abs" { "" } else { ", …" };
            let message = format!(
                "a function stands in front of its arguments: write `{method}({receiver}{more})`"
            );
            (METHOD, message)
        }
        "signum" => (METHOD, format!("write `sign({receiver})`")),
        "atan2" => {
            let message = format!(
                "`{method}` jumps: write `2*atan(y/(x + sqrt(x^2 + y^2)))`, which is the angle of (x, y) where it does not jump"
            );
            (METHOD, message)
        }
        "step_by" | "rev" => {
            let message = "a range counts up by one: use a formula of the index, such as `q[2*i]`";
            (RANGE, message.into())
        }
        "len" => {
            let message =
                format!("declare the number of elements of `{receiver}` as a `const` and use that");
            (METHOD, message)
        }
        "sum" => (
            METHOD,
            "a sum is written `sum(i in 0..n, term)`".to_string(),
        ),
        function
            if function
                .parse::<Function>()
                .is_ok_and(Function::is_declarable) =>
        {
            const MODULES: &[&str] =
                &["Math", "math", "np", "numpy", "cmath", "sp", "sympy", "jnp"];
            let argument = if MODULES.contains(&receiver) {
                "x"
            } else {
                receiver
            };
            let message = format!("functions are not methods here: write `{method}({argument})`");
            (METHOD, message)
        }
        "dot" | "der" | "diff" => {
            let message = format!(
                "the rate of `{receiver}` is no part of a formula: name its own formula with `let` and use that"
            );
            (METHOD, message)
        }
        _ if receiver == "self" => {
            let message = format!("parameters are called by their name: write `{method}`");
            (METHOD, message)
        }
        _ => (
            METHOD,
            "formulas have neither methods nor fields".to_string(),
        ),
    }
}

/// `[0]` behind something that is not a group's name.
pub(super) fn refuse_index(input: ParseStream<'_>, found: &Expression) -> syn::Result<()> {
    if !input.peek(token::Bracket) {
        return Ok(());
    }
    let message = "only a group has elements, and its name stands in front of the index: `q[0]`";
    Err(INDEX.error(found.extent.to(input.span()), message))
}

/// `sqrt[x]`
pub(super) fn refuse_function_index(ident: &Ident) -> syn::Result<()> {
    match ident.to_string().parse::<Function>() {
        Ok(_) => Err(argument_of(ident)),
        Err(_) => Ok(()),
    }
}

fn argument_of(function: &Ident) -> syn::Error {
    let advice =
        format!("the argument of `{function}` stands in parentheses, as in `{function}(x)`");
    OPERATOR.error(function, advice)
}

/// `q[1..3]`
pub(super) fn slice(place: Extent, group: &Ident) -> syn::Error {
    let message = format!(
        "an index is one number: write `{group}[i]` in `sum(i in …, …)` or `for i in … {{ … }}`"
    );
    INDEX.error(place, message)
}

/// The error where an operand should stand.
pub(super) fn no_operand(input: ParseStream<'_>) -> syn::Error {
    let (code, message) = if input.is_empty() || input.peek(Token![;]) {
        (
            OPERAND,
            "the formula ends where a number, a name or a function is expected",
        )
    } else if input.peek(Token![+]) {
        (OPERAND, "there is no unary plus: leave it out")
    } else if input.peek(Token![..]) {
        (RANGE, "a range has a start and an end: write `0..n`")
    } else if input.peek(Token![.]) {
        return leading_point(input);
    } else if input.peek(token::Bracket) {
        (
            GROUP,
            "a list stands only as the defaults of a group: `param m[3] = [1, 2, 3];`",
        )
    } else if input.peek(token::Brace) {
        (
            OPERAND,
            "a formula has no block: name parts of it with `let`",
        )
    } else if is_closure(input) {
        (FUNCTION, "a function is declared as `fn name(x) = …;`")
    } else if input.peek(Lit) {
        (
            OPERAND,
            "a formula is made of real numbers: write one instead of this",
        )
    } else if input.peek(Token![|]) || input.peek(Token![||]) {
        (BRANCH, "the absolute value is written `abs(u)`")
    } else if input.peek(Token![=]) {
        (EQUALS, "a definition has one `=`")
    } else {
        (OPERAND, "expected a number, a name or a function")
    };
    code.error(input.span(), message)
}

/// Whether `|x| formula` stands here.
fn is_closure(input: ParseStream<'_>) -> bool {
    let rest = input.fork();
    rest.parse::<Token![|]>().is_ok()
        && name::word(&rest).is_ok()
        && rest.parse::<Token![|]>().is_ok()
        && (rest.peek(Lit) || rest.peek(token::Paren) || name::peek_word(&rest).is_some())
}

/// `.5`
fn leading_point(input: ParseStream<'_>) -> syn::Error {
    let rest = input.fork();
    name::skip_one(&rest);
    let message = match rest.parse::<Lit>() {
        Ok(digits) => format!(
            "a number has a digit in front of its point: write `0.{}`",
            number::literal_text(&digits)
        ),
        Err(_) => "unexpected `.` in a formula".into(),
    };
    OPERAND.error(input.span(), message)
}

/// `9,81`: a number behind the comma of a list, in which `before` is the last formula.
pub(super) fn refuse_decimal_comma(
    input: ParseStream<'_>,
    before: Option<&Expression>,
) -> syn::Result<()> {
    if let Some(whole) = before
        && matches!(whole.kind, ExpressionKind::Number { .. })
        && let Ok(decimals) = input.fork().parse::<LitInt>()
    {
        let place = whole.extent.to(decimals.span());
        let message = format!("decimals stand behind a point: write `{whole}.{decimals}`");
        return Err(NUMBER.error(place, message));
    }
    Ok(())
}

/// The error on a token that cannot go on the formula `before`.
pub(super) fn unexpected(input: ParseStream<'_>, before: &Expression) -> syn::Error {
    if let Some(word) = name::peek_word(input)
        && let Some((code, advice)) = unexpected_word(&word.to_string())
    {
        return code.error(&word, advice);
    }
    let operand_follows =
        input.peek(Lit) || input.peek(token::Paren) || name::peek_word(input).is_some();
    if !operand_follows {
        let (code, message) = unexpected_sign(input);
        return code.error(input.span(), message);
    }
    if let Some(function) = last_name(before)
        && function.to_string().parse::<Function>().is_ok()
    {
        return argument_of(function);
    }
    if let Some(power) = power_of_function(before) {
        return OPERATOR.error(before.extent.to(input.span()), power);
    }
    if let Some(word) = last_name(before).filter(|word| *word == "return") {
        let message = "a formula executes nothing: leave out `return`";
        return UNEXPECTED.error(word, message);
    }
    let message = match (last_name(before), name::peek_word(input)) {
        (Some(left), Some(right)) => format!("missing operator: write `{left}*{right}`"),
        _ => "missing operator: a product is written `a*b`".to_owned(),
    };
    OPERATOR.error(input.span(), message)
}

/// `sin^2` in front of its argument.
fn power_of_function(before: &Expression) -> Option<String> {
    let factor = match &before.kind {
        ExpressionKind::Binary {
            operator: Operator::Add | Operator::Subtract | Operator::Multiply | Operator::Divide,
            right,
            ..
        } => return power_of_function(right),
        ExpressionKind::Negative(operand) => return power_of_function(operand),
        _ => before,
    };
    let ExpressionKind::Binary { left, right, .. } = &factor.kind else {
        return None;
    };
    let function = left.as_name()?;
    function.to_string().parse::<Function>().ok()?;
    Some(format!(
        "the power of a function stands behind its argument: write `{function}(x)^{right}`"
    ))
}

/// The error on a token that cannot go on the formula `before` in a list of formulas.
pub(super) fn unexpected_in_list(input: ParseStream<'_>, before: &Expression) -> syn::Error {
    if input.peek(Token![;]) {
        return UNEXPECTED.error(input.span(), "the formulas of a list are separated by `,`");
    }
    if input.peek(Lit) {
        let message = "missing operator, or a `,` between the formulas of a list";
        return OPERATOR.error(input.span(), message);
    }
    unexpected(input, before)
}

/// What is said about a word behind a complete formula.
fn unexpected_word(word: &str) -> Option<(Code, &'static str)> {
    Some(match word {
        "as" => (TYPE, "every quantity is real: leave out the conversion"),
        "in" => (
            HAMILTONIAN,
            "nothing follows this formula: only a `hamiltonian` has its canonical pairs `in (q, p)`",
        ),
        "mod" => (OPERATOR, "the remainder is written `%`, as in `q[i % n]`"),
        "do" | "begin" | "end" | "endif" => (
            UNEXPECTED,
            "a block stands in braces, `{ … }`, and a formula ends with `;`",
        ),
        "with" | "over" | "wrt" => (
            HAMILTONIAN,
            "the canonical pairs of a `hamiltonian` stand behind `in`: `in (q, p)`",
        ),
        "to" | "step" => (RANGE, "a range is written `0..n`, and counts up by one"),
        _ => return instead::of_branch(word),
    })
}

/// Whether two things are compared here.
pub(super) fn at_comparison(input: ParseStream<'_>) -> bool {
    input.peek(Token![==])
        || input.peek(Token![=]) && !input.peek(Token![=>])
        || input.peek(Token![!=])
        || input.peek(Token![<=])
        || input.peek(Token![>=])
        || input.peek(Token![<]) && !input.peek(Token![<-])
        || input.peek(Token![>])
}

/// Whether an operator of formulas stands here, and no assignment such as `+=`.
pub(super) fn at_operator(input: ParseStream<'_>) -> bool {
    !at_assignment(input)
        && (input.peek(Token![+])
            || input.peek(Token![-]) && !input.peek(Token![->])
            || input.peek(Token![*])
            || input.peek(Token![/])
            || input.peek(Token![^]))
}

/// Whether `+=` or the like stands here.
pub(super) fn at_assignment(input: ParseStream<'_>) -> bool {
    input.peek(Token![+=])
        || input.peek(Token![-=])
        || input.peek(Token![*=])
        || input.peek(Token![/=])
        || input.peek(Token![^=])
        || input.peek(Token![%=])
}

/// The last operand of a formula: that behind which a token is unexpected.
pub(super) fn last_operand(expression: &Expression) -> Option<&Expression> {
    match &expression.kind {
        ExpressionKind::Negative(operand) => last_operand(operand),
        ExpressionKind::Binary { right, .. } => last_operand(right),
        _ => Some(expression),
    }
}

fn last_name(expression: &Expression) -> Option<&Ident> {
    match &expression.kind {
        ExpressionKind::Name(ident) => Some(ident),
        ExpressionKind::Negative(operand) => last_name(operand),
        ExpressionKind::Binary { right, .. } => last_name(right),
        _ => None,
    }
}

fn unexpected_sign(input: ParseStream<'_>) -> (Code, &'static str) {
    if input.peek(Token![->]) || input.peek(Token![=>]) {
        (FUNCTION, "a function is declared as `fn name(x) = …;`")
    } else if input.peek(Token![:]) || input.peek(Token![@]) || input.peek(Token![~]) {
        (
            UNEXPECTED,
            "this sign has no meaning in a formula; an item ends with `;`",
        )
    } else if input.peek(Token![=]) && !input.peek(Token![==]) {
        (
            SEMICOLON,
            "a formula ends before `=`; is a `;` missing in front of this item?",
        )
    } else if at_comparison(input)
        || input.peek(Token![&&])
        || input.peek(Token![||])
        || input.peek(Token![?])
    {
        (
            BRANCH,
            "a comparison decides in a branch: write `if a > b { u } else { v }`",
        )
    } else if input.peek(Token![..]) {
        (
            RANGE,
            "a range stands behind the `in` of a loop or a sum: `for i in 0..n`, `sum(i in 0..n, …)`",
        )
    } else if input.peek(Token![#]) {
        (COMMENT, "a comment is written `// …`")
    } else if at_assignment(input) {
        (UNEXPECTED, "a formula has no assignments")
    } else if input.peek(Token![!]) {
        (UNEXPECTED, "there is no factorial: write the number")
    } else if input.peek(Token![,]) {
        (
            UNEXPECTED,
            "a formula is one number: a `,` stands only between the arguments of a function",
        )
    } else if input.peek(token::Brace) {
        (UNEXPECTED, "a formula has no block; is a `;` missing?")
    } else {
        (UNEXPECTED, "unexpected token in a formula")
    }
}
