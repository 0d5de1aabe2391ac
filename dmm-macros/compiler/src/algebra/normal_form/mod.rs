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
//! The converse needs the atoms to be independent, which is not known in general: √(xy) and
//! √x·√y are different forms of what may be equal. "Not zero" is therefore said only of an
//! expression that is clearly non-zero at a point; the third answer is "undecided".

mod algebra;
mod arithmetic;
mod division;
mod factors;
mod form;
mod fraction;
mod functions;
mod gcd;
mod monomial;
mod number;
mod polynomial;
mod powers;
mod roots;
mod sample;
mod write_back;

use super::{Dag, Id, Math, Name};
use algebra::Algebra;
use form::normal_form;
use fraction::Fraction;
use write_back::Writer;

/// The work spent on the normal form of an expression that is known not to be zero.
const RESIDUAL_WORK: usize = 4_000;

/// The answer to "is this expression identically zero?".
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Zero wherever it is defined.
    Proved,
    /// Clearly not zero at a point.
    Refuted(Counterexample),
    /// Neither could be shown.
    Undecided,
}

/// A point at which an expression is clearly not zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The expression, simplified for reading.
    pub residual: Id,
    /// The point, in the order of the names.
    pub point: Vec<(Name, f64)>,
    /// The expression's value there.
    pub value: f64,
}

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

/// Whether `root` is identically zero.
///
/// A few points come first: most expressions that are not zero are found out there, without
/// the cost of a normal form, which is then formed only as far as it makes the residual short.
pub fn decide_zero(dag: &mut Dag, root: Id) -> Verdict {
    let early = sample::soon_non_zero(dag, root);
    let mut algebra = match early {
        Some(_) => Algebra::with_budget(RESIDUAL_WORK),
        None => Algebra::default(),
    };
    let form = normal_form(&mut algebra, dag, root);
    if form.as_ref().is_ok_and(Fraction::is_zero) {
        return Verdict::Proved;
    }
    let Some((point, value)) = early.or_else(|| sample::non_zero(dag, root)) else {
        return Verdict::Undecided;
    };
    let written = form
        .ok()
        .and_then(|form| Writer::new(dag, &mut algebra).fraction(&form));
    let residual = match written {
        Some(written) if dag.tree_size(written) <= dag.tree_size(root) => written,
        _ => root,
    };
    Verdict::Refuted(Counterexample {
        residual,
        point,
        value,
    })
}

/// Whether `root` is proved to be zero.
pub fn is_proved_zero(dag: &Dag, root: Id) -> bool {
    dag.is_zero(root)
        || sample::soon_non_zero(dag, root).is_none()
            && normal_form(&mut Algebra::default(), dag, root).is_ok_and(|form| form.is_zero())
}

/// `numerator`/`denominator` with common factors cancelled; `None` if the denominator is
/// identically zero or there is no normal form.
pub fn divide_exactly(dag: &mut Dag, numerator: Id, denominator: Id) -> Option<Quotient> {
    let mut algebra = Algebra::default();
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
    let mut algebra = Algebra::default();
    let form = normal_form(&mut algebra, dag, root).ok()?;
    Writer::new(dag, &mut algebra).fraction(&form)
}
