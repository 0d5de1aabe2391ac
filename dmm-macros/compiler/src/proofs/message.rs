//! What the proofs report of what is false or could not be proved, and how it is worded: with
//! the residual, a point, and the value there.

use super::DomainCondition;
use super::trials::{FEWEST_POINTS, MOST_TRIALS, Trials};
use crate::algebra::{Counterexample, Dag, Id, Name, to_text};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::catalogue::proofs as codes;
use crate::model::{Conserved, Interface, Region};

/// Residuals are shown up to this many characters.
const LONGEST_RESIDUAL: usize = 240;
/// Coordinates that are zero are summed up if there are more than this.
const MOST_ZEROS: usize = 4;

/// What is wrong with one ψ.
pub(super) enum QuantityProblem {
    /// All of its derivatives are zero.
    Constant,
    /// ∂ₜψ + ∇ψ·f is not zero.
    Refuted(Counterexample),
    /// It was not decided whether ∂ₜψ + ∇ψ·f is zero.
    NotProved {
        /// ∂ₜψ + ∇ψ·f
        residual: Id,
        /// Whether the work that proofs may take ran out.
        is_exhausted: bool,
    },
    /// It needs what excludes itself.
    NoValue(Vec<DomainCondition>),
    /// It is assumed to be conserved, and is not at a point.
    NotSmall {
        /// ∂ₜψ + ∇ψ·f there.
        residual: f64,
        /// The size of its terms there.
        size: f64,
        /// The point.
        point: Vec<(Name, f64)>,
    },
    /// It is assumed to be conserved, which too few points tell.
    Unchecked(Trials),
}

impl QuantityProblem {
    pub(super) fn report(
        self,
        dag: &Dag,
        region: &Region,
        psi: &Conserved,
        diagnostics: &mut Diagnostics,
    ) {
        let name = &psi.ident;
        let place = in_region(region);
        let (code, message) = match self {
            Self::Constant => (
                codes::CONSTANT_QUANTITY,
                format!(
                    "`{name}` depends neither on the states nor on `t`: a constant needs no conservation; remove it"
                ),
            ),
            Self::Refuted(counterexample) => (
                codes::NOT_CONSERVED,
                format!(
                    "`{name}` is not conserved{place}: d/dt {name} = {}",
                    refutation(dag, &counterexample)
                ),
            ),
            Self::NotProved {
                residual,
                is_exhausted,
            } => {
                let found = if is_exhausted {
                    "was not found to be zero before the work that proofs may take ran out; write it with fewer or shorter terms"
                } else {
                    "was found neither to be zero nor clearly not to be; write it in another way"
                };
                let message = format!(
                    "`{name}` could not be proved to be conserved{place}: d/dt {name} = {} {found}, or accept it with `assume conserved {name} = …;`, which checks it at many points",
                    shortened(&to_text(dag, residual))
                );
                (codes::NOT_PROVED, message)
            }
            Self::NoValue(needs) => {
                let needs: Vec<String> = needs.iter().map(|need| need.statement(dag)).collect();
                let message = format!(
                    "`{name}` and its rate have no value anywhere{place}: they need {}",
                    needs.join(" and ")
                );
                (codes::EMPTY_DOMAIN, message)
            }
            Self::NotSmall {
                residual,
                size,
                point,
            } => {
                let message = format!(
                    "`{name}` is assumed to be conserved{place}, but d/dt {name} is {} at {}, where its terms are of size {}",
                    rounded(residual),
                    coordinates(&point),
                    rounded(size)
                );
                (codes::ASSUMED_NOT_SMALL, message)
            }
            Self::Unchecked(trials) => {
                let message = format!(
                    "`{name}` is assumed to be conserved{place}, but that can be checked at {} of {MOST_TRIALS} points only, and {FEWEST_POINTS} are needed: {}",
                    trials.usable,
                    why_not(&trials, &name.to_string())
                );
                (codes::ASSUMED_UNCHECKED, message)
            }
        };
        diagnostics.report(code, psi.span, message);
    }
}

/// Why points say nothing of an assumption.
fn why_not(trials: &Trials, name: &str) -> String {
    let no_value = |count: usize| format!("its formulas have no value at {count}");
    let no_terms = |count: usize| {
        format!("the terms of d/dt {name} are zero up to rounding errors at {count}")
    };
    match (trials.undefined, trials.without_terms) {
        (undefined, 0) => no_value(undefined),
        (0, without_terms) => no_terms(without_terms),
        (undefined, without_terms) => {
            format!("{}, and {}", no_value(undefined), no_terms(without_terms))
        }
    }
}

/// What is wrong with the ψ of a region together.
pub(super) enum RegionProblem {
    /// They are more than the states.
    TooMany {
        /// The number of states.
        states: usize,
    },
    /// The gradient of this one depends on those before it.
    Dependent {
        /// Its index.
        row: usize,
    },
    /// They are as many as the states and do not depend on the time.
    NothingMoves,
}

