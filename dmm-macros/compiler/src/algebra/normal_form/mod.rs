//! The normal form that decides whether an expression is zero: expression → fraction of sparse
//! Laurent polynomials with exact Gaussian-rational coefficients and rational exponents over
//! *atoms*.
//!
//! Atoms are variables, π, exponentials E\[m\] = exp(m) of monomials m (so that exp(Σ cₖ mₖ) =
//! Π E\[mₖ\]^cₖ), phases P\[m\] = exp(i·m) for trigonometry (so that sin² + cos² = 1 and multiple
//! angles come out by themselves), logarithms, roots and inverse functions of normalised
//! arguments. Denominators stay factored. An expression is zero wherever it is defined if its
//! numerator has no terms.
//!
//! The converse needs the atoms to be independent, which is not known in general: √(3 + 2√2) and
//! 1 + √2 are different forms of what is equal. "Not zero" is therefore said only of an
//! expression that is clearly non-zero at a point; the third answer is "undecided".

mod algebra;
mod angles;
mod approximate;
mod arithmetic;
mod common;
mod constants;
mod decide;
mod denominator;
mod division;
mod domain;
mod factors;
mod form;
mod fraction;
mod functions;
mod gcd;
mod monomial;
mod nested;
mod number;
mod polynomial;
mod powers;
mod roots;
mod sample;
mod sums;
pub mod terms;
mod write_back;

use super::{Dag, Id, Math};
use algebra::Algebra;
pub use common::{CommonZeros, common_zeros};
pub use decide::{Counterexample, Verdict, decide_zero, decide_zero_on, is_proved_zero};
use form::normal_form;
use write_back::Writer;

/// A quotient after exact cancellation.
#[derive(Clone, Debug, PartialEq)]
pub struct Quotient {
    /// The quotient.
    pub value: Id,
    /// The factors of its denominator that may vanish.
    pub denominator: Vec<Id>,
}

/// Why an expression has no normal form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Obstacle {
    /// It would have too many terms or too large exponents.
    TooLarge,
    /// It is nowhere defined over the reals (1/0, ln of −1), or not known to be real.
    Undefined,
}

/// `numerator`/`denominator` with common factors cancelled; `None` if the denominator is
/// identically zero or there is no normal form.
pub fn divide_exactly(dag: &mut Dag, numerator: Id, denominator: Id) -> Option<Quotient> {
    let mut algebra = Algebra::new(dag);
    let quotient = dag.insert(Math::Div([numerator, denominator]));
    let quotient = normal_form(&mut algebra, dag, quotient).ok()?;
    let quotient = algebra.lowest_terms(quotient).ok()?;
    let mut writer = Writer::new(dag, &mut algebra);
    let value = writer.fraction(&quotient)?;
    let denominator = writer.denominator(&quotient)?;
    Some(Quotient { value, denominator })
}

/// The normal form of `root` as an expression; `None` if it has none.
pub fn normalise(dag: &mut Dag, root: Id) -> Option<Id> {
    let mut algebra = Algebra::new(dag);
    let form = normal_form(&mut algebra, dag, root).ok()?;
    Writer::new(dag, &mut algebra).fraction(&form)
}
