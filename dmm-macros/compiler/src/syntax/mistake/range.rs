//! What is said about ranges and sums that are written otherwise.

use num_traits::One;
use proc_macro2::Ident;
use syn::Token;
use syn::parse::ParseStream;

use super::super::{Expression, ExpressionKind, Operator};
use crate::algebra::Rational;
use crate::diagnostics::catalogue::syntax::{RANGE, SUM};
use crate::diagnostics::{Extent, closest};

/// How a sum is written.
pub(in crate::syntax) const SUM_FORM: &str = "a sum is written `sum(i in 0..n, term)`";

/// The error on `start..=end`.
pub(in crate::syntax) fn inclusive(start: &Expression, end: &Expression) -> syn::Error {
    let message = format!("a range excludes its end: write `{start}..{}`", next(end));
    RANGE.error(start.extent.to(end.extent), message)
}

/// `end + 1` as one would write it.
fn next(end: &Expression) -> String {
    match &end.kind {
        ExpressionKind::Number { value, .. } => (value + Rational::one()).to_string(),
        ExpressionKind::Binary {
            operator: Operator::Subtract,
            left,
            right,
        } if matches!(&right.kind, ExpressionKind::Number { value, .. } if value.is_one()) => {
            left.to_string()
        }
        _ => format!("{end} + 1"),
    }
}

/// The error behind `start` where no range goes on.
pub(in crate::syntax) fn no_range(input: ParseStream<'_>, start: &Expression) -> syn::Error {
    let message = if input.peek(Token![...]) || input.peek(Token![:]) {
        format!("a range is written with two dots, as in `{start}..n`")
    } else {
        format!("a range has a start and an end: write `0..{start}`, which excludes {start}")
    };
    RANGE.error(start.extent, message)
}

/// What is said about a range in the call of something else than `sum`.
pub(in crate::syntax) fn no_sum(function: &Ident, whole: Extent) -> syn::Error {
    match closest(&function.to_string(), ["sum"]) {
        Some(meant) => SUM.error(
            function,
            format!("there is no `{function}` over a range; did you mean `{meant}`?"),
        ),
        None => SUM.error(
            whole,
            format!("only a sum goes through a range, not `{function}`: {SUM_FORM}"),
        ),
    }
}