impl RegionProblem {
    pub(super) fn report(self, region: &Region, diagnostics: &mut Diagnostics) {
        let place = in_region(region);
        let count = region.conserved.len();
        let (code, row, message) = match self {
            Self::TooMany { states } => (
                codes::TOO_MANY_QUANTITIES,
                states,
                format!(
                    "{count} conserved quantities of {states} states depend on one another{place}: leave out {}",
                    count - states
                ),
            ),
            Self::Dependent { row } => {
                let names: Vec<String> = (region.conserved.iter())
                    .take(row + 1)
                    .map(|psi| format!("`{}`", psi.ident))
                    .collect();
                let (others, own) = names.split_at(row);
                let message = format!(
                    "{} depends on {}{place}: their gradients are linearly dependent; remove it",
                    own.concat(),
                    others.join(", ")
                );
                (codes::DEPENDENT_QUANTITIES, row, message)
            }
            Self::NothingMoves => (
                codes::NOTHING_MOVES,
                count - 1,
                format!(
                    "{count} independent conserved quantities of {count} states leave nothing to move{place}: declare one less, or none where the vector field is zero"
                ),
            ),
        };
        if let Some(psi) = region.conserved.get(row) {
            diagnostics.report(code, psi.span, message);
        }
    }
}

/// What is wrong with an interface.
pub(super) enum InterfaceProblem {
    /// All derivatives of g are zero.
    Constant,
    /// The rate of g is zero in every region.
    NeverCrossed,
    /// g falls where it is positive, and rises where it is negative.
    AlwaysSliding,
    /// g rises where it is positive, and falls where it is negative.
    AlwaysLeaving,
}

impl InterfaceProblem {
    pub(super) fn report(self, interface: &Interface, diagnostics: &mut Diagnostics) {
        let name = &interface.ident;
        let (code, message) = match self {
            Self::Constant => (
                codes::CONSTANT_INTERFACE,
                format!(
                    "the interface `{name}` is constant: all of its derivatives are zero, so nothing can cross it"
                ),
            ),
            Self::NeverCrossed => (
                codes::NEVER_CROSSED,
                format!(
                    "the interface `{name}` is never crossed: d/dt {name} = 0 in every region, so that each region is a system of its own"
                ),
            ),
            Self::AlwaysSliding => (
                codes::ALWAYS_SLIDING,
                format!(
                    "the interface `{name}` cannot be crossed: d/dt {name} ≤ 0 where {name} > 0, and d/dt {name} ≥ 0 where {name} < 0, so that both sides push towards it"
                ),
            ),
            Self::AlwaysLeaving => (
                codes::ALWAYS_LEAVING,
                format!(
                    "the interface `{name}` is never reached: d/dt {name} ≥ 0 where {name} > 0, and d/dt {name} ≤ 0 where {name} < 0, so that both sides lead away from it"
                ),
            ),
        };
        diagnostics.report(code, interface.span, message);
    }
}

/// ` in the region …`, nothing where there is just one.
fn in_region(region: &Region) -> String {
    if region.sides.is_empty() {
        String::new()
    } else {
        format!(" in the region `{}`", region.ident)
    }
}

/// `x*y, which is 0.25 at x = 0.5, y = 0.5`
pub(super) fn refutation(dag: &Dag, counterexample: &Counterexample) -> String {
    let residual = shortened(&to_text(dag, counterexample.residual));
    if dag.as_constant(counterexample.residual).is_some() {
        return residual;
    }
    let value = rounded(counterexample.value);
    let depends: Vec<Name> = dag.variables([counterexample.residual]);
    let point: Vec<(Name, f64)> = counterexample
        .point
        .iter()
        .filter(|(name, _)| depends.contains(name))
        .cloned()
        .collect();
    if point.is_empty() {
        format!("{residual}, which is {value}")
    } else {
        format!("{residual}, which is {value} at {}", coordinates(&point))
    }
}

/// `x = 1, y = 2`
fn coordinates(point: &[(Name, f64)]) -> String {
    let zeros = point.iter().filter(|(_, value)| *value == 0.0).count();
    let sums_up = zeros > MOST_ZEROS;
    let mut parts: Vec<String> = point
        .iter()
        .filter(|(_, value)| !sums_up || *value != 0.0)
        .map(|(name, value)| format!("{name} = {}", rounded(*value)))
        .collect();
    if sums_up {
        parts.push("everything else 0".into());
    }
    parts.join(", ")
}

/// `text`, cut off where it is too long to be read.
fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST_RESIDUAL {
        return text.to_owned();
    }
    let beginning: String = text.chars().take(LONGEST_RESIDUAL).collect();
    format!("{beginning}…")
}

/// Four significant digits.
pub(super) fn rounded(value: f64) -> String {
    let scientific = format!("{value:.3e}");
    let shorter: f64 = scientific.parse().unwrap_or(value);
    if shorter == 0.0 || (1e-3..1e5).contains(&shorter.abs()) {
        format!("{shorter}")
    } else {
        format!("{shorter:e}")
    }
}
