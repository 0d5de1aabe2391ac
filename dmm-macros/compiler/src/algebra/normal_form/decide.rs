//! The answer to "is this expression identically zero?".
//!
//! Zero is proved by the normal form alone. Not zero is shown at a point: by a value far beyond
//! the bound of its rounding error, of the expression or of its normal form (in which what
//! cancels has been cancelled exactly), or by an exact rational value, however small.

use super::super::{Dag, Id, Math, Name};
use super::Obstacle;
use super::algebra::Algebra;
use super::form::{folded_form, normal_form};
use super::fraction::Fraction;
use super::sample::{self, Point};
use super::sums::normal_form_by_parts;
use super::write_back::Writer;

/// The work spent on the normal form of an expression that is known not to be zero.
const RESIDUAL_WORK: usize = 250_000;
/// The work spent on a form with long sums as symbols, which comes last.
const FOLDED_WORK: usize = 80_000;

/// The answer to "is this expression identically zero?".
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Zero wherever it is defined.
    Proved,
    /// Clearly not zero at a point.
    Refuted(Counterexample),
    /// Neither could be shown.
    Undecided,
    /// Neither could be shown within the work that a proof may take.
    Exhausted,
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

/// Whether `root` is zero wherever it is defined.
///
/// A few points come first: most expressions that are not zero are found out there.
pub fn decide_zero(dag: &mut Dag, root: Id) -> Verdict {
    decide_zero_on(dag, root, &[])
}

/// Whether `root` is zero wherever it and `domain` are defined.
pub fn decide_zero_on(dag: &mut Dag, root: Id, domain: &[Id]) -> Verdict {
    if dag.is_zero(root) {
        return Verdict::Proved;
    }
    let roots: Vec<Id> = [root].into_iter().chain(domain.iter().copied()).collect();
    let early = sample::soon_non_zero(dag, &roots);
    let mut algebra = match early {
        Some(_) => Algebra::with_budget(dag, RESIDUAL_WORK),
        None => Algebra::new(dag),
    };
    algebra.decides = true;
    algebra.assume_domain(dag, roots.iter().copied());
    let form = form_of(&mut algebra, dag, root);
    if form.as_ref().is_ok_and(Fraction::is_zero) {
        return Verdict::Proved;
    }
    let is_exhausted = matches!(form, Err(Obstacle::TooLarge));
    if is_exhausted && early.is_none() && is_folded_zero(dag, root, &roots) {
        return Verdict::Proved;
    }
    let written = form
        .ok()
        .and_then(|form| Writer::new(dag, &mut algebra).fraction(&form));
    let Some(found) = early.or_else(|| non_zero(dag, &roots, written)) else {
        return if is_exhausted {
            Verdict::Exhausted
        } else {
            Verdict::Undecided
        };
    };
    let residual = match written {
        Some(written) if dag.tree_size(written) <= dag.tree_size(root) => written,
        _ => root,
    };
    let Point { coordinates, value } = sample::shortened(dag, residual, &roots, found);
    Verdict::Refuted(Counterexample {
        residual,
        point: coordinates,
        value,
    })
}

/// What is zero where `root` is: without a sign and a constant factor in front.
fn without_factor(dag: &Dag, root: Id) -> Id {
    let mut id = root;
    loop {
        id = match dag[id] {
            Math::Neg(u) => u,
            Math::Mul([c, u]) if dag.as_constant(c).is_some() && !dag.is_zero(c) => u,
            Math::Mul([u, c]) | Math::Div([u, c])
                if dag.as_constant(c).is_some() && !dag.is_zero(c) =>
            {
                u
            }
            _ => return id,
        };
    }
}

/// The form of `root`; of sums, by parts, and if that takes too much, as a whole.
fn form_of(algebra: &mut Algebra, dag: &Dag, root: Id) -> Result<Fraction, Obstacle> {
    match dag[without_factor(dag, root)] {
        Math::Add(_) | Math::Sub(_) => match normal_form_by_parts(algebra, dag, root) {
            Err(Obstacle::TooLarge) => normal_form(algebra, dag, root),
            form => form,
        },
        _ => normal_form(algebra, dag, root),
    }
}

/// Whether `root` is zero with long sums as symbols: what is soon found out, or not at all.
fn is_folded_zero(dag: &Dag, root: Id, domain: &[Id]) -> bool {
    let mut algebra = Algebra::with_budget(dag, FOLDED_WORK);
    algebra.decides = true;
    algebra.assume_domain(dag, domain.iter().copied());
    folded_form(&mut algebra, dag, root).is_ok_and(|form| form.is_zero())
}

/// A point at which `roots`\[0\], or its normal form, is not zero.
fn non_zero(dag: &Dag, roots: &[Id], written: Option<Id>) -> Option<Point> {
    let root = *roots.first()?;
    sample::non_zero(dag, root, roots)
        .or_else(|| sample::non_zero(dag, written?, roots))
        .or_else(|| sample::exactly_non_zero(dag, root, roots))
}

/// Whether `root` is proved to be zero wherever it is defined.
pub fn is_proved_zero(dag: &Dag, root: Id) -> bool {
    if dag.is_zero(root) {
        return true;
    }
    if sample::soon_non_zero(dag, &[root]).is_some() {
        return false;
    }
    let mut algebra = Algebra::new(dag);
    algebra.decides = true;
    algebra.assume_domain(dag, [root]);
    match form_of(&mut algebra, dag, root) {
        Ok(form) => form.is_zero(),
        Err(Obstacle::TooLarge) => is_folded_zero(dag, root, &[root]),
        Err(Obstacle::Undefined) => false,
    }
}
